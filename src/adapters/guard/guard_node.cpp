#include <geometry_msgs/TwistStamped.h>

#include <cmath>

#include "adapters/conversions/msg_conversion.hpp"
#include "adapters/guard/setpoint_gate.hpp"
#include "adapters/nodes.hpp"
#include "adapters/runtime/diagnostics.hpp"
#include "adapters/runtime/lockstep.hpp"
#include "adapters/runtime/parameter_server.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::adapters {

/// The last gate before the autopilot, in a process of its own, so that it outlives the navigator.
///
/// From its start to its end it sends what `SetpointGate` lets through, at `rate_hz` on the steady clock. The
/// same messages go out on `passed_on`, which the navigator monitors. In lockstep, which is refused outside
/// simulated time, the guard's time advances only with its input.
class GuardNode : public Node {
 public:
  GuardNode(ros::NodeHandle& nh, ros::NodeHandle& pnh, const GuardParams& params)
      : params_(params), diagnostics_(nh, pnh), gate_(params), frame_id_(params.frame) {
    diagnostics_.add("cmd_vel_in", [this] { return inputHealth(); });
    diagnostics_.add("cmd_vel", [this] { return outputHealth(); });
    publisher_ = nh.advertise<geometry_msgs::TwistStamped>("cmd_vel", 1, params_.lockstep);
    passed_on_ = nh.advertise<geometry_msgs::TwistStamped>("passed_on", 1);
    subscriber_ = diagnostics_.subscribe(nh, "cmd_vel_in", 1, &GuardNode::receive, this);
    if (params_.lockstep) return;
    timer_ = diagnostics_.createTimer(nh, 1.0 / params_.rate_hz, "send", [this] { send(); });
  }

  void stop() override {
    subscriber_.shutdown();
    if (gate_.isSilent(steadyNowSec())) return;
    for (int i = 0; i < 5; ++i) {
      publish(geometry_msgs::Twist(), ros::Time::now());
      ros::WallDuration(0.05).sleep();
    }
  }

 private:
  void receive(const geometry_msgs::TwistStampedConstPtr& message) {
    const double now_sec = steadyNowSec();
    gate_.receive(message->twist, now_sec);
    frame_id_ = message->header.frame_id;
    if (params_.lockstep)
      publish(gate_.output(now_sec).value_or(geometry_msgs::Twist()), message->header.stamp);
  }

  void send() {
    if (const auto twist = gate_.output(steadyNowSec())) publish(*twist, ros::Time::now());
  }

  void publish(const geometry_msgs::Twist& twist, const ros::Time& stamp) {
    geometry_msgs::TwistStamped message;
    message.header = headerOf(stamp, frame_id_);
    message.twist = twist;
    publisher_.publish(message);
    passed_on_.publish(message);
  }

  Health inputHealth() const {
    const double now_sec = steadyNowSec();
    const std::string publishers = "(" + std::to_string(subscriber_.getNumPublishers()) + " publishers)";
    const std::string input = "input on " + subscriber_.getTopic() + " ";
    if (gate_.isSilent(now_sec))
      return {Health::kError,
              input + "is silent or refused " + publishers +
                  formatted(" for %.0f s, sending nothing: the autopilot's failsafe has to act",
                            std::floor(gate_.sinceSaneSec(now_sec)))};
    if (gate_.isLate(now_sec)) return {Health::kWarn, input + "is silent " + publishers + ", sending zero"};
    if (!gate_.fault().empty()) return {Health::kError, input + "is refused, sending zero: " + gate_.fault()};
    if (subscriber_.getNumPublishers() > 1)
      return {Health::kWarn, input + "comes from several " + publishers + ", only one may steer"};
    return {};
  }

  Health outputHealth() const {
    if (publisher_.getNumSubscribers() > 0) return {};
    return {Health::kWarn,
            "nobody subscribes to " + publisher_.getTopic() + ": no autopilot takes setpoints"};
  }

  GuardParams params_;
  Diagnostics diagnostics_;
  SetpointGate gate_;
  std::string frame_id_;
  ros::Subscriber subscriber_;
  ros::Publisher publisher_, passed_on_;
  ros::SteadyTimer timer_;
};

std::unique_ptr<Node> makeSetpointGuard(ros::NodeHandle& nh, ros::NodeHandle& pnh) {
  const auto params = readParameters<GuardParams>(pnh);
  if (params.lockstep) requireSimulatedTime();
  return std::make_unique<GuardNode>(nh, pnh, params);
}

}  // namespace window_ingress::adapters
