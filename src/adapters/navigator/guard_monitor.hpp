#pragma once

#include <geometry_msgs/TwistStamped.h>
#include <ros/node_handle.h>

#include <cmath>
#include <limits>
#include <string>

#include "adapters/conversions/msg_conversion.hpp"
#include "adapters/navigator/engagement_monitor.hpp"
#include "adapters/runtime/diagnostics.hpp"
#include "window_ingress/configuration/navigator_node_params.hpp"

namespace window_ingress::adapters {

/// The navigator's watch on the guard (the guard also watches the navigator): messages to the autopilot are
/// also on `passed_on`. While they are missing, the navigator itself sends zeros to the autopilot, never
/// anything else, because an autopilot without input flies its last velocity on for seconds. Times are on the
/// steady clock.
class GuardMonitor {
 public:
  GuardMonitor(ros::NodeHandle& nh, Diagnostics& diagnostics, const configuration::GuardMonitorParams& params)
      : nh_(nh), params_(params), started_sec_(steadyNowSec()) {
    subscriber_ = diagnostics.subscribe(nh_, kTopic, 1, &GuardMonitor::hear, this);
    diagnostics.add(kTopic, [this] { return health(); });
  }

  /// Before the first message on `passed_on` the setpoints count as passed on, unless `required`.
  bool passesOn() const {
    if (std::isinf(heard_sec_)) return !params_.required;
    return steadyNowSec() - heard_sec_ <= params_.max_silence_sec;
  }

  void sent() { sent_sec_ = steadyNowSec(); }  ///< notes that a setpoint was sent
  /// Sends zeros past the guard if it does not pass setpoints on; called in each step of a mission.
  void brakeIfNobodyDoes(const ros::Time& now, const std::string& frame) {
    if (passesOn()) return;
    if (!brake_) brake_ = nh_.advertise<Setpoint>("brake", 1);
    Setpoint zero;
    zero.header = headerOf(now, frame);
    brake_.publish(zero);
  }

 private:
  using Setpoint = geometry_msgs::TwistStamped;
  static constexpr const char* kTopic = "passed_on";

  void hear(const Setpoint::ConstPtr&) {
    heard_sec_ = steadyNowSec();
    if (brake_) brake_.shutdown();
    brake_ = ros::Publisher();
  }

  Health health() const {
    const std::string topic = subscriber_.getTopic();
    if (passesOn() && std::isinf(heard_sec_))
      return {Health::kOk, "nothing on " + topic + ": setpoints are assumed to be passed on"};
    if (passesOn()) return {};
    if (steadyNowSec() - sent_sec_ > params_.max_silence_sec)
      return {Health::kOk, "no setpoints are sent: nothing to pass on"};
    if (std::isinf(heard_sec_) && steadyNowSec() - started_sec_ <= EngagementMonitor::kGraceSec)
      return {Health::kOk, "waiting for " + topic};
    return {Health::kError,
            "nothing on " + topic + " from setpoint_guard: no mission can fly; zeros bypass the guard"};
  }

  ros::NodeHandle nh_;
  configuration::GuardMonitorParams params_;
  double started_sec_;
  double sent_sec_ = -std::numeric_limits<double>::infinity();
  double heard_sec_ = -std::numeric_limits<double>::infinity();
  ros::Subscriber subscriber_;
  ros::Publisher brake_;  ///< exists only while needed: otherwise the autopilot hears the guard alone
};

}  // namespace window_ingress::adapters
