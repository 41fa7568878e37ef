#include "navigation/motion/continuous_odometry.hpp"

#include <algorithm>
#include <cmath>

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::navigation {
namespace {

constexpr double kFramesSec = 3.0;
// Distance between both hypothetical ways that decides whether the axes have turned. Their misfits differ by
// distance^2 +- 2 distance * sigma (sigma: chance in one piece), so kTellingSigmas = 6 means three sigmas.
constexpr double kTellingM = 0.1, kTellingSigmas = 6.0;

double yawOf(const VehicleState& vehicle) { return geometry::yawOf(vehicle.T_odom_base.linear()); }

}  // namespace

std::optional<VehicleState> ContinuousOdometry::add(const VehicleState& odometry) {
  if (!odometry_) {
    odometry_ = smooth_ = odometry;
    second_.push_back({odometry.stamp_sec, odometry.T_odom_base.translation(), way_m_});
    return smooth_;
  }
  const double dt_sec = odometry.stamp_sec - odometry_->stamp_sec;
  if (dt_sec <= 0.0) return smooth_;
  const double turned_rad = geometry::wrapAngle(yawOf(odometry) - yawOf(*odometry_));
  if (dt_sec > kLongestGapSec) {
    const double moved_m = (odometry.T_odom_base.translation() - odometry_->T_odom_base.translation()).norm();
    const double speed_mps =
        std::max({kFastestMps, odometry.velocity_odom_mps.norm(), odometry_->velocity_odom_mps.norm()});
    if (moved_m > kJumpInGapM + 2.0 * speed_mps * kLongestGapSec ||
        std::abs(turned_rad) > kTurnJumpRad + kFastestRadps * kLongestGapSec) {
      reset();
      return std::nullopt;
    }
    second_.clear();
    differences_.clear();
    apart_.reset();
  }
  const bool comes_back = headingComesBack(turned_rad);
  const bool has_turned = std::abs(turned_rad) > kFastestRadps * dt_sec + (comes_back ? 0.0 : kTurnJumpRad);
  if (has_turned) heading_error_rad_ = geometry::wrapAngle(heading_error_rad_ + turned_rad);
  is_erring_ = is_erring_ || has_turned;
  const Eigen::Vector3d before_mps = smooth_->velocity_odom_mps;
  VehicleState smooth = inSmooth(odometry);
  way_m_ += dt_sec * 0.5 * (before_mps + smooth.velocity_odom_mps);
  if (has_turned && comes_back)
    turn_.reset();  // only the attitude was wrong
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

// The jump back may be smaller than the jump: noise and the vehicle's own turn change it.
bool ContinuousOdometry::headingComesBack(double turned_rad) const {
  const double error_rad = headingErrorRad();
  return std::abs(error_rad) > kTurnJumpRad &&
         std::abs(geometry::wrapAngle(error_rad + turned_rad)) < 0.5 * std::abs(error_rad);
}

// Compares pieces of one second, because velocity and position drift apart over longer ones.
void ContinuousOdometry::judgeTurn(const VehicleState& odometry) {
  if (!turn_) return;
  const Eigen::Vector3d position_m = odometry.T_odom_base.translation();
  const double passed_sec = odometry.stamp_sec - turn_->piece.stamp_sec;
  const Eigen::Vector2d way_m = (way_m_ - turn_->piece.way_m + passed_sec * usualMps(uprightOf(*smooth_)))
                                    .head<2>();  // a yaw turn does not change the vertical axis
  const Eigen::Vector2d moved_m =
      (T_smooth_axes_.linear() * (position_m - turn_->piece.position_m)).head<2>();
  const Eigen::Rotation2Dd turn_back(-turn_->turn_rad);
  Turn now = *turn_;
  now.told_m2 += way_m.squaredNorm() * std::pow(2.0 * std::sin(0.5 * turn_->turn_rad), 2);
  now.misfit_m2 += (moved_m - way_m).squaredNorm();
  now.misfit_turned_m2 += (turn_back * moved_m - way_m).squaredNorm();
  ++now.pieces;
  now.piece = {odometry.stamp_sec, position_m, way_m_};
  const double by_chance_m2 = std::max(std::pow(drift_m_per_sqrt_sec_, 2) * kSecond,
                                       std::min(now.misfit_m2, now.misfit_turned_m2) / (2.0 * now.pieces));
  if (now.told_m2 < std::max(std::pow(kTellingM, 2), std::pow(kTellingSigmas, 2) * by_chance_m2)) {
    if (passed_sec >= kSecond) turn_ = now;
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

void ContinuousOdometry::shiftIfUnexplained(VehicleState& smooth) {
  const Eigen::Vector3d position_m = smooth.T_odom_base.translation();
  second_.push_back(
      {smooth.stamp_sec, position_m, way_m_});  // the only sample after a gap, whose way is unknown
  while (second_.front().stamp_sec < smooth.stamp_sec - kSecond) second_.pop_front();
  const Sample& before = second_[std::max<std::size_t>(second_.size(), 2) - 2];
  for (const Sample& first : {second_.front(), before}) {
    const double passed_sec = smooth.stamp_sec - first.stamp_sec;
    const Eigen::Vector3d unexplained_m =
        (position_m - first.position_m) - (way_m_ - first.way_m) - passed_sec * usualMps(uprightOf(smooth));
    if (unexplained_m.norm() < std::max(kUnexplainedM, byChanceM(passed_sec))) continue;
    is_erring_ = true;
    T_smooth_axes_.translation() -= unexplained_m;
    smooth.T_odom_base.translation() -= unexplained_m;
    shift_m_ -= unexplained_m;
    differences_.clear();
    second_.clear();
    second_.push_back({smooth.stamp_sec, smooth.T_odom_base.translation(), way_m_});
    return;
  }
}

}  // namespace window_ingress::navigation
