// Heading jumps, and whether the axes of the positions have turned as well.
#include <algorithm>
#include <cmath>

#include "navigation/motion/continuous_odometry.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::navigation {
namespace {

// Distance between both hypothetical ways that decides whether the axes have turned. Their misfits differ by
// distance^2 +- 2 distance * sigma (sigma: chance in one piece), so kTellingSigmas = 6 means three sigmas.
constexpr double kTellingM = 0.1, kTellingSigmas = 6.0;

}  // namespace

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

}  // namespace window_ingress::navigation
