#include "adapters/nodes/pose_health.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace window_ingress::adapters {

Health framesHealth(const estimation::FramesVerdict& frames) {
  if (frames.state == estimation::FramesVerdict::kWrong)
    return {Health::kError, frames.what + "; no approach"};
  if (frames.state == estimation::FramesVerdict::kOpen) return {Health::kOk, "to be seen: " + frames.what};
  return {Health::kOk, "camera mounting and velocity frame verified"};
}

Health clocksHealth(const std::optional<estimation::ClockCheck::Offset>& offset,
                    const estimation::SenderClock& odometry) {
  constexpr double kMaxOffsetSec = 0.05, kSigmas = 3.0;
  char text[200] = "";
  if (odometry.aheadSec() > 0.0)
    std::snprintf(text, sizeof text, "; odometry is stamped %.2f s ahead of its arrival, which is taken off",
                  odometry.aheadSec());
  const std::string ahead = text;
  if (!offset) return {Health::kOk, "to be seen in the first turn before a window" + ahead};
  std::snprintf(text, sizeof text, "images are stamped %.2f +- %.2f s %s beside odometry",
                std::abs(offset->late_sec), offset->sigma_sec, offset->late_sec < 0.0 ? "early" : "late");
  const double least_sec = std::max(kMaxOffsetSec, kSigmas * offset->sigma_sec);
  if (std::abs(offset->late_sec) <= least_sec) return {Health::kOk, text + ahead};
  return {Health::kWarn, text + ahead + ": correct the driver's stamps, or the autopilot's time sync"};
}

// Closed is no fault of the node's: it is for the navigator to act upon.
Health opennessHealth(const openness::OpennessVerdict& verdict) {
  return {Health::kOk, std::string(openness::toString(verdict.openness)) + ": " + verdict.reason +
                           (verdict.openness == openness::Openness::kOpen
                                ? "; a mirroring pane that shows a nearby scene cannot be told from a room"
                                : "")};
}

Health consistencyHealth(const estimation::Consistency& consistency) {
  char text[160];
  std::snprintf(text, sizeof text,
                "normalised innovation squared %.2f a degree of freedom over %d of %d images, limit %.1f",
                consistency.mean_nis, consistency.images, estimation::ConsistencyMonitor::kImages,
                estimation::ConsistencyMonitor::kMaxMeanNis);
  const bool is_good = consistency.consistent && !consistency.contradicted;
  return {
      is_good ? Health::kOk : Health::kWarn,
      text + std::string(consistency.contradicted ? "; most images contradict the window that was made out"
                                                  : "")};
}

}  // namespace window_ingress::adapters
