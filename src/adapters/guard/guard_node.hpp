#pragma once

#include <geometry_msgs/TwistStamped.h>
#include <ros/node_handle.h>

#include "adapters/guard/setpoint_gate.hpp"
#include "adapters/runtime/diagnostics.hpp"
#include "adapters/runtime/run_node.hpp"

namespace window_ingress::adapters {

/// The last gate before the autopilot, in a process of its own, so that it outlives the navigator.
///
/// From its start to its end it sends what `SetpointGate` lets through, at `rate_hz` on the steady clock. The
/// same messages go out on `passed_on`, which the navigator monitors. In lockstep, which is refused outside
/// simulated time, the guard's time advances only with its input.
class GuardNode : public Node {
 public:
  GuardNode(ros::NodeHandle& nh, ros::NodeHandle& pnh);
  void stop() override;

 private:
  void receive(const geometry_msgs::TwistStampedConstPtr& message);
  void send();
  void publish(const geometry_msgs::Twist& twist, const ros::Time& stamp);
  Health inputHealth() const;
  Health outputHealth() const;

  GuardParams params_;
  Diagnostics diagnostics_;
  SetpointGate gate_;
  std::string frame_id_;
  ros::Subscriber subscriber_;
  ros::Publisher publisher_, passed_on_;
  ros::SteadyTimer timer_;
};

}  // namespace window_ingress::adapters
