#include "adapters/inputs/engaged_freshness.hpp"

namespace window_ingress::adapters {

void EngagedFreshness::hear(bool engaged, double now_sec) {
  heard_ = true;
  engaged_ = engaged;
  heard_sec_ = now_sec;
}

bool EngagedFreshness::holds(double now_sec) const {
  if (!heard_) return !params_.required;
  return engaged_ && !isSilent(now_sec);
}

Health EngagedFreshness::health(const std::string& topic, double now_sec) const {
  if (!heard_ && params_.required && now_sec - started_sec_ <= kGraceSec)
    return {Health::kOk, "waiting for " + topic};
  if (!heard_ && params_.required)
    return {Health::kError, "nothing on " + topic + " yet, and engagement/required: no mission can start"};
  if (!heard_) return {Health::kOk, "nothing on " + topic + ": taken to follow setpoints"};
  if (isSilent(now_sec)) return {Health::kError, topic + " has fallen silent: taken to be out of control"};
  return {Health::kOk, engaged_ ? "follows setpoints" : "not armed, or not in a mode that follows setpoints"};
}

}  // namespace window_ingress::adapters
