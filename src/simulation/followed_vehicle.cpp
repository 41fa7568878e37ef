#include "window_ingress/simulation/followed_vehicle.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::simulation {
namespace {

Eigen::Vector3d between(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double fraction) {
  return a + fraction * (b - a);
}

VehicleTruth between(const VehicleTruth& a, const VehicleTruth& b, double fraction) {
  const Eigen::Quaterniond qa(a.T_odom_base.linear()), qb(b.T_odom_base.linear());
  VehicleTruth truth;
  truth.T_odom_base =
      geometry::makePose(qa.slerp(fraction, qb).normalized().toRotationMatrix(),
                         between(a.T_odom_base.translation(), b.T_odom_base.translation(), fraction));
  truth.velocity_odom_mps = between(a.velocity_odom_mps, b.velocity_odom_mps, fraction);
  truth.angular_velocity_base_radps =
      between(a.angular_velocity_base_radps, b.angular_velocity_base_radps, fraction);
  return truth;
}

}  // namespace

void FollowedVehicle::follow(const VehicleTruth& truth, double stamp_sec) {
  if (!geometry::isValidPose(truth.T_odom_base) || !truth.velocity_odom_mps.allFinite() ||
      !truth.angular_velocity_base_radps.allFinite() || !std::isfinite(stamp_sec))
    throw std::invalid_argument("pose, twist or stamp of the followed vehicle is not finite");
  if (to_ && stamp_sec <= to_->stamp_sec)
    throw std::invalid_argument("stamp of the followed vehicle is not after the one before");
  from_ = to_;
  to_ = Waypoint{truth, stamp_sec};
  if (!from_) truth_ = truth;
}

void FollowedVehicle::moveTo(double now_sec) {
  if (!from_) return;
  const double fraction = (now_sec - from_->stamp_sec) / (to_->stamp_sec - from_->stamp_sec);
  truth_ = between(from_->truth, to_->truth, std::clamp(fraction, 0.0, 1.0));
}

}  // namespace window_ingress::simulation
