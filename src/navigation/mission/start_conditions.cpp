#include "navigation/mission/start_conditions.hpp"

#include <algorithm>
#include <cmath>

#include "window_ingress/parameters/fields.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::navigation {

NavigatorParams checked(NavigatorParams params) {
  auto faults = parameters::outOfRange(params);
  for (const auto& fault : parameters::outOfRange(params.vehicle)) faults.push_back("vehicle/" + fault);
  if (!(params.limits.min_height_m < params.limits.max_height_m))
    faults.push_back("limits/min_height_m must be below limits/max_height_m");
  if (params.limits.acceleration_mps2 < params.vehicle.braking_mps2)
    faults.push_back(
        "vehicle/braking_mps2 must not exceed limits/acceleration_mps2: setpoints could not brake so hard; "
        "lower the former, unless the vehicle may accelerate more");
  if (params.commit.exit_distance_m < 2.0 * params.vehicle.half_length_m)
    faults.push_back(
        "commit/exit_distance_m must be the vehicle's length or more (twice vehicle/half_length_m): it would "
        "end "
        "in the opening");
  parameters::throwIfAny(faults, "navigator");
  params.commit.speed_mps = std::min(params.commit.speed_mps, params.limits.speed_mps);
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

}  // namespace window_ingress::navigation
