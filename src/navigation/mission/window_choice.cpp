#include "navigation/mission/window_choice.hpp"

#include <algorithm>

namespace window_ingress::navigation {

constexpr double kSamePlaceM = 0.5;

bool wasLeftForGood(const TargetEstimate& target, const MissionState& mission) {
  return std::any_of(mission.left_odom_m.begin(), mission.left_odom_m.end(),
                     [&](const Eigen::Vector3d& left) {
                       return (left - target.T_odom_window.translation()).norm() < kSamePlaceM;
                     });
}

std::string whySentElsewhere(const Situation& situation, State state, const MissionState& mission) {
  if (state == State::kCommit || !situation.target || !mission.trusted) return "";
  const std::uint32_t now = situation.target->window_id, before = mission.trusted->window_id;
  if (now == 0 || now == before) return "";
  const bool has_got_its_number =
      before == 0 && distanceBetween(*situation.target, *mission.trusted) < kSamePlaceM;
  if (has_got_its_number) return "";
  return "window " + std::to_string(now) + " is now the target instead of " +
         (before == 0 ? "the window approached so far" : "window " + std::to_string(before));
}

void turnToNextWindow(State state, const NavigatorParams& params, MissionState& mission, Decision& decision) {
  const bool tried_in_vain = state == State::kBackOff && decision.event == Event::kGiveUp;
  if (!tried_in_vain || !params.search.next_window || !mission.trusted) return;
  decision.reason += "; trying the next window";
  decision.event = Event::kBackedOff;
  mission.giveUpWindow(*mission.trusted);
  mission.back_offs = 0;
}

}  // namespace window_ingress::navigation
