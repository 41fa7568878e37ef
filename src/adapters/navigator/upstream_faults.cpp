#include "adapters/navigator/upstream_faults.hpp"

#include <ros/this_node.h>

#include "adapters/runtime/exception_barrier.hpp"

namespace window_ingress::adapters {
namespace {

constexpr double kForgottenSec = 3.0;  // diagnostics come once a second
constexpr std::size_t kLongestText = 200;
const char* const kInputs[] = {"window_detector: image", "window_detector: camera_info",
                               "homography_pose: imu"};

}  // namespace

UpstreamFaults::UpstreamFaults(ros::NodeHandle& nh, Diagnostics& diagnostics) {
  subscriber_ = subscribeCatching<diagnostic_msgs::DiagnosticArray>(
      nh, "/diagnostics", 20, diagnostics, [this](const auto& message) { hear(*message); });
}

void UpstreamFaults::hear(const diagnostic_msgs::DiagnosticArray& message) {
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

std::vector<std::string> UpstreamFaults::texts() const {
  std::vector<std::string> texts;
  for (const char* input : kInputs) {
    const auto fault = faults_.find(input);
    if (fault != faults_.end() && steadyNowSec() - fault->second.heard_sec < kForgottenSec)
      texts.push_back(fault->second.text);
  }
  return texts;
}

}  // namespace window_ingress::adapters
