#pragma once

#include <string>

#include "adapters/diagnostics.hpp"

namespace window_ingress::adapters {

struct EngagementParams {
  bool required =
      false;  ///< a mission may only start once somebody has said that the vehicle follows setpoints
  double max_silence_sec = 3.0;  ///< who has said so once must go on saying it [s]
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("required", self.required);
    field("max_silence_sec", self.max_silence_sec, 0.1, 60.0);
  }
};

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
