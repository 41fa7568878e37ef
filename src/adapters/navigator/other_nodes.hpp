/// What the navigator hears of the other nodes.
#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/TwistStamped.h>
#include <ros/node_handle.h>
#include <ros/this_node.h>

#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "adapters/conversions/msg_conversion.hpp"
#include "adapters/runtime/diagnostics.hpp"
#include "window_ingress/configuration/navigator_node_params.hpp"

namespace window_ingress::adapters {

using configuration::EngagementParams;

/// Whether the vehicle follows setpoints: armed, and in a mode that does. Where nobody says so it is taken
/// to, unless that is `required`; once anybody has said anything, only a recent yes is a yes. Times are those
/// of the steady clock.
class EngagedFreshness {
 public:
  /// Nodes that say it may start a little later, and speak once a second [s].
  static constexpr double kGraceSec = 3.0;

  explicit EngagedFreshness(const EngagementParams& params, double started_sec = steadyNowSec())
      : params_(params), started_sec_(started_sec) {}

  void hear(bool engaged, double now_sec) {
    heard_ = true;
    engaged_ = engaged;
    heard_sec_ = now_sec;
  }

  bool holds(double now_sec) const {
    if (!heard_) return !params_.required;
    return engaged_ && !isSilent(now_sec);
  }

  /// \param topic where it is said, for people
  Health health(const std::string& topic, double now_sec) const {
    if (!heard_ && params_.required && now_sec - started_sec_ <= kGraceSec)
      return {Health::kOk, "waiting for " + topic};
    if (!heard_ && params_.required)
      return {Health::kError, "nothing on " + topic + " yet, and engagement/required: no mission can start"};
    if (!heard_) return {Health::kOk, "nothing on " + topic + ": taken to follow setpoints"};
    if (isSilent(now_sec)) return {Health::kError, topic + " has fallen silent: taken to be out of control"};
    return {Health::kOk,
            engaged_ ? "follows setpoints" : "not armed, or not in a mode that follows setpoints"};
  }

 private:
  bool isSilent(double now_sec) const { return !(now_sec - heard_sec_ <= params_.max_silence_sec); }

  EngagementParams params_;
  double started_sec_;
  bool heard_ = false, engaged_ = false;
  double heard_sec_ = 0.0;
};

/// The navigator's eye on the guard, as the guard has one on the navigator: what reaches the autopilot is
/// heard on `passed_on`. While nobody passes anything on, the navigator itself sends the autopilot zeros, and
/// nothing but zeros, for an autopilot that hears nothing flies its last velocity on for seconds. Times are
/// those of the steady clock.
class GuardMonitor {
 public:
  GuardMonitor(ros::NodeHandle& nh, Diagnostics& diagnostics, const configuration::GuardMonitorParams& params)
      : nh_(nh), params_(params), started_sec_(steadyNowSec()) {
    subscriber_ = subscribeCatching<Setpoint>(nh_, kTopic, 1, diagnostics, [this](const auto&) { hear(); });
    diagnostics.add(kTopic, [this] { return health(); });
  }

  /// Where nobody has been heard so far they are taken to be, unless that is `required`.
  bool passesOn() const {
    if (std::isinf(heard_sec_)) return !params_.required;
    return steadyNowSec() - heard_sec_ <= params_.max_silence_sec;
  }

  void sent() { sent_sec_ = steadyNowSec(); }  ///< there is something to pass on
  /// Zeros past the guard, if it does not pass them on; to be called in each step of a mission.
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

  void hear() {
    heard_sec_ = steadyNowSec();
    if (brake_) brake_.shutdown();
    brake_ = ros::Publisher();
  }

  Health health() const {
    const std::string topic = subscriber_.getTopic();
    if (passesOn() && std::isinf(heard_sec_))
      return {Health::kOk, "nothing on " + topic + ": taken to be passed on"};
    if (passesOn()) return {};
    if (steadyNowSec() - sent_sec_ > params_.max_silence_sec)
      return {Health::kOk, "no setpoints are sent: nothing to pass on"};
    if (std::isinf(heard_sec_) && steadyNowSec() - started_sec_ <= EngagedFreshness::kGraceSec)
      return {Health::kOk, "waiting for " + topic};
    return {Health::kError,
            "nothing on " + topic + " from setpoint_guard: no mission flies, zeros are sent past it"};
  }

  ros::NodeHandle nh_;
  configuration::GuardMonitorParams params_;
  double started_sec_;
  double sent_sec_ = -std::numeric_limits<double>::infinity();
  double heard_sec_ = -std::numeric_limits<double>::infinity();
  ros::Subscriber subscriber_;
  ros::Publisher brake_;  ///< only while it is needed: otherwise the autopilot hears the guard alone
};

/// What detector and pose node lack, heard on /diagnostics: the navigator does not see images itself, and is
/// asked why it does not start.
class UpstreamFaults {
 public:
  UpstreamFaults(ros::NodeHandle& nh, Diagnostics& diagnostics) {
    subscriber_ = subscribeCatching<diagnostic_msgs::DiagnosticArray>(
        nh, "/diagnostics", 20, diagnostics, [this](const auto& message) { hear(*message); });
  }

  /// One for each input that is missing now.
  std::vector<std::string> texts() const {
    std::vector<std::string> texts;
    for (const char* input : kInputs) {
      const auto fault = faults_.find(input);
      if (fault != faults_.end() && steadyNowSec() - fault->second.heard_sec < kForgottenSec)
        texts.push_back(fault->second.text);
    }
    return texts;
  }

 private:
  static constexpr double kForgottenSec = 3.0;  // diagnostics come once a second
  static constexpr std::size_t kLongestText = 200;
  static constexpr const char* kInputs[] = {"window_detector: image", "window_detector: camera_info",
                                            "homography_pose: imu"};

  struct Fault {
    double heard_sec;  ///< on the steady clock
    std::string text;
  };
  void hear(const diagnostic_msgs::DiagnosticArray& message) {
    const std::string& space = ros::this_node::getNamespace();
    const std::string own = space.size() > 1 ? space.substr(1) + "/" : "";
    for (const auto& status : message.status)
      for (const char* input : kInputs)
        if (status.name == own + input) {
          faults_.erase(input);
          if (status.level >= diagnostic_msgs::DiagnosticStatus::ERROR)
            faults_[input] = {steadyNowSec(), status.message.substr(0, kLongestText)};
        }
  }

  std::map<std::string, Fault> faults_;  // by the name of the status
  ros::Subscriber subscriber_;
};

}  // namespace window_ingress::adapters
