// What the velocity of an odometry is off by, and which of velocity and position errs.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "navigation/motion/continuous_odometry.hpp"
#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/geometry/median.hpp"

namespace window_ingress::navigation {
namespace {

constexpr double kPieceSec = 0.5, kNoticeableMps = 0.03, kMaxBiasMps = 0.4;
constexpr std::size_t kLatePieces = 4, kFirstPieces = 2;
constexpr std::size_t kSteadyPieces = 8;              // longer than a slide lasts
constexpr double kAlikeMps = 0.1, kAlikeShare = 0.5;  // of the bias; by no more do pieces of it differ
constexpr double kToldM2 = 0.02;  // of differences that a window was seen beside, squared: enough to judge by
constexpr double kWindowMovesAlong = 0.3;  // of the difference, if it is the position that errs
constexpr double kSightingSec = 0.2;       // that two sightings are off the length of a piece
constexpr double kMoreEven = 0.8;          // of the spread in the other axes, squared
constexpr double kSigmas = 2.0;            // of how a position walks, before a bias is known
constexpr double kSigmaOfMedian = 1.4826;  // of absolute deviations, normally distributed

}  // namespace

Eigen::Matrix3d ContinuousOdometry::uprightOf(const VehicleState& vehicle) {
  return geometry::yawRotation(geometry::yawOf(vehicle.T_odom_base.linear()));
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
  difference.is_beside_bias = isBiasKnown();
  difference.told_m2 = differs_m.squaredNorm();
  difference.with_window_m2 = differs_m.dot(moved_m);
}

// While no window is seen, what was found holds.
void ContinuousOdometry::judgeVelocity() {
  if (!(pieces_.back().told_m2 > 0.0)) return;
  double told_m2 = 0.0, with_window_m2 = 0.0, velocity_m2 = 0.0;
  int velocity_pieces = 0;
  for (const Difference& piece : pieces_) {
    told_m2 += piece.told_m2;
    with_window_m2 += piece.with_window_m2;
    if (!piece.is_beside_bias || !(piece.with_window_m2 < kWindowMovesAlong * piece.told_m2)) continue;
    velocity_m2 += piece.told_m2;
    ++velocity_pieces;
  }
  if (velocity_pieces > 0) velocity_error_mps_ = std::sqrt(velocity_m2 / velocity_pieces) / kPieceSec;
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

}  // namespace window_ingress::navigation
