#pragma once

#include <string>

#include "adapters/diagnostics.hpp"
#include "window_ingress/configuration/navigator_node_params.hpp"

namespace window_ingress::adapters {

using configuration::EngagementParams;

/// Whether the vehicle follows setpoints: armed, and in a mode that does. Where nobody says so it is taken
/// to, unless that is `required`; once anybody has said anything, only a recent yes is a yes. Times are those
/// of the steady clock.
class Engagement {
 public:
  explicit Engagement(const EngagementParams& params) : params_(params) {}

  void hear(bool engaged, double now_sec);
  bool holds(double now_sec) const;
  /// \param topic where it is said, for people
  Health health(const std::string& topic, double now_sec) const;

 private:
  bool isSilent(double now_sec) const { return !(now_sec - heard_sec_ <= params_.max_silence_sec); }

  EngagementParams params_;
  bool heard_ = false, engaged_ = false;
  double heard_sec_ = 0.0;
};

}  // namespace window_ingress::adapters
