#pragma once

#include "navigation/behaviours/behaviour.hpp"
#include "window_ingress/navigation/navigator.hpp"

namespace window_ingress::navigation {

inline NavigatorReport reportOn(const Situation& situation, const MissionState& memory,
                                const NavigatorParams& params) {
  NavigatorReport report;
  report.predicted_miss_m = memory.predicted_miss_m;
  report.blind_sec = memory.blind_sec;
  report.retries = memory.back_offs;
  report.window_id = memory.trusted ? memory.trusted->window_id : 0;
  report.given_up = memory.given_up;
  report.next_window = params.search.next_window;
  const auto& target = memory.committed ? memory.committed : situation.target;
  if (!target || !situation.vehicle) return report;
  const RelativeState relative = relate(*situation.vehicle, *target);
  report.has_relative = true;
  report.lateral_m = relative.lateral();
  report.vertical_m = relative.vertical();
  report.distance_m = relative.distance();
  report.commit_distance_m = commitDistance(relative, target->opening, pitchOf(*situation.vehicle), params);
  return report;
}

}  // namespace window_ingress::navigation
