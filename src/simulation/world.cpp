#include "window_ingress/simulation/world.hpp"

#include <algorithm>
#include <stdexcept>

#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/parameters/fields.hpp"
#include "window_ingress/simulation/camera_sensor.hpp"
#include "window_ingress/simulation/scene.hpp"
#include "window_ingress/simulation/wind.hpp"

namespace window_ingress::simulation {
namespace {

constexpr double kReferenceDistance_m = 2.5;
constexpr double kReferencePart = 0.5;  // of the picture's width or height that the opening may fill

const Scenario& checked(const Scenario& scenario) {
  const auto faults = faultsOf(scenario);
  if (!faults.empty()) throw ScenarioError("scenario: " + parameters::joined(faults));
  return scenario;
}

Course courseOf(const Scenario& scenario, const Scene& scene) {
  Course course;
  course.T_odom_window = scenario.T_odom_window();
  course.opening = scenario.opening();
  course.wall_thickness_m = scene.opening_depth_m;
  course.vehicle_half_extents_m = scenario.vehicle.halfExtents();
  course.obstacles = scene.obstacles;
  course.time_limit_sec = scenario.time_limit_sec;
  course.ground_z_m = scene.ground_z_m;
  return course;
}

std::unique_ptr<CameraSensor> makeCamera(const Scene& scene, const CameraParams& params, std::uint32_t seed) {
  try {
    return std::make_unique<CameraSensor>(scene, params, seed);
  } catch (const std::invalid_argument& error) {
    throw ScenarioError(std::string("scenario: ") + error.what());
  }
}

}  // namespace

struct World::Impl {
  struct Exposure {
    std::uint64_t index;
    double stamp_sec;
    VehicleTruth truth;
  };

  Impl(const Scenario& given, std::uint32_t seed)
      : scenario(checked(given)),
        scene(buildScene(scenario)),
        model(scenario.camera.model()),
        T_base_camera(scenario.camera.T_base_camera()),
        T_odom_window(scenario.T_odom_window()),
        camera(makeCamera(scene, scenario.camera, seed)),
        wind(scenario.wind, seed),
        quadrotor(scenario.vehicle, scenario.startPoseInOdom(),
                  T_odom_window.linear() * wind.steadyInWindow()),
        odometry(scenario.odometry, seed),
        imu(scenario.imu, seed),
        shutter(scenario.camera.rate_hz),
        exposures(scenario.camera.latency_sec),
        referee(courseOf(scenario, scene)) {}

  void sense() {
    const VehicleTruth& truth = quadrotor.truth();
    odometry.update(time_sec, truth);
    imu.update(time_sec, truth, quadrotor.specificForceBase(), odometry.drift());
    if (shutter.due(time_sec)) exposures.push(time_sec, {exposure_count++, time_sec, truth});
    referee.update(time_sec, truth);
  }

  Eigen::Isometry3d cameraInWindow(const VehicleTruth& truth) const {
    return T_odom_window.inverse() * truth.T_odom_base * T_base_camera;
  }

  Scenario scenario;
  Scene scene;
  geometry::PinholeCamera model;
  Eigen::Isometry3d T_base_camera, T_odom_window;
  std::unique_ptr<CameraSensor> camera;
  Wind wind;
  Quadrotor quadrotor;
  OdometrySensor odometry;
  ImuSensor imu;
  Periodic shutter;
  DelayLine<Exposure> exposures;
  Referee referee;
  long steps = 0;
  std::uint64_t exposure_count = 0;
  double time_sec = 0.0;
};

World::World(const Scenario& scenario, std::uint32_t seed) : impl_(std::make_unique<Impl>(scenario, seed)) {}

World::~World() = default;

void World::advance() {
  impl_->quadrotor.step(kStepSec, impl_->T_odom_window.linear() * impl_->wind.step(kStepSec));
  impl_->time_sec = static_cast<double>(++impl_->steps) * kStepSec;
  impl_->sense();
}

void World::command(const VelocityCommand& command) {
  VelocityCommand true_axes = command;
  true_axes.velocity_odom_mps = impl_->odometry.drift().linear().transpose() * command.velocity_odom_mps;
  impl_->quadrotor.command(true_axes);
}

double World::timeSec() const { return impl_->time_sec; }

const VehicleTruth& World::truth() const { return impl_->quadrotor.truth(); }

std::optional<CameraFrame> World::takeFrame() {
  const auto exposure = impl_->exposures.take(impl_->time_sec);
  if (!exposure) return std::nullopt;
  CameraFrame frame;
  frame.stamp_sec = exposure->stamp_sec;
  frame.truth = exposure->truth;
  frame.T_camera_window = impl_->cameraInWindow(exposure->truth).inverse();
  frame.image = impl_->camera->expose(frame.T_camera_window, exposure->index);
  return frame;
}

std::optional<OdometrySample> World::takeOdometry() { return impl_->odometry.take(impl_->time_sec); }

std::optional<ImuSample> World::takeImu() { return impl_->imu.take(impl_->time_sec); }

const geometry::PinholeCamera& World::camera() const { return impl_->model; }

Eigen::Isometry3d World::T_base_camera() const { return impl_->T_base_camera; }

Eigen::Isometry3d World::T_odom_window() const { return impl_->T_odom_window; }

Eigen::Isometry3d World::odometryDrift() const { return impl_->odometry.drift(); }

geometry::OpeningSize World::opening() const { return impl_->scenario.opening(); }

Eigen::Vector3d World::vehicleHalfExtents() const { return impl_->scenario.vehicle.halfExtents(); }

const Scenario& World::scenario() const { return impl_->scenario; }

const Referee& World::referee() const { return impl_->referee; }

cv::Mat World::referencePicture(geometry::Quadrilateral* corners) const {
  CameraParams params = impl_->scenario.camera;
  params.k1 = params.k2 = params.p1 = params.p2 = params.k3 = 0.0;
  const geometry::PinholeCamera ideal = params.model();
  const geometry::OpeningSize size = opening();
  const double distance_m =
      std::max({kReferenceDistance_m, ideal.fx * size.width_m / (kReferencePart * ideal.width),
                ideal.fy * size.height_m / (kReferencePart * ideal.height)});
  const Eigen::Isometry3d T_camera_window = geometry::makePose(geometry::R_optical_flu(), {0, 0, distance_m});
  cv::Mat picture;
  Renderer(impl_->scene, ideal).render(T_camera_window, picture);
  if (corners) *corners = *geometry::projectOpening(ideal, T_camera_window, size);
  return picture;
}

}  // namespace window_ingress::simulation
