#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "simulation/world.hpp"
#include "window_ingress/detection/detection_trace.hpp"
#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/navigation/navigator.hpp"

namespace window_ingress::evaluation {

/// What one image alone said of the window.
struct ImageRecord {
  double time_sec = 0.0;  ///< of its exposure, since the start of the mission
  double yaw_rad = 0.0;   ///< of the window's axis against the camera's
  bool sign_trusted = false;
  double opening_width_m = 0.0, opening_height_m = 0.0;  ///< apparent
  double left_side_px = 0.0, right_side_px = 0.0;
};

/// One step of the navigator beside the truth. Positions and velocities in the true window's frame.
struct FlightRecord {
  double time_sec = 0.0;  ///< since the start of the mission
  navigation::State state = navigation::State::kIdle;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();    ///< truth, of the body's centre
  double heading_rad = 0.0;                                ///< truth, against the window's normal
  Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();  ///< truth
  Eigen::Vector3d setpoint_mps = Eigen::Vector3d::Zero();
  double setpoint_yaw_rate_radps = 0.0;
  bool detected = false;    ///< in the latest image
  bool has_target = false;  ///< the rest is set
  bool sign_trusted = false;
  double target_age_sec = 0.0;
  Eigen::Vector3d target_error_m = Eigen::Vector3d::Zero();  ///< estimated less true centre, drift taken out
  double target_yaw_error_rad = 0.0;
  double target_sigma_m = 0.0;  ///< of the centre, along the window's y
  double target_yaw_sigma_rad = 0.0;
  double predicted_miss_m = 0.0;     ///< by the navigator at its last commit; 0 before
  std::optional<ImageRecord> image;  ///< the last one with a pose
  std::string sighting;              ///< why the last image with a window did not contribute; empty if it did
  std::string reason;
};

/// Looks on while a flight is flown, and changes nothing: a flight is the same to the bit with and without.
/// What is handed over is valid during the call only.
class FlightObserver {
 public:
  virtual ~FlightObserver() = default;

  /// Once, before everything else.
  virtual void onStart(const simulation::World&) {}
  /// Each image, with what the detector made of it.
  virtual void onImage(const simulation::CameraFrame&, const detection::DetectionTrace&,
                       const std::optional<detection::WindowObservation>&) {}
  virtual void onCalibration(const simulation::CalibrationSample&) {}
  virtual void onOdometry(const simulation::OdometrySample&) {}
  virtual void onImu(const simulation::ImuSample&) {}
  /// Each step of the navigator, with the truth beside it.
  virtual void onStep(const FlightRecord&, const navigation::NavigatorOutput&) {}
  /// Once, after everything else; the last chance to throw.
  virtual void onEnd() {}
};

}  // namespace window_ingress::evaluation
