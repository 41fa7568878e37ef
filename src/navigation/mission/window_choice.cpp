#include "navigation/mission/window_choice.hpp"

#include <algorithm>
#include <cmath>

#include "navigation/mission/opening_policy.hpp"

namespace window_ingress::navigation {

constexpr double kSamePlaceM = 0.5;

bool wasLeftForGood(const TargetEstimate& target, const MissionState& mission) {
  return std::any_of(mission.left_odom_m.begin(), mission.left_odom_m.end(),
                     [&](const Eigen::Vector3d& left) {
                       return (left - target.T_odom_window.translation()).norm() < kSamePlaceM;
                     });
}

std::string whyOtherWindow(const TargetEstimate& target) {
  return target.other_window ? target.approach_forbidden : whyClosed(target);
}

void leaveOtherWindow(const Situation& situation, MissionState& mission) {
  const auto& target = *situation.target;
  if (!target.other_window) return mission.giveUpWindow(target);
  const Eigen::Vector3d position = situation.vehicle->T_odom_base.translation();
  mission.others_odom_m.push_back(position +
                                  *target.other_window * (target.T_odom_window.translation() - position));
  ++mission.others;
  if (target.window_id != 0) mission.given_up.push_back(target.window_id);
  mission.leaveWindow();
}

bool isKnownOther(const TargetEstimate& target, const VehicleState& vehicle, const MissionState& mission) {
  if (wasLeftForGood(target, mission)) return true;
  constexpr double kSameDirectionRad = 0.12;
  const Eigen::Vector3d position = vehicle.T_odom_base.translation();
  const Eigen::Vector3d sight = (target.T_odom_window.translation() - position).normalized();
  return std::any_of(mission.others_odom_m.begin(), mission.others_odom_m.end(),
                     [&](const Eigen::Vector3d& other) {
                       return sight.dot((other - position).normalized()) > std::cos(kSameDirectionRad);
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
