// The world for an external vehicle, whose odometry drives time.
#include <deque>

#include "adapters/world/world_node.hpp"

namespace window_ingress::adapters {
namespace {

constexpr double kMaxSilenceSec = 5.0;  // a longer gap begins another flight
constexpr double kMaxLateSec = 0.5;     // a larger step back begins another flight
constexpr std::size_t kMaxImages = 2;   // number drawn of the images that are due at once
constexpr long kForgivenImages = 30;    // the vehicle flies on while the house is built

}  // namespace

void WorldNode::receiveVehicle(const nav_msgs::OdometryConstPtr& message) {
  vehicle_->admits(message->header.stamp);
  const auto vehicle = fromMsg(*message, params_.frames);
  if (!vehicle) return vehicle_->refused(vehicle.reason);
  const double back_sec = followed_sec_ - vehicle.value->stamp_sec;
  if (running_ && back_sec >= 0.0 && back_sec <= kMaxLateSec)
    return vehicle_->refused(
        formatted("stamp is %.3f s before the latest: late samples are left out", back_sec));
  const Eigen::Vector3d turning = toEigen(message->twist.twist.angular);
  if (!turning.allFinite()) return vehicle_->refused("angular velocity is not finite");
  vehicle_->accepted();
  follow(*vehicle.value, turning);
}

void WorldNode::begin(const navigation::VehicleState& vehicle) {
  if (params_.start_at == "vehicle" && !T_odom_start_) T_odom_start_ = vehicle.T_odom_base;
  epoch_sec_ = vehicle.stamp_sec;
  restart();
  running_ = true;
}

// Time follows the stamps and stands still without them, so no image shows a guessed pose. Time begins with
// the first sample after the house is built, which may take longer than the longest silence.
void WorldNode::follow(const navigation::VehicleState& vehicle, const Eigen::Vector3d& turning_radps) {
  const double passed_sec = vehicle.stamp_sec - followed_sec_;
  const bool follows = followed_sec_ >= 0.0;
  const bool leaps = follows && (passed_sec <= 0.0 || passed_sec > kMaxSilenceSec);
  if (leaps) ROS_WARN("vehicle_odom: stamps jumped by %.2f s: the world restarts", passed_sec);
  if (leaps || !running_) return begin(vehicle);
  if (!follows) epoch_sec_ = vehicle.stamp_sec;
  followed_sec_ = vehicle.stamp_sec;
  const double until_sec = vehicle.stamp_sec - epoch_sec_;
  world_->follow({vehicle.T_odom_base, vehicle.velocity_odom_mps, turning_radps}, until_sec);
  while (world_->timeSec() + simulation::World::kStepSec <= until_sec + 1e-9) stepOnce();
}

// An external vehicle does not wait: images that a slow machine cannot draw in time are dropped, not delayed.
void WorldNode::deliverNewestImages() {
  while (const auto sample = world_->takeCalibration()) sendCalibration(*sample);
  std::deque<simulation::Exposure> due;
  while (const auto exposure = world_->takeExposure()) due.push_back(*exposure);
  images_due_ += static_cast<long>(due.size());
  for (; due.size() > kMaxImages; due.pop_front()) ++images_lost_;
  for (const simulation::Exposure& exposure : due) deliver(world_->draw(exposure));
}

Health WorldNode::externalHealth() const {
  if (!running_) return {Health::kOk, "no vehicle_odom so far"};
  if (images_lost_ * 10 <= images_due_ || images_lost_ <= kForgivenImages)
    return {Health::kOk, "time follows vehicle_odom"};
  return {Health::kWarn,
          formatted("%ld of %ld images are lost: this machine draws too slowly", images_lost_, images_due_)};
}

}  // namespace window_ingress::adapters
