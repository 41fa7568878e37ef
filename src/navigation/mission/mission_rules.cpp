#include "navigation/mission/mission_rules.hpp"

#include <cmath>

#include "navigation/mission/window_choice.hpp"
#include "window_ingress/parameters/fields.hpp"
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

NavigatorParams checked(NavigatorParams params) {
  auto faults = parameters::outOfRange(params);
  for (const auto& fault : parameters::outOfRange(params.vehicle)) faults.push_back("vehicle/" + fault);
  if (!(params.limits.min_height_m < params.limits.max_height_m))
    faults.push_back("limits/min_height_m must be below limits/max_height_m");
  if (params.limits.acceleration_mps2 < params.vehicle.braking_mps2)
    faults.push_back(
        "vehicle/braking_mps2 must not exceed limits/acceleration_mps2: setpoints could not brake so hard; "
        "lower the former, unless the vehicle may accelerate more");
  parameters::throwIfAny(faults, "navigator");
  params.input.max_future_sec = params.vehicle.stamps.max_future_sec;
  return params;
}

std::vector<std::string> unmetToStart(const Situation& situation, bool engaged, const FlownWindow& flown_at,
                                      const NavigatorParams& params) {
  std::vector<std::string> faults;
  if (!std::isfinite(situation.now_sec)) faults.push_back("no valid time");
  if (!situation.vehicle) faults.push_back(situation.vehicle_fault);
  for (const std::string* fault :
       {&situation.image_fault, &situation.camera_fault, &situation.setpoint_fault})
    if (!fault->empty()) faults.push_back(*fault);
  if (!engaged)
    faults.push_back("the vehicle is not armed, not in a mode that follows setpoints, or in a failsafe");
  if (!situation.vehicle) return faults;
  if (situation.vehicle->T_odom_base.translation().z() > params.limits.max_height_m)
    faults.push_back("the vehicle is above limits/max_height_m");
  if (const auto plane_m = flown_at.distanceInOpening(*situation.vehicle, params.vehicle))
    faults.push_back(
        formatted("the vehicle is in the opening of the previous mission, %.2f m from its plane: take it a "
                  "metre away by hand",
                  *plane_m));
  return faults;
}

std::string whatTimedOut(State state, const MissionClock& clock, const TimeoutParams& timeouts) {
  if (clock.inMissionSec() > timeouts.total_sec)
    return std::string("mission timed out in ") + toString(state);
  if (clock.inStateSec() > timeoutOf(state, timeouts)) return std::string(toString(state)) + " timed out";
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
