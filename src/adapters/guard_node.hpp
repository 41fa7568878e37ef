#pragma once

#include <geometry_msgs/TwistStamped.h>
#include <ros/node_handle.h>

#include <string>

#include "adapters/diagnostics.hpp"
#include "adapters/run_node.hpp"

namespace window_ingress::adapters {

struct GuardParams {
  double rate_hz = 30.0;            ///< of the setpoints sent [Hz]
  double late_sec = 0.2;            ///< an input older than this, on the steady clock, no longer counts [s]
  double max_speed_mps = 1.2;       ///< faster than this is a fault, not a wish: zero is sent [m/s]
  double max_yaw_rate_radps = 1.0;  ///< likewise [rad/s]
  bool lockstep =
      false;  ///< with the simulated world: each input is passed on at once, and nothing else is sent
  std::string frame = "odom";  ///< frame_id of the zeros before the first input
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("rate_hz", self.rate_hz, 20.0, 200.0);
    field("late_sec", self.late_sec, 0.05, 1.0);
    field("max_speed_mps", self.max_speed_mps, 0.05, 10.0);
    field("max_yaw_rate_radps", self.max_yaw_rate_radps, 0.05, 5.0);
    field("lockstep", self.lockstep);
    field("frame", self.frame);
  }
};

/// Why this velocity must not reach the autopilot; empty if it may.
std::string whyUnsafe(const geometry_msgs::Twist& twist, const GuardParams& params);

/// The last gate before the autopilot, in a process of its own: it outlives the navigator.
///
/// Sends at `rate_hz` from its start until it is stopped: the input while it is recent and sane, zero
/// velocity in every other case. It goes on sending zeros however long the input is silent: an autopilot that
/// holds the last velocity when setpoints stop (ArduPilot: 3 s) would fly on. Whoever wants the autopilot's
/// own failsafe stops this node. In lockstep, which is refused outside simulated time, time stands still
/// where no input comes, and so does the guard.
class GuardNode : public Node {
 public:
  GuardNode(ros::NodeHandle& nh, ros::NodeHandle& pnh);
  void stop() override;

 private:
  void receive(const geometry_msgs::TwistStampedConstPtr& message);
  void send();
  void publish(const geometry_msgs::Twist& twist, const ros::Time& stamp);
  Health health() const;

  GuardParams params_;
  Diagnostics diagnostics_;
  geometry_msgs::TwistStamped input_;
  std::string fault_;
  double received_sec_;  // on the steady clock
  ros::Subscriber subscriber_;
  ros::Publisher publisher_;
  ros::SteadyTimer timer_;
};

}  // namespace window_ingress::adapters
