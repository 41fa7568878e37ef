#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/node_handle.h>

#include <map>
#include <string>
#include <vector>

#include "adapters/runtime/diagnostics.hpp"

namespace window_ingress::adapters {

/// What detector and pose node lack, heard on /diagnostics: the navigator does not see images itself, and is
/// asked why it does not start.
class UpstreamFaults {
 public:
  UpstreamFaults(ros::NodeHandle& nh, Diagnostics& diagnostics);

  std::vector<std::string> texts() const;  ///< one for each input that is missing now

 private:
  struct Fault {
    double heard_sec;  ///< on the steady clock
    std::string text;
  };
  void hear(const diagnostic_msgs::DiagnosticArray& message);

  std::map<std::string, Fault> faults_;  // by the name of the status
  ros::Subscriber subscriber_;
};

}  // namespace window_ingress::adapters
