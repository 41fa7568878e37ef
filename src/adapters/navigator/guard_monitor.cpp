#include "adapters/navigator/guard_monitor.hpp"

#include <cmath>

#include "adapters/conversions/msg_conversion.hpp"
#include "adapters/runtime/exception_barrier.hpp"

namespace window_ingress::adapters {
namespace {

using Setpoint = geometry_msgs::TwistStamped;
constexpr const char* kTopic = "passed_on";

}  // namespace

GuardMonitor::GuardMonitor(ros::NodeHandle& nh, Diagnostics& diagnostics,
                           const configuration::GuardMonitorParams& params)
    : nh_(nh), params_(params), started_sec_(steadyNowSec()) {
  subscriber_ = subscribeCatching<Setpoint>(nh_, kTopic, 1, diagnostics, [this](const auto&) { hear(); });
  diagnostics.add(kTopic, [this] { return health(); });
}

void GuardMonitor::hear() {
  heard_sec_ = steadyNowSec();
  if (brake_) brake_.shutdown();
  brake_ = ros::Publisher();
}

bool GuardMonitor::passesOn() const {
  if (std::isinf(heard_sec_)) return !params_.required;
  return steadyNowSec() - heard_sec_ <= params_.max_silence_sec;
}

void GuardMonitor::brakeIfNobodyDoes(const ros::Time& now, const std::string& frame) {
  if (passesOn()) return;
  if (!brake_) brake_ = nh_.advertise<Setpoint>("brake", 1);
  Setpoint zero;
  zero.header = headerOf(now, frame);
  brake_.publish(zero);
}

Health GuardMonitor::health() const {
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

}  // namespace window_ingress::adapters
