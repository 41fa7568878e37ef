#include "navigation/motion/continuous_odometry.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/geometry/median.hpp"

namespace window_ingress::navigation {
namespace {

constexpr double kJumpInGapM = 0.2, kFastestMps = 1.0, kFastestRadps = 1.0, kTurnJumpRad = 0.08;
constexpr double kSecond = 1.0, kFramesSec = 3.0;
constexpr double kTellingM = 0.1;  // between the two ways flown, to tell whether the axes have turned
constexpr double kPieceSec = 0.5, kNoticeableMps = 0.03, kMaxBiasMps = 0.4;
constexpr std::size_t kLatePieces = 4, kFirstPieces = 2;
constexpr std::size_t kSteadyPieces = 8;              // longer than a slide lasts
constexpr double kAlikeMps = 0.1, kAlikeShare = 0.5;  // of the bias; by no more do pieces of it differ
constexpr double kToldM2 = 0.02;  // of differences that a window was seen beside, squared: enough to judge by
constexpr double kWindowMovesAlong = 0.3;  // of the difference, if it is the position that errs
// For so long more is no error of a velocity; with its steady bias, and without.
constexpr double kMostOfVelocityMps = 0.5, kMostBesideBiasMps = 0.3, kSlideSec = 0.25;
constexpr double kSightingSec = 0.2;       // that two sightings are off the length of a piece
constexpr double kMoreEven = 0.8;          // of the spread in the other axes, squared
constexpr double kSigmas = 2.0;            // of how a position walks, before a bias is known
constexpr double kSigmaOfMedian = 1.4826;  // of absolute deviations, normally distributed

double yawOf(const VehicleState& vehicle) { return geometry::yawOf(vehicle.T_odom_base.linear()); }

Eigen::Matrix3d uprightOf(const VehicleState& vehicle) { return geometry::yawRotation(yawOf(vehicle)); }

}  // namespace

std::optional<VehicleState> ContinuousOdometry::add(const VehicleState& odometry) {
  if (!odometry_) {
    odometry_ = smooth_ = odometry;
    second_.push_back({odometry.stamp_sec, odometry.T_odom_base.translation(), way_m_});
    return smooth_;
  }
  const double dt_sec = odometry.stamp_sec - odometry_->stamp_sec;
  if (dt_sec <= 0.0) return smooth_;
  if (dt_sec > kLongestGapSec) {
    const double moved_m = (odometry.T_odom_base.translation() - odometry_->T_odom_base.translation()).norm();
    const double speed_mps =
        std::max({kFastestMps, odometry.velocity_odom_mps.norm(), odometry_->velocity_odom_mps.norm()});
    const double turned_rad = std::abs(geometry::wrapAngle(yawOf(odometry) - yawOf(*odometry_)));
    if (moved_m > kJumpInGapM + 2.0 * speed_mps * kLongestGapSec ||
        turned_rad > kTurnJumpRad + kFastestRadps * kLongestGapSec) {
      reset();
      return std::nullopt;
    }
    second_.clear();
    piece_.reset();
  }
  const double turned_rad = geometry::wrapAngle(yawOf(odometry) - yawOf(*odometry_));
  const bool comes_back = headingComesBack(turned_rad);
  const bool has_turned = std::abs(turned_rad) > kFastestRadps * dt_sec + (comes_back ? 0.0 : kTurnJumpRad);
  if (has_turned) heading_error_rad_ = geometry::wrapAngle(heading_error_rad_ + turned_rad);
  is_erring_ = is_erring_ || has_turned;
  const Eigen::Vector3d before_mps = smooth_->velocity_odom_mps;
  VehicleState smooth = inSmooth(odometry);
  way_m_ += dt_sec * 0.5 * (before_mps + smooth.velocity_odom_mps);
  if (has_turned && comes_back)
    turn_.reset();  // it was wrong alone
  else if (has_turned)
    turn_ = Turn{turned_rad + (turn_ ? turn_->turn_rad : 0.0),
                 {odometry.stamp_sec, odometry.T_odom_base.translation(), way_m_}};
  odometry_ = odometry;
  judgeTurn(odometry);
  learnBias(smooth);
  shiftIfUnexplained(smooth);
  smooth_ = smooth;
  noteFrame();
  return smooth_;
}

// By a jump that may be smaller than the one that went, by noise and by how the vehicle turns.
bool ContinuousOdometry::headingComesBack(double turned_rad) const {
  const double error_rad = headingErrorRad();
  return std::abs(error_rad) > kTurnJumpRad &&
         std::abs(geometry::wrapAngle(error_rad + turned_rad)) < 0.5 * std::abs(error_rad);
}

Eigen::Isometry3d ContinuousOdometry::T_smooth_odom(double stamp_sec) const {
  for (auto frame = frames_.rbegin(); frame != frames_.rend(); ++frame)
    if (frame->stamp_sec <= stamp_sec || std::next(frame) == frames_.rend()) return frame->T_smooth_odom;
  return Eigen::Isometry3d::Identity();
}

void ContinuousOdometry::noteFrame() {
  if (!is_erring_) return;
  if (frames_.empty()) frames_.push_back({-1e300, Eigen::Isometry3d::Identity()});
  frames_.push_back({odometry_->stamp_sec, smooth_->T_odom_base * odometry_->T_odom_base.inverse()});
  while (frames_.size() > 2 && frames_[1].stamp_sec < odometry_->stamp_sec - kFramesSec) frames_.pop_front();
}

Eigen::Vector3d ContinuousOdometry::inOdomAxes(const Eigen::Vector3d& velocity_smooth_mps) const {
  return is_erring_ ? Eigen::Vector3d(T_smooth_axes_.linear().transpose() * velocity_smooth_mps)
                    : velocity_smooth_mps;
}

double ContinuousOdometry::headingErrorRad() const {
  return geometry::wrapAngle(heading_error_rad_ + geometry::yawOf(T_smooth_axes_.linear()));
}

VehicleState ContinuousOdometry::inSmooth(const VehicleState& odometry) const {
  if (!is_erring_) return odometry;
  VehicleState smooth = odometry;
  const Eigen::Matrix3d turn_back = geometry::yawRotation(-heading_error_rad_);
  smooth.T_odom_base.linear() = turn_back * odometry.T_odom_base.linear();
  smooth.velocity_odom_mps = turn_back * odometry.velocity_odom_mps;
  smooth.T_odom_base.translation() = T_smooth_axes_ * odometry.T_odom_base.translation();
  return smooth;
}

// In pieces of a second: over a long one velocity and position drift apart by themselves.
void ContinuousOdometry::judgeTurn(const VehicleState& odometry) {
  if (!turn_) return;
  const Eigen::Vector3d position_m = odometry.T_odom_base.translation();
  const Eigen::Vector2d way_m = (way_m_ - turn_->piece.way_m).head<2>();  // upward nothing turns
  const Eigen::Vector2d moved_m =
      (T_smooth_axes_.linear() * (position_m - turn_->piece.position_m)).head<2>();
  const Eigen::Rotation2Dd turn_back(-turn_->turn_rad);
  Turn now = *turn_;
  now.told_m2 += way_m.squaredNorm() * std::pow(2.0 * std::sin(0.5 * turn_->turn_rad), 2);
  now.misfit_m2 += (moved_m - way_m).squaredNorm();
  now.misfit_turned_m2 += (turn_back * moved_m - way_m).squaredNorm();
  now.piece = {odometry.stamp_sec, position_m, way_m_};
  if (now.told_m2 < kTellingM * kTellingM) {
    if (odometry.stamp_sec - turn_->piece.stamp_sec >= kSecond) turn_ = now;
    return;
  }
  if (now.misfit_turned_m2 < now.misfit_m2) {
    const Eigen::Vector3d smooth_m = T_smooth_axes_ * position_m;
    T_smooth_axes_.linear() = geometry::yawRotation(-turn_->turn_rad) * T_smooth_axes_.linear();
    T_smooth_axes_.translation() = smooth_m - T_smooth_axes_.linear() * position_m;
    second_.clear();
  }
  turn_.reset();
}

// Of an estimator's velocity that is always off by the same.
void ContinuousOdometry::learnBias(const VehicleState& smooth) {
  const Eigen::Vector3d unshifted_m = smooth.T_odom_base.translation() - shift_m_;
  differences_.push_back({smooth.stamp_sec, unshifted_m, way_m_});
  while (differences_.front().stamp_sec < smooth.stamp_sec - kSecond) differences_.pop_front();
  if (!piece_) piece_ = Sample{smooth.stamp_sec, unshifted_m, way_m_};
  const double piece_sec = smooth.stamp_sec - piece_->stamp_sec;
  if (piece_sec < kPieceSec) return;
  const Eigen::Vector3d unexplained_m = (unshifted_m - piece_->position_m) - (way_m_ - piece_->way_m);
  const Eigen::Vector3d differs_mps = unexplained_m / piece_sec;
  pieces_.push_back({uprightOf(smooth).transpose() * differs_mps, differs_mps});
  if (pieces_.size() > kPieces) pieces_.pop_front();
  compareWithWindow(pieces_.back(), usualMps(uprightOf(smooth)));
  judgeVelocity();
  piece_ = Sample{smooth.stamp_sec, unshifted_m, way_m_};
  if (pieces_.size() >= kFirstPieces) judgePieces();
  if (!is_bias_known_) judgeBias();
}

void ContinuousOdometry::see(double stamp_sec, const Eigen::Vector3d& window_odom_m) {
  for (auto sample = differences_.rbegin(); sample != differences_.rend(); ++sample)
    if (sample->stamp_sec <= stamp_sec) {
      sighting_ =
          Sighting{stamp_sec, T_smooth_axes_.linear() * window_odom_m, sample->position_m - sample->way_m};
      return;
    }
}

void ContinuousOdometry::compareWithWindow(Difference& difference, const Eigen::Vector3d& usual_mps) {
  const std::optional<Sighting> before = std::exchange(piece_sighting_, sighting_);
  if (!before) return;
  const double passed_sec = sighting_->stamp_sec - before->stamp_sec;
  if (std::abs(passed_sec - kPieceSec) > kSightingSec) return;
  const Eigen::Vector2d differs_m =
      (sighting_->differs_m - before->differs_m - passed_sec * usual_mps).head<2>();
  const Eigen::Vector2d moved_m = (sighting_->window_m - before->window_m).head<2>();
  if (std::max(differs_m.norm(), moved_m.norm()) > kMostOfVelocityMps * kPieceSec)
    return;  // a jump, or another window
  difference.told_m2 = differs_m.squaredNorm();
  difference.with_window_m2 = differs_m.dot(moved_m);
}

// While no window is seen, what was found holds.
void ContinuousOdometry::judgeVelocity() {
  double told_m2 = 0.0, with_window_m2 = 0.0;
  for (const Difference& piece : pieces_) {
    told_m2 += piece.told_m2;
    with_window_m2 += piece.with_window_m2;
  }
  if (told_m2 > kToldM2) is_velocity_worse_ = with_window_m2 < kWindowMovesAlong * told_m2;
}

void ContinuousOdometry::judgePieces() {
  const auto spread = [&](auto axes) {
    double sum = 0.0;
    for (const Difference& piece : pieces_) sum += (piece.*axes - usual_.*axes).squaredNorm();
    return sum;
  };
  for (const auto axes : {&Difference::base_mps, &Difference::smooth_mps}) {
    Eigen::Vector3d usual_mps = middleMps(axes);
    if (usual_mps.norm() > kMaxBiasMps) usual_mps *= kMaxBiasMps / usual_mps.norm();
    usual_.*axes = usual_mps;
  }
  const bool is_fixed_in_world = spread(&Difference::smooth_mps) < kMoreEven * spread(&Difference::base_mps);
  axes_ = is_fixed_in_world ? &Difference::smooth_mps : &Difference::base_mps;
  std::vector<double> errors_mps;
  for (const Difference& piece : pieces_)
    for (const int axis : {0, 1}) errors_mps.push_back(std::abs((piece.*axes_ - usual_.*axes_)[axis]));
  drift_m_per_sqrt_sec_ = kSigmaOfMedian * geometry::median(errors_mps) * std::sqrt(kPieceSec);
}

// A bias, in the end, is what half of the pieces are like, or so many that no slide lasts as long.
void ContinuousOdometry::judgeBias() {
  const Eigen::Vector3d usual_mps = usual_.*axes_;
  const double alike_mps = std::max(kAlikeMps, kAlikeShare * usual_mps.head<2>().norm());
  std::size_t alike = 0;
  Eigen::Vector3d carried_m = Eigen::Vector3d::Zero();
  for (const Difference& piece : pieces_) {
    if ((piece.*axes_ - usual_mps).head<2>().norm() > alike_mps) continue;
    ++alike;
    carried_m.head<2>() -= kPieceSec * piece.smooth_mps.head<2>();
  }
  is_bias_known_ = pieces_.size() == kPieces || alike >= kSteadyPieces;
  if (is_bias_known_ && is_erring_) carried_m_ = carried_m;
  if (is_bias_known_ && usual_mps.head<2>().norm() > kNoticeableMps) is_velocity_worse_ = true;
}

// Axes of `smooth`; nothing as long as it may be a slide.
Eigen::Vector3d ContinuousOdometry::usualMps(const Eigen::Matrix3d& R_smooth_base) const {
  if (!isBiasKnown()) return Eigen::Vector3d::Zero();
  return axes_ == &Difference::smooth_mps ? usual_.smooth_mps
                                          : Eigen::Vector3d(R_smooth_base * usual_.base_mps);
}

// A velocity that errs errs otherwise within seconds.
Eigen::Vector3d ContinuousOdometry::steadyMps(const Eigen::Matrix3d& R_smooth_base) const {
  if (is_velocity_worse_ && !differences_.empty()) {
    const Sample &first = differences_.front(), &last = differences_.back();
    const double passed_sec = last.stamp_sec - first.stamp_sec;
    if (passed_sec > kPieceSec)
      return (last.position_m - first.position_m - last.way_m + first.way_m) / passed_sec;
  }
  return usualMps(R_smooth_base);
}

Eigen::Vector3d ContinuousOdometry::biasMps() const {
  if (!smooth_) return Eigen::Vector3d::Zero();
  const Eigen::Matrix3d R_smooth_base = uprightOf(*smooth_);
  return -(R_smooth_base.transpose() * steadyMps(R_smooth_base));
}

Eigen::Vector3d ContinuousOdometry::middleMps(Axes axes) const {
  std::vector<Eigen::Vector3d> pieces_mps;
  for (const Difference& piece : pieces_) pieces_mps.push_back(piece.*axes);
  return geometry::componentwiseMedian(pieces_mps);
}

Eigen::Vector3d ContinuousOdometry::latePiecesMps() const {
  if (pieces_.size() < kLatePieces) return usual_.*axes_;
  const Eigen::Vector3d sum_mps =
      std::accumulate(pieces_.end() - kLatePieces, pieces_.end(), Eigen::Vector3d(0, 0, 0),
                      [&](const Eigen::Vector3d& sum, const Difference& piece) -> Eigen::Vector3d {
                        return sum + piece.*axes_;
                      });
  return sum_mps / kLatePieces;
}

double ContinuousOdometry::unexplainedMps() const {
  if (is_velocity_worse_ && isBiasKnown()) return 0.0;
  if (isBiasKnown()) return (latePiecesMps() - usual_.*axes_).norm();
  if (pieces_.empty()) return 0.0;
  const double walk_mps = drift_m_per_sqrt_sec_ / std::sqrt(kPieceSec * static_cast<double>(pieces_.size()));
  return std::max(latePiecesMps().norm(), std::hypot((usual_.*axes_).norm(), kSigmas * walk_mps));
}

Eigen::Vector3d ContinuousOdometry::unbiased(const VehicleState& smooth) const {
  const Eigen::Vector3d steady_mps = steadyMps(uprightOf(smooth));
  if (steady_mps.norm() < kNoticeableMps) return smooth.velocity_odom_mps;
  return smooth.velocity_odom_mps + steady_mps;
}

void ContinuousOdometry::shiftIfUnexplained(VehicleState& smooth) {
  const Eigen::Vector3d position_m = smooth.T_odom_base.translation();
  second_.push_back(
      {smooth.stamp_sec, position_m, way_m_});  // the only one after a gap: what was flown is not known
  while (second_.front().stamp_sec < smooth.stamp_sec - kSecond) second_.pop_front();
  const Eigen::Vector3d usual_mps = usualMps(uprightOf(smooth));
  const auto unexplainedSince = [&](const Sample& first) -> Eigen::Vector3d {
    return (position_m - first.position_m) - (way_m_ - first.way_m) -
           usual_mps * (smooth.stamp_sec - first.stamp_sec);
  };
  Eigen::Vector3d unexplained_m = unexplainedSince(second_.front());
  double most_m = kUnexplainedM;
  if (is_velocity_worse_) {  // the position is believed but for a jump, and for what no velocity is off by
    unexplained_m = unexplainedSince(second_[std::max<std::size_t>(second_.size(), 2) - 2]);
    if (unexplained_m.norm() < kUnexplainedM) {
      const auto first = std::find_if(second_.begin(), second_.end(), [&](const Sample& sample) {
        return sample.stamp_sec >= smooth.stamp_sec - kSlideSec;
      });
      unexplained_m = unexplainedSince(*first);
      most_m = (isBiasKnown() ? kMostBesideBiasMps : kMostOfVelocityMps) * kSlideSec;
    }
  }
  if (unexplained_m.norm() < most_m) return;
  is_erring_ = true;
  T_smooth_axes_.translation() -= unexplained_m;
  smooth.T_odom_base.translation() -= unexplained_m;
  shift_m_ -= unexplained_m;
  if (is_velocity_worse_) differences_.clear();
  second_.clear();
  second_.push_back({smooth.stamp_sec, smooth.T_odom_base.translation(), way_m_});
}

}  // namespace window_ingress::navigation
