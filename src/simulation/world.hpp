#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>

#include "simulation/referee.hpp"
#include "simulation/scenario/scenario.hpp"
#include "simulation/sensors/faults.hpp"
#include "simulation/sensors/imu_sensor.hpp"
#include "simulation/sensors/odometry_sensor.hpp"
#include "simulation/vehicle/quadrotor.hpp"
#include "simulation/vehicle/vehicle_truth.hpp"
#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::simulation {

/// An image as the camera delivers it.
struct CameraFrame {
  double stamp_sec = 0.0;  ///< of the exposure
  cv::Mat image;  ///< CV_8UC3, BGR; valid until the next call of `World::takeFrame`; empty: not drawn
  Eigen::Isometry3d T_camera_window = Eigen::Isometry3d::Identity();  ///< truth at the exposure
  VehicleTruth truth;
};

/// House, vehicle, sensors and referee of one scenario and seed. Deterministic: the same calls give the same
/// bytes.
///
/// Time starts at 0 and moves only in `advance`. After each `advance`, each `take...` hands out what became
/// due and forgets it, one at a time and in order: ask until there is none, they may come in bursts. An
/// image is drawn only when it is taken. A vehicle that touched anything solid stops there, with its motors
/// off, and falls. Not for use from several threads, but several worlds may live in several threads.
class World {
 public:
  /// Whether frames have images. Without, no renderer is needed, and nothing that becomes of an image
  /// matters: light, noise, faults that spoil it.
  enum class Images { kDrawn, kNone };

  /// \throws ScenarioError if the scenario cannot be built, std::runtime_error if there is no software
  /// renderer.
  World(const Scenario& scenario, std::uint32_t seed, Images images = Images::kDrawn);
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /// Moves the world on by one physics step (`kStepSec`).
  void advance();
  static constexpr double kStepSec = 0.0025;

  /// In the axes of the odometry as the vehicle knows it, drift included.
  void command(const VelocityCommand& command);

  /// For `vehicle: external`: the vehicle is there at that time; until then, `advance` moves it evenly.
  /// How fast it is, the referee sees by its places; the twist only blurs images.
  /// \param stamp_sec after the time of the call before; the first one also says where it has been so far
  void follow(const VehicleTruth& truth, double stamp_sec);

  double timeSec() const;
  const VehicleTruth& truth() const;
  std::optional<CameraFrame> takeFrame();
  /// The same in two steps, for whoever cannot draw every image in time.
  std::optional<Exposure> takeExposure();
  CameraFrame draw(const Exposure& exposure);
  std::optional<OdometrySample> takeOdometry();
  std::optional<ImuSample> takeImu();
  /// What camera_info says: one sample an image, however the image fares. May be spoilt, see `validate`.
  std::optional<CalibrationSample> takeCalibration();
  /// The odometry as the source of the transform odom -> base_link.
  std::optional<OdometrySample> takeTransform();
  /// What a clock says that is asked now, or nothing.
  std::optional<double> readClock();

  /// From now on. \throws ScenarioError if there can be no such fault
  void inject(FaultParams fault);

  const geometry::PinholeCamera& camera() const;
  Eigen::Isometry3d T_base_camera() const;
  Eigen::Isometry3d T_odom_window() const;  ///< truth, of the target: the opening's front inner border
  /// Where the odometry's frame has drifted to: `p_reported = drift * p_true`.
  Eigen::Isometry3d odometryDrift() const;
  geometry::OpeningSize opening() const;
  Eigen::Vector3d vehicleHalfExtents() const;  ///< of the body's box [m]
  const Scenario& scenario() const;
  const Referee& referee() const;
  /// As `simulation::referenceImage` of the scenario.
  cv::Mat referenceImage(geometry::Quadrilateral* corners) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace window_ingress::simulation
