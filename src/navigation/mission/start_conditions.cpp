#include "navigation/mission/start_conditions.hpp"

#include <cmath>

#include "window_ingress/text/text.hpp"

namespace window_ingress::navigation {
std::vector<std::string> unmetToStart(const Situation& situation, bool engaged, const FlownWindow& flown_at,
                                      const NavigatorParams& params) {
  std::vector<std::string> faults;
  if (!std::isfinite(situation.now_sec)) faults.push_back("no valid time");
  if (!situation.vehicle) faults.push_back(situation.vehicle_fault);
  if (!situation.image_fault.empty()) faults.push_back(situation.image_fault);
  if (!situation.camera_fault.empty()) faults.push_back(situation.camera_fault);
  if (!situation.setpoint_fault.empty()) faults.push_back(situation.setpoint_fault);
  if (!engaged) faults.push_back("the vehicle is not armed or not in a mode that follows setpoints");
  if (!situation.vehicle) return faults;
  if (situation.vehicle->T_odom_base.translation().z() > params.limits.max_height_m) {
    faults.push_back("above limits/max_height_m");
  }
  if (const auto plane_m = flown_at.distanceInOpening(*situation.vehicle, params.vehicle))
    faults.push_back(
        formatted("in the opening that was flown at before, %.2f m from its plane: take the vehicle a "
                  "metre away from it by hand",
                  *plane_m));
  return faults;
}

}  // namespace window_ingress::navigation
