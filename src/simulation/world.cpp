#include "simulation/world.hpp"

#include <algorithm>
#include <stdexcept>

#include "simulation/camera/camera_sensor.hpp"
#include "simulation/camera/reference_image.hpp"
#include "simulation/scene/scene.hpp"
#include "simulation/sensors/faults.hpp"
#include "simulation/vehicle/followed_vehicle.hpp"
#include "simulation/vehicle/sway.hpp"
#include "simulation/vehicle/wind.hpp"
#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/parameters/fields.hpp"

namespace window_ingress::simulation {
namespace {

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

WallInAir wallOf(const Scenario& scenario, const Scene& scene) {
  WallInAir wall;
  wall.open = scene.opening.has_value();
  wall.opening = scenario.opening();
  wall.front_x_m = scenario.window.frame_depth_m;
  wall.back_x_m = scene.opening_depth_m;
  wall.half_width_m = 0.5 * scenario.house.width_m;
  wall.ground_z_m = scene.ground_z_m;
  wall.top_z_m = scene.ground_z_m + scenario.house.eaves_m;
  return wall;
}

geometry::PinholeCamera modelOf(const CameraParams& params) {
  try {
    return params.model();
  } catch (const std::runtime_error& error) {
    throw ScenarioError(std::string("scenario: camera/calibration_file: ") + error.what());
  }
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
  Impl(const Scenario& given, std::uint32_t seed_of_all, Images images)
      : scenario(checked(given)),
        seed(seed_of_all),
        scene(buildScene(scenario)),
        model(modelOf(scenario.camera)),
        T_base_camera(scenario.camera.T_base_camera()),
        T_odom_window(scenario.T_odom_window()),
        sway(scenario.sway, T_odom_window.linear()),
        camera(images == Images::kDrawn ? makeCamera(scene, scenario.camera, seed) : nullptr),
        wind(scenario.wind, wallOf(scenario, scene), scenario.vehicle.half_length_m, seed),
        quadrotor(scenario.vehicle, scenario.startPoseInOdom(),
                  T_odom_window.linear() * wind.steadyAt(scenario.startPoseInWindow().translation())),
        odometry(scenario.odometry, seed),
        imu(scenario.imu, seed),
        followed(scenario.startPoseInOdom()),
        faults(scenario.faults),
        commands({RandomStream(seed, "cmd_vel garbage")}),
        shutter(scenario.camera.rate_hz),
        transport(scenario.camera, seed),
        exposures(scenario.camera.latency_sec),
        referee(courseOf(scenario, scene)) {}

  bool external() const { return scenario.vehicle.profile == "external"; }
  const VehicleTruth& truth() const { return external() ? followed.truth() : quadrotor.truth(); }
  VehicleTruth besideHouse() const { return sway.besideHouse(truth(), time_sec); }

  // The referee believes no velocity that a vehicle reports of itself.
  VehicleTruth judged() const {
    VehicleTruth judged = truth();
    if (external()) judged.velocity_odom_mps = followed.flownVelocity();
    return sway.besideHouse(judged, time_sec);
  }
  const FaultParams* acting(const char* unit) const { return faults.acting(unit, time_sec); }

  void move() {
    obey();
    const Eigen::Matrix3d& turn = T_odom_window.linear();
    const VehicleTruth beside = besideHouse();
    const Air air = wind.step(kStepSec, T_odom_window.inverse() * beside.T_odom_base.translation(),
                              turn.transpose() * beside.velocity_odom_mps);
    const Eigen::Vector3d estimate = odometry.drift().linear().transpose() * odometry.velocityEstimate();
    quadrotor.step(kStepSec, {turn * air.wind_mps, turn * air.push_mps2}, estimate);
  }

  void sense() {
    if (!external()) {
      odometry.update(time_sec, truth());
      imu.update(time_sec, truth(), quadrotor.specificForceBase(), odometry.drift());
    }
    if (shutter.due(time_sec)) expose();
    referee.update(time_sec, judged());
    if (referee.touched() && !external() && !quadrotor.crashed()) quadrotor.crash(restHeight());
  }

  void expose() {
    const Exposure exposure{exposure_count++, time_sec, truth(), besideHouse(), Exposure::Spoilt::kNot};
    if (const auto arrival_sec = transport.arrivalOf(time_sec)) exposures.pushUntil(*arrival_sec, exposure);
  }

  // In odom, where z = 0 is the ground.
  double restHeight() const {
    const double centre_m = T_odom_window.translation().z();
    const Eigen::Vector3d position = T_odom_window.inverse() * besideHouse().T_odom_base.translation();
    return centre_m + topBelow(scene.obstacles, position, scene.ground_z_m) + scenario.vehicle.half_height_m;
  }

  // What the sensors deliver by now sets out on its way out of the world.
  void deliver() {
    while (auto sample = odometry.take(time_sec)) {
      sample->T_odom_base.translation() += faults.slideAt(time_sec);
      odometry_line.put(time_sec, *sample, acting("odom"));
      transforms.put(time_sec, *sample, acting("tf"));
    }
    while (const auto sample = imu.take(time_sec)) imu_line.put(time_sec, *sample, acting("imu"));
    while (const auto exposure = exposures.take(time_sec)) {
      calibrations.put(time_sec, {exposure->stamp_sec, model}, acting("camera_info"));
      images.put(time_sec, *exposure, acting("image"));
    }
  }

  void obey() {
    while (const auto command = commands.take(time_sec, acting("cmd_vel"))) {
      VelocityCommand true_axes = *command;
      true_axes.velocity_odom_mps = odometry.drift().linear().transpose() * command->velocity_odom_mps;
      quadrotor.command(true_axes);
    }
  }

  Eigen::Isometry3d cameraInWindow(const Exposure& exposure) const {
    const VehicleTruth beside = sway.besideHouse(exposure.truth, exposure.stamp_sec);
    return T_odom_window.inverse() * beside.T_odom_base * T_base_camera;
  }

  Scenario scenario;
  std::uint32_t seed;
  Scene scene;
  geometry::PinholeCamera model;
  Eigen::Isometry3d T_base_camera, T_odom_window;  ///< the house at its resting place
  Sway sway;
  std::unique_ptr<CameraSensor> camera;  ///< null: no images
  Wind wind;
  Quadrotor quadrotor;
  OdometrySensor odometry;
  ImuSensor imu;
  FollowedVehicle followed;
  FaultPlan faults;
  CommandLine commands;
  OdometryLine odometry_line, transforms;
  ImuLine imu_line;
  CalibrationLine calibrations;
  ImageLine images;
  ClockLine clock;
  Periodic shutter;
  CameraTransport transport;
  DelayLine<Exposure> exposures;
  Referee referee;
  long steps = 0;
  std::uint64_t exposure_count = 0;
  double time_sec = 0.0;
};

World::World(const Scenario& scenario, std::uint32_t seed, Images images)
    : impl_(std::make_unique<Impl>(scenario, seed, images)) {}

World::~World() = default;

void World::advance() {
  if (!impl_->external()) impl_->move();
  impl_->time_sec = static_cast<double>(++impl_->steps) * kStepSec;
  if (impl_->external()) impl_->followed.moveTo(impl_->time_sec);
  impl_->sense();
  impl_->deliver();
}

void World::command(const VelocityCommand& command) {
  impl_->commands.put(impl_->time_sec, command, impl_->acting("cmd_vel"));
  impl_->obey();
}

void World::follow(const VehicleTruth& truth, double stamp_sec) { impl_->followed.follow(truth, stamp_sec); }

void World::inject(FaultParams fault) {
  fault.at_sec = impl_->time_sec;
  if (impl_->external()) {
    const std::string why_not = whyNotBesideExternalVehicle(fault);
    if (!why_not.empty()) throw ScenarioError("fault: " + why_not);
  }
  impl_->faults.inject(fault);
}

double World::timeSec() const { return impl_->time_sec; }

const VehicleTruth& World::truth() const { return impl_->truth(); }

std::optional<CameraFrame> World::takeFrame() {
  const auto exposure = takeExposure();
  return exposure ? std::optional<CameraFrame>(draw(*exposure)) : std::nullopt;
}

std::optional<Exposure> World::takeExposure() {
  return impl_->images.take(impl_->time_sec, impl_->acting("image"));
}

CameraFrame World::draw(const Exposure& exposure) {
  CameraFrame frame;
  frame.stamp_sec = exposure.stamp_sec;
  frame.truth = exposure.truth;
  frame.T_camera_window = impl_->cameraInWindow(exposure).inverse();
  if (!impl_->camera) return frame;
  const auto motion = CameraMotion::of(exposure.shown, impl_->T_odom_window, impl_->T_base_camera);
  frame.image = impl_->camera->expose(motion, exposure.index, exposure.stamp_sec);
  spoil(frame.image, exposure, impl_->seed);
  return frame;
}

std::optional<OdometrySample> World::takeOdometry() {
  return impl_->odometry_line.take(impl_->time_sec, impl_->acting("odom"));
}

std::optional<ImuSample> World::takeImu() {
  return impl_->imu_line.take(impl_->time_sec, impl_->acting("imu"));
}

std::optional<CalibrationSample> World::takeCalibration() {
  return impl_->calibrations.take(impl_->time_sec, impl_->acting("camera_info"));
}

std::optional<OdometrySample> World::takeTransform() {
  return impl_->transforms.take(impl_->time_sec, impl_->acting("tf"));
}

std::optional<double> World::readClock() {
  const FaultParams* fault = impl_->acting("clock");
  impl_->clock.put(impl_->time_sec, impl_->time_sec, fault);
  std::optional<double> reading;
  while (const auto later = impl_->clock.take(impl_->time_sec, fault)) reading = later;
  return reading;
}

const geometry::PinholeCamera& World::camera() const { return impl_->model; }

Eigen::Isometry3d World::T_base_camera() const { return impl_->scenario.camera.toldT_base_camera(); }

Eigen::Isometry3d World::T_odom_window() const {
  Eigen::Isometry3d now = impl_->T_odom_window;
  now.translation() += impl_->sway.offsetOdom(impl_->time_sec);
  return now;
}

Eigen::Isometry3d World::odometryDrift() const { return impl_->odometry.drift(); }

geometry::OpeningSize World::opening() const { return impl_->scenario.opening(); }

Eigen::Vector3d World::vehicleHalfExtents() const { return impl_->scenario.vehicle.halfExtents(); }

const Scenario& World::scenario() const { return impl_->scenario; }

const Referee& World::referee() const { return impl_->referee; }

cv::Mat World::referenceImage(geometry::Quadrilateral* corners) const {
  return simulation::referenceImage(impl_->scenario, corners);
}

}  // namespace window_ingress::simulation
