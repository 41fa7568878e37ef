/// Diagnostics of the pose node: results of its checks.
#pragma once

#include <window_ingress/ApparentOpening.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "adapters/runtime/diagnostics.hpp"
#include "window_ingress/estimation/clock_check.hpp"
#include "window_ingress/estimation/consistency_monitor.hpp"
#include "window_ingress/estimation/filter_params.hpp"
#include "window_ingress/estimation/sender_clock.hpp"
#include "window_ingress/estimation/target_estimate.hpp"
#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/openness/openness_verdict.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::adapters {

inline Health framesHealth(const estimation::FramesVerdict& frames) {
  if (frames.state == estimation::FramesVerdict::kWrong)
    return {Health::kError, frames.what + "; no approach"};
  if (frames.state == estimation::FramesVerdict::kUndecided)
    return {Health::kOk, "not verified yet: " + frames.what};
  return {Health::kOk, "camera mounting and velocity frame verified"};
}

/// Warns of a certain offset from 50 ms on. Reports odometry stamped ahead of its arrival (corrected).
inline Health clocksHealth(const std::optional<estimation::ClockCheck::Offset>& offset,
                           const estimation::SenderClock& odometry) {
  std::string ahead;
  if (odometry.aheadSec() > 0.0)
    ahead = formatted("; odometry is stamped %.2f s ahead of its arrival, which is corrected",
                      odometry.aheadSec());
  if (!offset) return {Health::kOk, "known after the first turn in front of a window" + ahead};
  const std::string text =
      formatted("images are stamped %.2f +- %.2f s %s relative to odometry", std::abs(offset->late_sec),
                offset->sigma_sec, offset->late_sec < 0.0 ? "early" : "late");
  if (!offset->isTooLarge()) return {Health::kOk, text + ahead};
  return {Health::kWarn, text + ahead + ": correct the driver's stamps, or the autopilot's time sync"};
}

/// A closed window is not a fault of this node; the navigator acts upon it.
inline Health opennessHealth(const openness::OpennessVerdict& verdict) {
  return {Health::kOk, std::string(openness::toString(verdict.openness)) + ": " + verdict.reason +
                           (verdict.openness == openness::Openness::kOpen
                                ? "; a mirroring pane that shows a nearby scene cannot be told from a room"
                                : "")};
}

inline Health consistencyHealth(const estimation::Consistency& consistency) {
  const std::string text =
      formatted("normalised innovation squared %.2f per degree of freedom over %d of %d images, limit %.1f",
                consistency.mean_nis, consistency.images, estimation::ConsistencyMonitor::kImages,
                estimation::ConsistencyMonitor::kMaxMeanNis);
  if (consistency.contradicted)
    return {Health::kWarn,
            formatted("%d of %d images contradict the estimated window and were not used; of the others: ",
                      consistency.refused, consistency.refused + consistency.images) +
                text};
  return {consistency.consistent ? Health::kOk : Health::kWarn, text};
}

/// Images that show a window while no target is known.
struct UnusedImages {
  void add(const std::string& why_not, const window_ingress::ApparentOpening& opening) {
    ++count;
    why = why_not;
    if (opening.aspect > 0.0) aspect = opening.aspect, aspect_sigma = opening.aspect_sigma;
  }

  int count = 0;
  std::string why;                          ///< why the last image was not used
  double aspect = 0.0, aspect_sigma = 0.0;  ///< width over height of the last window; 0: none
};
/// An error if many images could not be used; names both aspect ratios if the opening's differs.
inline Health targetHealth(const UnusedImages& unused, const geometry::OpeningSize& wanted) {
  constexpr int kMany = 20;
  constexpr double kSigmas = 4.0, kLeastMisfit = 0.02;
  if (unused.count < kMany) return {};
  const std::string seen = formatted("a window is seen in %d images, but used in none: ", unused.count);
  const double said = wanted.width_m / wanted.height_m, misfit = std::abs(unused.aspect / said - 1.0);
  if (unused.aspect == 0.0 || misfit < std::max(kLeastMisfit, kSigmas * unused.aspect_sigma / said))
    return {Health::kError, seen + unused.why};
  return {Health::kError, seen + formatted("it is %.2f times as wide as it is high, but the configured "
                                           "opening, %.2f x %.2f m, is %.2f times",
                                           unused.aspect, wanted.width_m, wanted.height_m, said)};
}

}  // namespace window_ingress::adapters
