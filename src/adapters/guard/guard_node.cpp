#include "adapters/guard/guard_node.hpp"

#include <cmath>

#include "adapters/conversions/msg_conversion.hpp"
#include "adapters/runtime/diagnostics.hpp"
#include "adapters/runtime/parameter_server.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::adapters {
namespace {

GuardParams checked(const GuardParams& params) {
  if (params.lockstep && !ros::Time::isSimTime())
    throw InputError("lockstep is for simulated time only, and use_sim_time is not set");
  return params;
}

}  // namespace

GuardNode::GuardNode(ros::NodeHandle& nh, ros::NodeHandle& pnh)
    : params_(checked(readParameters<GuardParams>(pnh))),
      diagnostics_(nh, pnh),
      gate_(params_),
      frame_id_(params_.frame) {
  diagnostics_.add("cmd_vel_in", [this] { return inputHealth(); });
  diagnostics_.add("cmd_vel", [this] { return outputHealth(); });
  publisher_ = nh.advertise<geometry_msgs::TwistStamped>("cmd_vel", 1, params_.lockstep);
  passed_on_ = nh.advertise<geometry_msgs::TwistStamped>("passed_on", 1);
  subscriber_ = subscribeCatching<geometry_msgs::TwistStamped>(
      nh, "cmd_vel_in", 1, diagnostics_, [this](const auto& message) { receive(message); });
  if (params_.lockstep) return;
  timer_ = createCatchingTimer(nh, 1.0 / params_.rate_hz, "send", diagnostics_, [this] { send(); });
}

void GuardNode::receive(const geometry_msgs::TwistStampedConstPtr& message) {
  const double now_sec = steadyNowSec();
  gate_.receive(message->twist, now_sec);
  frame_id_ = message->header.frame_id;
  if (params_.lockstep)
    publish(gate_.output(now_sec).value_or(geometry_msgs::Twist()), message->header.stamp);
}

void GuardNode::send() {
  if (const auto twist = gate_.output(steadyNowSec())) publish(*twist, ros::Time::now());
}

void GuardNode::publish(const geometry_msgs::Twist& twist, const ros::Time& stamp) {
  geometry_msgs::TwistStamped message;
  message.header = headerOf(stamp, frame_id_);
  message.twist = twist;
  publisher_.publish(message);
  passed_on_.publish(message);
}

Health GuardNode::inputHealth() const {
  const double now_sec = steadyNowSec();
  const std::string publishers = "(" + std::to_string(subscriber_.getNumPublishers()) + " publishers)";
  const std::string input = "input on " + subscriber_.getTopic() + " ";
  if (gate_.isSilent(now_sec))
    return {Health::kError, input + "is silent or refused " + publishers +
                                formatted(" for %.0f s, sending nothing: the autopilot's failsafe has to act",
                                          std::floor(gate_.sinceSaneSec(now_sec)))};
  if (gate_.isLate(now_sec)) return {Health::kWarn, input + "is silent " + publishers + ", sending zero"};
  if (!gate_.fault().empty()) return {Health::kError, input + "is refused, sending zero: " + gate_.fault()};
  if (subscriber_.getNumPublishers() > 1)
    return {Health::kWarn, input + "comes from several " + publishers + ", only one may steer"};
  return {};
}

Health GuardNode::outputHealth() const {
  if (publisher_.getNumSubscribers() > 0) return {};
  return {Health::kWarn, "nobody subscribes to " + publisher_.getTopic() + ": no autopilot takes setpoints"};
}

void GuardNode::stop() {
  subscriber_.shutdown();
  if (gate_.isSilent(steadyNowSec())) return;
  for (int i = 0; i < 5; ++i) {
    publish(geometry_msgs::Twist(), ros::Time::now());
    ros::WallDuration(0.05).sleep();
  }
}

}  // namespace window_ingress::adapters
