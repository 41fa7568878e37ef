#pragma once

#include <geometry_msgs/TwistStamped.h>
#include <ros/node_handle.h>

#include <limits>
#include <string>

#include "adapters/inputs/engaged_freshness.hpp"
#include "adapters/runtime/diagnostics.hpp"
#include "window_ingress/configuration/navigator_node_params.hpp"

namespace window_ingress::adapters {

/// The navigator's eye on the guard, as the guard has one on the navigator: what reaches the autopilot is
/// heard on `passed_on`. While nobody passes anything on, the navigator itself sends the autopilot zeros, and
/// nothing but zeros, for an autopilot that hears nothing flies its last velocity on for seconds. Times are
/// those of the steady clock.
class GuardMonitor {
 public:
  GuardMonitor(ros::NodeHandle& nh, Diagnostics& diagnostics,
               const configuration::GuardMonitorParams& params);

  /// Where nobody has been heard so far they are taken to be, unless that is `required`.
  bool passesOn() const;
  void sent() { sent_sec_ = steadyNowSec(); }  ///< there is something to pass on
  /// Zeros past the guard, if it does not pass them on; to be called in each step of a mission.
  void brakeIfNobodyDoes(const ros::Time& now, const std::string& frame);

 private:
  void hear();
  Health health() const;

  ros::NodeHandle nh_;
  configuration::GuardMonitorParams params_;
  double started_sec_;
  double sent_sec_ = -std::numeric_limits<double>::infinity();
  double heard_sec_ = -std::numeric_limits<double>::infinity();
  ros::Subscriber subscriber_;
  ros::Publisher brake_;  ///< only while it is needed: otherwise the autopilot hears the guard alone
};

}  // namespace window_ingress::adapters
