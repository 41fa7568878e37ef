#include "navigation/mission/start_conditions.hpp"

#include <cmath>

#include "window_ingress/navigation/relative_state.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::navigation {
namespace {

constexpr double kRoomToTurnM = 0.3;  // beside a body that turns
constexpr double kEavesM = 2.5;       // from the wall

// From its plane, before or behind it; nothing where the vehicle is clear of the opening.
std::optional<double> distanceInOpening(const VehicleState& vehicle, const TargetEstimate& flown_at,
                                        const VehicleParams& body) {
  const Eigen::Vector3d place_m = relate(vehicle, flown_at).position_window_m;
  const double clear_m = std::hypot(body.half_length_m, body.half_width_m) + kRoomToTurnM;
  const double aside_m = std::abs(place_m.y()) - 0.5 * flown_at.opening.width_m;
  if (std::abs(place_m.x()) > clear_m || aside_m > clear_m) return std::nullopt;
  return std::abs(place_m.x());
}

}  // namespace

bool isUnderRoof(const VehicleState& vehicle, const TargetEstimate& flown_at) {
  return relate(vehicle, flown_at).distance() < kEavesM;
}

std::vector<std::string> unmetToStart(const Situation& situation, bool engaged,
                                      const std::optional<TargetEstimate>& flown_at,
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
  if (const auto plane_m =
          flown_at ? distanceInOpening(*situation.vehicle, *flown_at, params.vehicle) : std::nullopt)
    faults.push_back(
        formatted("in the opening that was flown at before, %.2f m from its plane: take the vehicle a "
                  "metre away from it by hand",
                  *plane_m));
  return faults;
}

}  // namespace window_ingress::navigation
