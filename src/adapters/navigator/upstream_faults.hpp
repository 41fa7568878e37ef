#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/node_handle.h>

#include <map>
#include <string>
#include <vector>

#include "adapters/runtime/diagnostics.hpp"

namespace window_ingress::adapters {

/// Missing inputs of detector and pose node, and what the autopilot lacks, from /diagnostics: the navigator
/// sees neither itself, but must say why it does not start.
class UpstreamFaults {
 public:
  /// \param nh in the namespace of the other nodes; that of a nodelet's process may be another
  UpstreamFaults(ros::NodeHandle& nh, Diagnostics& diagnostics)
      : prefix_(nh.getNamespace().size() > 1 ? nh.getNamespace().substr(1) + "/" : "") {
    subscriber_ = diagnostics.subscribe(nh, "/diagnostics", 20, &UpstreamFaults::hear, this);
  }

  /// One text for each input that is missing now.
  std::vector<std::string> texts() const {
    std::vector<std::string> texts;
    for (const char* input : kInputs) {
      const auto fault = faults_.find(input);
      if (fault != faults_.end() && steadyNowSec() - fault->second.heard_sec < kForgottenSec)
        texts.push_back(fault->second.text);
    }
    return texts;
  }

  /// One text for each node without a recent status.
  std::vector<std::string> silentNodes() const {
    std::vector<std::string> texts;
    for (const auto& [node, heard_sec] : heard_sec_)
      if (steadyNowSec() - heard_sec > kForgottenSec)
        texts.push_back(node + " says nothing on /diagnostics: does it run?");
    return texts;
  }

 private:
  static constexpr double kForgottenSec = 3.0;  // diagnostics come once a second
  static constexpr std::size_t kLongestText = 200;
  static constexpr const char* kInputs[] = {"window_detector: image", "window_detector: camera_info",
                                            "homography_pose: imu", "engaged_from_mavros: autopilot"};

  static constexpr const char* kDoesNotFollow = "the autopilot does not follow setpoints";

  struct Fault {
    double heard_sec;  ///< on the steady clock
    std::string text;
  };
  void hear(const diagnostic_msgs::DiagnosticArrayConstPtr& message) {
    for (const auto& status : message->status) {
      for (auto& [node, heard_sec] : heard_sec_)
        if (status.name.rfind(prefix_ + node + ": ", 0) == 0) heard_sec = steadyNowSec();
      for (const char* input : kInputs)
        if (status.name == prefix_ + input) {
          faults_.erase(input);
          if (status.level >= diagnostic_msgs::DiagnosticStatus::ERROR ||
              status.message.find(kDoesNotFollow) != std::string::npos)
            faults_[input] = {steadyNowSec(), status.message.substr(0, kLongestText)};
        }
    }
  }

  std::string prefix_;                   // of the names of their statuses
  std::map<std::string, Fault> faults_;  // by name of the status
  std::map<std::string, double> heard_sec_{{"window_detector", steadyNowSec()},
                                           {"homography_pose", steadyNowSec()}};
  ros::Subscriber subscriber_;
};

}  // namespace window_ingress::adapters
