#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>

#include "simulation/camera/camera_sensor.hpp"
#include "simulation/referee.hpp"
#include "simulation/scenario/scenario.hpp"
#include "simulation/scene/scene.hpp"
#include "simulation/schedule.hpp"
#include "simulation/sensors/faults.hpp"
#include "simulation/sensors/imu_sensor.hpp"
#include "simulation/sensors/odometry_sensor.hpp"
#include "simulation/vehicle/followed_vehicle.hpp"
#include "simulation/vehicle/quadrotor.hpp"
#include "simulation/vehicle/sway.hpp"
#include "simulation/vehicle/vehicle_truth.hpp"
#include "simulation/vehicle/wind.hpp"
#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::simulation {

/// An image as delivered by the camera.
struct CameraFrame {
  double stamp_sec = 0.0;  ///< time of the exposure
  cv::Mat image;  ///< CV_8UC3, BGR; valid until the next call of `World::takeFrame`; empty: not drawn
  Eigen::Isometry3d T_camera_window = Eigen::Isometry3d::Identity();  ///< truth at the exposure
};

/// House, vehicle, sensors and referee of one scenario and seed. Deterministic: the same calls give the same
/// bytes.
///
/// Time starts at 0 and moves only in `advance`. After each `advance`, each `take...` returns what has become
/// due, one item at a time and in order: call until empty, because items may come in bursts. An image is
/// drawn only when it is taken. A vehicle that touches anything solid stops there with its motors off, and
/// falls. One world must not be used from several threads, but several worlds may live in several threads.
class World {
 public:
  /// Whether frames have images. Without images no renderer is needed, and nothing that only changes images
  /// has an effect: light, noise, faults that spoil images.
  enum class Images { kDrawn, kNone };

  /// \throws InputError if the scenario cannot be built, std::runtime_error if there is no software renderer.
  World(const Scenario& scenario, std::uint32_t seed, Images images = Images::kDrawn);
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /// Advances the world by one physics step (`kStepSec`).
  void advance();
  static constexpr double kStepSec = 0.0025;

  /// Command in the axes of the vehicle's odometry, drift included.
  void command(const VelocityCommand& command);

  /// For `vehicle: external`: gives the vehicle's state at this time, towards which `advance` moves it
  /// evenly. The referee computes the speed from positions; the twist only blurs images.
  /// \param stamp_sec later than in the previous call; the first call also sets the place until then
  void follow(const VehicleTruth& truth, double stamp_sec) { followed_.follow(truth, stamp_sec); }

  double timeSec() const { return time_sec_; }
  const VehicleTruth& truth() const;
  std::optional<CameraFrame> takeFrame();
  /// `takeFrame` in two steps, for callers that cannot draw every image in time.
  std::optional<Exposure> takeExposure() { return images_.take(time_sec_, acting("image")); }
  CameraFrame draw(const Exposure& exposure);
  std::optional<OdometrySample> takeOdometry() { return odometry_line_.take(time_sec_, acting("odom")); }
  std::optional<ImuSample> takeImu() { return imu_line_.take(time_sec_, acting("imu")); }
  /// camera_info: one sample an image, whatever its faults. May be invalid, see `PinholeCamera::validate`.
  std::optional<CalibrationSample> takeCalibration() {
    return calibrations_.take(time_sec_, acting("camera_info"));
  }
  /// The odometry as source of the transform odom -> base_link.
  std::optional<OdometrySample> takeTransform() { return transforms_.take(time_sec_, acting("tf")); }
  /// The present reading of the clock, or empty.
  std::optional<double> readClock();

  /// The fault that acts on this unit now, or null.
  const FaultParams* acting(const char* unit) const { return faults_.acting(unit, time_sec_); }
  /// Adds a fault that begins now. \throws InputError if the fault is impossible
  void inject(const FaultParams& fault);

  const geometry::PinholeCamera& camera() const { return model_; }
  Eigen::Isometry3d T_base_camera() const { return scenario_.camera.toldT_base_camera(); }
  Eigen::Isometry3d T_odom_window() const;  ///< true pose of the target: the opening's front inner border
  /// Drift of the odometry's frame: `p_reported = drift * p_true`.
  Eigen::Isometry3d odometryDrift() const { return odometry_.drift(); }
  geometry::OpeningSize opening() const { return scenario_.opening(); }
  const Scenario& scenario() const { return scenario_; }
  const Referee& referee() const { return referee_; }

 private:
  bool external() const { return scenario_.vehicle.profile == "external"; }
  VehicleTruth besideHouse() const;
  VehicleTruth judged() const;
  void move();
  void sense();
  void expose();
  double restHeight() const;
  void deliver();
  void obey();

  Scenario scenario_;
  std::uint32_t seed_;
  Scene scene_;
  geometry::PinholeCamera model_;
  Eigen::Isometry3d T_base_camera_, T_odom_window_;  ///< T_odom_window_: for the house at its resting place
  Sway sway_;
  std::unique_ptr<CameraSensor> camera_;  ///< null: no images
  Wind wind_;
  Quadrotor quadrotor_;
  OdometrySensor odometry_;
  ImuSensor imu_;
  FollowedVehicle followed_;
  FaultPlan faults_;
  FaultLine<VelocityCommand> commands_;
  FaultLine<OdometrySample> odometry_line_, transforms_;
  FaultLine<ImuSample> imu_line_;
  FaultLine<CalibrationSample> calibrations_;
  FaultLine<Exposure> images_;
  FaultLine<double> clock_;
  Periodic shutter_;
  CameraTransport transport_;
  DelayLine<Exposure> exposures_;
  Referee referee_;
  long steps_ = 0;
  std::uint64_t exposure_count_ = 0;
  double time_sec_ = 0.0;
};

}  // namespace window_ingress::simulation
