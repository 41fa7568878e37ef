#pragma once

#include <string>

#include "adapters/runtime/diagnostics.hpp"
#include "window_ingress/configuration/navigator_node_params.hpp"

namespace window_ingress::adapters {

using configuration::EngagementParams;

/// Whether the vehicle is engaged: armed, and in a mode that follows setpoints. Without any message it counts
/// as engaged, unless `required`. After the first message only a recent yes counts. Times are on the steady
/// clock.
class EngagementMonitor {
 public:
  /// Nodes that report engagement may start a little later, and report once a second [s].
  static constexpr double kGraceSec = 3.0;

  explicit EngagementMonitor(const EngagementParams& params, double started_sec = steadyNowSec())
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

  /// \param topic name of the topic, for the text \param sources number of its publishers
  Health health(const std::string& topic, double now_sec, int sources = 1) const {
    if (!heard_ && params_.required && now_sec - started_sec_ <= kGraceSec)
      return {Health::kOk, "waiting for " + topic};
    if (!heard_ && params_.required)
      return {Health::kError,
              "nothing on " + topic + " yet, but engagement/required is set: no mission can start"};
    if (!heard_) return {Health::kOk, "nothing on " + topic + ": assumed to follow setpoints"};
    if (isSilent(now_sec))
      return {Health::kError, topic + " has fallen silent: assumed to be out of control"};
    const std::string said =
        engaged_ ? "follows setpoints" : "not armed, not in a mode that follows setpoints, or in a failsafe";
    if (sources > 1) return {Health::kWarn, "more than one source on " + topic + ": " + said};
    return {Health::kOk, said};
  }

 private:
  bool isSilent(double now_sec) const { return !(now_sec - heard_sec_ <= params_.max_silence_sec); }

  EngagementParams params_;
  double started_sec_;
  bool heard_ = false, engaged_ = false;
  double heard_sec_ = 0.0;
};

}  // namespace window_ingress::adapters
