#pragma once

#include "navigation/behaviours/behaviour.hpp"
#include "window_ingress/navigation/navigator.hpp"

namespace window_ingress::navigation {

inline NavigatorReport reportOn(const Situation& situation, const MissionState& mission,
                                const NavigatorParams& params) {
  NavigatorReport report;
  report.predicted_miss_m = mission.predicted_miss_m;
  report.blind_sec = mission.blind_sec;
  report.retries = mission.back_offs;
  report.window_id = mission.trusted ? mission.trusted->window_id : 0;
  report.given_up = mission.given_up;
  report.next_window = params.search.next_window;
  const auto& target = mission.committed ? mission.committed : situation.target;
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
