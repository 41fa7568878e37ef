#include "navigation/mission/mission_rules.hpp"

#include <cmath>

#include "navigation/mission/window_choice.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::navigation {
namespace {
constexpr double kMaxShiftM = 0.8;  // a window further than this from the one flown at is another one

double timeoutOf(State state, const TimeoutParams& timeouts) {
  if (state == State::kSearch) return timeouts.search_sec;
  if (state == State::kAlign) return timeouts.align_sec;
  if (state == State::kApproach) return timeouts.approach_sec;
  if (state == State::kCommit) return timeouts.commit_sec;
  if (state == State::kBackOff) return timeouts.back_off_sec;
  return timeouts.total_sec;
}
}  // namespace

std::string whatTimedOut(State state, const MissionClock& clock, const MissionState& mission,
                         const NavigatorParams& params) {
  if (clock.inMissionSec() > params.timeouts.total_sec)
    return std::string("mission timed out in ") + toString(state);
  const bool asked = state == State::kApproach && (mission.opening_asked || mission.opening_confirmed);
  const double wait_sec = asked ? params.commit.ask_sec : 0.0;
  if (clock.inStateSec() > timeoutOf(state, params.timeouts) + wait_sec)
    return std::string(toString(state)) + " timed out";
  return "";
}

std::string missingInput(State state, const Situation& situation) {
  if (!situation.vehicle) return situation.vehicle_fault;
  if (!situation.setpoint_fault.empty()) return situation.setpoint_fault;
  if (state == State::kSearch) return situation.image_fault;
  const bool needs_target = state == State::kAlign || state == State::kApproach;
  return needs_target && !situation.target ? situation.target_fault : "";
}

std::string howItMovesBeside(const DisturbanceObserver& observer, const InputParams& params) {
  const double turned_rad = observer.turnedRad();
  if (std::abs(turned_rad) > params.max_turned_rad)
    return formatted(
        "the vehicle moves %.2f rad off the commanded direction: setpoints and odometry differ in axes",
        turned_rad);
  if (observer.isUpsideDown() && params.max_turned_rad < M_PI)
    return "odometry sinks where the vehicle is told to climb, or climbs where told to sink: setpoints and "
           "odometry differ in axes, here z, which must point up";
  return "";
}

std::string whyNotFlownAt(const TargetEstimate& target, const VehicleState& vehicle, State state,
                          const MissionState& mission) {
  if (target.sign_trusted && relate(vehicle, target).distance() <= 0.0) return "window: seen from behind";
  const bool is_left = state == State::kHold || state == State::kBackOff;
  if (is_left && wasLeftForGood(target, mission)) return "a window given up before";
  if (!mission.trusted) {
    return is_left && isKnownOther(target, vehicle, mission) ? "a window known not to be the target" : "";
  }
  const double shift_m = distanceBetween(target, *mission.trusted);
  return shift_m <= kMaxShiftM ? "" : formatted("another window, %.1f m from the one flown at", shift_m);
}

}  // namespace window_ingress::navigation
