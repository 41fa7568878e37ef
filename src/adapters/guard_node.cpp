#include "adapters/guard_node.hpp"

#include <cmath>
#include <limits>

#include "adapters/guarded.hpp"
#include "adapters/parameters.hpp"

namespace window_ingress::adapters {

std::string whyUnsafe(const geometry_msgs::Twist& twist, const GuardParams& params) {
  const auto &v = twist.linear, &w = twist.angular;
  // One by one: std::hypot of three numbers swallows a NaN beside zeros.
  for (const double number : {v.x, v.y, v.z, w.x, w.y, w.z})
    if (!std::isfinite(number)) return "velocity is not finite";
  const double speed = std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
  const double turning = std::sqrt(w.x * w.x + w.y * w.y + w.z * w.z);
  if (!(speed <= params.max_speed_mps))
    return "speed of " + std::to_string(speed) + " m/s is above the limit";
  if (!(turning <= params.max_yaw_rate_radps))
    return "turning at " + std::to_string(turning) + " rad/s is above the limit";
  return "";
}

GuardNode::GuardNode(ros::NodeHandle& nh, ros::NodeHandle& pnh)
    : params_(readParameters<GuardParams>(pnh)),
      diagnostics_(nh, pnh),
      received_sec_(-std::numeric_limits<double>::infinity()) {
  if (params_.lockstep && !ros::Time::isSimTime())
    throw ParameterError("lockstep is for simulated time only, and use_sim_time is not set");
  input_.header.frame_id = params_.frame;
  diagnostics_.add("cmd_vel_in", [this] { return health(); });
  publisher_ = nh.advertise<geometry_msgs::TwistStamped>("cmd_vel", 1, params_.lockstep);
  subscriber_ = subscribeGuarded<geometry_msgs::TwistStamped>(
      nh, "cmd_vel_in", 1, diagnostics_, [this](const auto& message) { receive(message); });
  if (params_.lockstep) return;
  timer_ = createGuardedTimer(nh, 1.0 / params_.rate_hz, "send", diagnostics_, [this] { send(); });
}

void GuardNode::receive(const geometry_msgs::TwistStampedConstPtr& message) {
  input_ = *message;
  received_sec_ = steadyNowSec();
  fault_ = whyUnsafe(message->twist, params_);
  if (params_.lockstep)
    publish(fault_.empty() ? input_.twist : geometry_msgs::Twist(), message->header.stamp);
}

void GuardNode::send() {
  const bool late = steadyNowSec() - received_sec_ > params_.late_sec;
  publish(late || !fault_.empty() ? geometry_msgs::Twist() : input_.twist, ros::Time::now());
}

void GuardNode::publish(const geometry_msgs::Twist& twist, const ros::Time& stamp) {
  geometry_msgs::TwistStamped message;
  message.header.stamp = stamp;
  message.header.frame_id = input_.header.frame_id;
  message.twist = twist;
  publisher_.publish(message);
}

Health GuardNode::health() const {
  if (!fault_.empty()) return {Health::kError, "input refused, sending zero: " + fault_};
  if (steadyNowSec() - received_sec_ <= params_.late_sec) return {};
  return {Health::kWarn, "input on " + subscriber_.getTopic() + " is silent (" +
                             std::to_string(subscriber_.getNumPublishers()) + " publishers), sending zero"};
}

void GuardNode::stop() {
  subscriber_.shutdown();
  for (int i = 0; i < 5; ++i) {
    publish(geometry_msgs::Twist(), ros::Time::now());
    ros::WallDuration(0.05).sleep();
  }
}

}  // namespace window_ingress::adapters
