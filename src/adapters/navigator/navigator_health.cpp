/// Stale inputs of the navigator's node, and its diagnostics.
#include <cmath>

#include "adapters/navigator/navigator_node.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::adapters {
namespace {

constexpr double kFrozenClockSec = 0.2;

}  // namespace

void NavigatorNode::reportHealth() {
  diagnostics_.add("engaged",
                   [this] { return engagement_.health(engaged_subscriber_.getTopic(), steadyNowSec()); });
  odom_health_.watch(odom_subscriber_);
  pose_health_.watch(pose_subscriber_);
  diagnostics_.addOutput("cmd_vel", {setpoint_publisher_});
  diagnostics_.add("mission", [this] { return missionHealth(); });
  diagnostics_.add("vehicle", [this] { return vehicleHealth(); });
  diagnostics_.add("camera", [this] { return cameraHealth(); });
  diagnostics_.add("last_gate", [this] { return lastGateHealth(); });
}

// Drops inputs that no longer arrive, whatever their stamps: the ROS clock may stand still.
void NavigatorNode::forgetSilentInputs() {
  if (odom_health_.silentSec() > params_.max_silence_sec) input_.vehicle.reset();
  if (pose_health_.silentSec() > params_.max_pose_silence_sec) {
    input_.target.reset();
    input_.camera_fault.clear();
  }
  input_.engaged = engagement_.holds(steadyNowSec());
  input_.passed_on = guard_.passesOn();
}

bool NavigatorNode::clockStandsStill(double now_sec) {
  const double steady_sec = steadyNowSec();
  if (now_sec != last_now_sec_) clock_moved_sec_ = steady_sec;
  last_now_sec_ = now_sec;
  return now_sec == 0.0 || steady_sec - clock_moved_sec_ > kFrozenClockSec;
}

Health NavigatorNode::missionHealth() const {
  const std::string text = std::string(navigation::toString(last_.state)) + ": " + last_.reason;
  const bool bad = last_.state == navigation::State::kAborted || last_.state == navigation::State::kHold;
  return {bad ? Health::kWarn : Health::kOk, text};
}

Health NavigatorNode::vehicleHealth() const {
  const navigation::MeasuredVehicle& vehicle = last_.report.vehicle;
  std::string said = formatted("response time %.2f s, %s", vehicle.response_sec,
                               vehicle.is_measured ? "measured in flight" : "assumed");
  if (std::isfinite(vehicle.acceleration_mps2))
    said += formatted("; acceleration up to %.1f m/s^2", vehicle.acceleration_mps2);
  if (const double bias_mps = vehicle.velocity_bias_base_mps.norm(); bias_mps > 0.0)
    said += formatted("; velocity bias of odometry %.2f m/s, subtracted", bias_mps);
  return {Health::kOk, said};
}

Health NavigatorNode::cameraHealth() const {
  if (!input_.camera_fault.empty()) return {Health::kWarn, input_.camera_fault};
  const navigation::CameraInBody& camera = params_.navigator.vehicle.camera;
  return {Health::kOk,
          formatted("%.2f m ahead, field of view %.2f x %.2f rad, %.2g rad per pixel, from %s",
                    camera.forward_m, camera.horizontal_fov_rad, camera.vertical_fov_rad, camera.pixel_rad,
                    input_.camera ? "camera_info and tf" : "the parameters vehicle/...")};
}

Health NavigatorNode::lastGateHealth() const {
  if (last_gate_.fault().empty()) return {};
  return {Health::kError, "an invalid setpoint is replaced by zero: " + last_gate_.fault()};
}

}  // namespace window_ingress::adapters
