/// What the navigator's node says of itself in the diagnostics.
#include <cmath>

#include "adapters/navigator/navigator_node.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::adapters {

Health NavigatorNode::missionHealth() const {
  const std::string text = std::string(navigation::toString(last_.state)) + ": " + last_.reason;
  const bool bad = last_.state == navigation::State::kAborted || last_.state == navigation::State::kHold;
  return {bad ? Health::kWarn : Health::kOk, text};
}

Health NavigatorNode::vehicleHealth() const {
  const navigation::MeasuredVehicle& vehicle = last_.report.vehicle;
  std::string said = formatted("answers in %.2f s, as %s", vehicle.response_sec,
                               vehicle.is_measured ? "measured in flight" : "assumed");
  if (std::isfinite(vehicle.acceleration_mps2))
    said += formatted("; changes its velocity by no more than %.1f m/s^2", vehicle.acceleration_mps2);
  if (const double bias_mps = vehicle.velocity_bias_base_mps.norm(); bias_mps > 0.0)
    said += formatted("; odometry's velocity is off by %.2f m/s, which is taken off", bias_mps);
  return {Health::kOk, said};
}

Health NavigatorNode::cameraHealth() const {
  if (!input_.camera_fault.empty()) return {Health::kWarn, input_.camera_fault};
  const navigation::VehicleParams& vehicle = params_.navigator.vehicle;
  return {Health::kOk,
          formatted("%.2f m ahead, sees %.2f x %.2f rad, %.2g rad a pixel: as %s", vehicle.camera_forward_m,
                    vehicle.horizontal_fov_rad, vehicle.vertical_fov_rad, vehicle.pixel_rad,
                    input_.camera ? "camera_info and tf say" : "the parameters vehicle/... say")};
}

Health NavigatorNode::lastGateHealth() const {
  if (gate_fault_.empty()) return {};
  return {Health::kError, "zero is sent in place of a setpoint that must not be: " + gate_fault_};
}

}  // namespace window_ingress::adapters
