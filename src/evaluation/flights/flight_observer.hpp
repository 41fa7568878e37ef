#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "simulation/world.hpp"
#include "window_ingress/detection/detection_trace.hpp"
#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/navigation/navigator.hpp"

namespace window_ingress::evaluation {

/// The window's pose from one image alone.
struct ImageRecord {
  double time_sec = 0.0;  ///< exposure time since the start of the mission
  double yaw_rad = 0.0;   ///< of the window's axis against the camera's
  bool sign_trusted = false;
  double opening_width_m = 0.0, opening_height_m = 0.0;  ///< apparent
  double left_side_px = 0.0, right_side_px = 0.0;
};

/// One step of the navigator with the truth. Positions and velocities are in the true window's frame.
struct FlightRecord {
  double time_sec = 0.0;  ///< since the start of the mission
  navigation::State state = navigation::State::kIdle;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();    ///< true position of the body's centre
  double heading_rad = 0.0;                                ///< true heading against the window's normal
  Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();  ///< truth
  Eigen::Vector3d setpoint_mps = Eigen::Vector3d::Zero();
  double setpoint_yaw_rate_radps = 0.0;
  bool detected = false;    ///< seen in the latest image
  bool has_target = false;  ///< the following fields are set
  bool sign_trusted = false;
  double target_age_sec = 0.0;
  Eigen::Vector3d target_error_m = Eigen::Vector3d::Zero();  ///< estimated less true centre, without drift
  double target_yaw_error_rad = 0.0;
  double target_sigma_m = 0.0;  ///< of the centre, along the window's y
  double target_yaw_sigma_rad = 0.0;
  double predicted_miss_m = 0.0;     ///< predicted by the navigator at its last commit; 0 before
  std::optional<ImageRecord> image;  ///< the last image with a pose
  std::string sighting;              ///< why the last image with a window did not contribute; empty if it did
  std::string reason;
};

/// Observes a flight without changing it: with and without observers a flight is bit-identical. Arguments are
/// valid during the call only.
class FlightObserver {
 public:
  virtual ~FlightObserver() = default;

  /// Called once, before everything else.
  virtual void onStart(const simulation::World&) {}
  /// Called for each image with the detector's result.
  virtual void onImage(const simulation::CameraFrame&, const detection::DetectionTrace&,
                       const std::optional<detection::WindowObservation>&) {}
  virtual void onCalibration(const simulation::CalibrationSample&) {}
  virtual void onOdometry(const simulation::OdometrySample&) {}
  virtual void onImu(const simulation::ImuSample&) {}
  /// Called for each step of the navigator, with the truth.
  virtual void onStep(const FlightRecord&, const navigation::NavigatorOutput&) {}
  /// Called once, after everything else; the last chance to throw.
  virtual void onEnd() {}
};

}  // namespace window_ingress::evaluation
