#include "simulation/world.hpp"

#include <stdexcept>

#include "window_ingress/parameters/fields.hpp"

namespace window_ingress::simulation {
namespace {

const Scenario& checked(const Scenario& scenario) {
  const auto faults = faultsOf(scenario);
  if (!faults.empty()) throw InputError("scenario: " + parameters::joined(faults));
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
  wall.open = scenario.window.isOpen();
  wall.opening = scenario.opening();
  wall.front_x_m = scenario.window.wallFront();
  wall.back_x_m = scene.opening_depth_m;
  wall.half_width_m = 0.5 * scenario.house.width_m;
  wall.ground_z_m = scene.ground_z_m;
  wall.top_z_m = scene.ground_z_m + scenario.house.eaves_m;
  return wall;
}

geometry::PinholeCamera modelOf(const CameraParams& params) {
  try {
    return params.model();
  } catch (const InputError& error) {
    throw InputError(std::string("scenario: camera/calibration_file: ") + error.what());
  }
}

std::unique_ptr<CameraSensor> makeCamera(const Scene& scene, const CameraParams& params, std::uint32_t seed) {
  try {
    return std::make_unique<CameraSensor>(scene, params, seed);
  } catch (const std::invalid_argument& error) {
    throw InputError(std::string("scenario: ") + error.what());
  }
}

}  // namespace

World::World(const Scenario& scenario, std::uint32_t seed, Images images)
    : scenario_(checked(scenario)),
      seed_(seed),
      scene_(buildScene(scenario_)),
      model_(modelOf(scenario_.camera)),
      T_base_camera_(scenario_.camera.T_base_camera()),
      T_odom_window_(scenario_.T_odom_window()),
      sway_(scenario_.sway, T_odom_window_.linear()),
      camera_(images == Images::kDrawn ? makeCamera(scene_, scenario_.camera, seed) : nullptr),
      wind_(scenario_.wind, wallOf(scenario_, scene_), scenario_.vehicle.half_length_m, seed),
      quadrotor_(scenario_.vehicle, scenario_.startPoseInOdom(),
                 T_odom_window_.linear() * wind_.steadyAt(scenario_.startPoseInWindow().translation())),
      odometry_(scenario_.odometry, seed),
      imu_(scenario_.imu, seed),
      followed_(scenario_.startPoseInOdom()),
      faults_(scenario_.faults),
      commands_({RandomStream(seed, "cmd_vel garbage")}),
      shutter_(scenario_.camera.rate_hz),
      transport_(scenario_.camera, seed),
      referee_(courseOf(scenario_, scene_)) {}

const VehicleTruth& World::truth() const { return external() ? followed_.truth() : quadrotor_.truth(); }

VehicleTruth World::besideHouse() const { return sway_.besideHouse(truth(), time_sec_); }

// The referee does not trust a velocity reported by a vehicle.
VehicleTruth World::judged() const {
  VehicleTruth judged = truth();
  if (external()) judged.velocity_odom_mps = followed_.flownVelocity();
  return sway_.besideHouse(judged, time_sec_);
}

void World::move() {
  obey();
  const Eigen::Matrix3d& turn = T_odom_window_.linear();
  const VehicleTruth beside = besideHouse();
  const Air air = wind_.step(kStepSec, T_odom_window_.inverse() * beside.T_odom_base.translation(),
                             turn.transpose() * beside.velocity_odom_mps);
  const Eigen::Vector3d estimate = odometry_.drift().linear().transpose() * odometry_.velocityEstimate();
  quadrotor_.step(kStepSec, {turn * air.wind_mps, turn * air.push_mps2}, estimate);
}

void World::sense() {
  if (!external()) {
    odometry_.update(time_sec_, truth());
    imu_.update(time_sec_, truth(), quadrotor_.specificForceBase(), odometry_.drift());
  }
  if (shutter_.due(time_sec_)) expose();
  referee_.update(time_sec_, judged());
  if (referee_.touched() && !external() && !quadrotor_.crashed()) quadrotor_.crash(restHeight());
}

void World::expose() {
  const Exposure exposure{exposure_count_++, time_sec_, truth(), besideHouse(), Exposure::Spoilt::kNot};
  if (const auto arrival_sec = transport_.arrivalOf(time_sec_)) exposures_.push(*arrival_sec, exposure);
}

// Height in odom, where z = 0 is the ground.
double World::restHeight() const {
  const double centre_m = T_odom_window_.translation().z();
  const Eigen::Vector3d position = T_odom_window_.inverse() * besideHouse().T_odom_base.translation();
  return centre_m + topBelow(scene_.obstacles, position, scene_.ground_z_m) + scenario_.vehicle.half_height_m;
}

// Passes the sensors' samples that are due to the fault lines.
void World::deliver() {
  while (auto sample = odometry_.take(time_sec_)) {
    sample->T_odom_base.translation() += faults_.slideAt(time_sec_);
    odometry_line_.put(time_sec_, *sample, acting("odom"));
    transforms_.put(time_sec_, *sample, acting("tf"));
  }
  while (const auto sample = imu_.take(time_sec_)) imu_line_.put(time_sec_, *sample, acting("imu"));
  while (const auto exposure = exposures_.take(time_sec_)) {
    calibrations_.put(time_sec_, {exposure->stamp_sec, model_}, acting("camera_info"));
    images_.put(time_sec_, *exposure, acting("image"));
  }
}

void World::obey() {
  const Eigen::Matrix3d true_axes = odometry_.drift().linear().transpose();
  while (const auto command = commands_.take(time_sec_, acting("cmd_vel")))
    quadrotor_.command({true_axes * command->velocity_odom_mps, command->yaw_rate_radps});
}

void World::advance() {
  if (!external()) move();
  time_sec_ = static_cast<double>(++steps_) * kStepSec;
  if (external()) followed_.moveTo(time_sec_);
  sense();
  deliver();
}

void World::command(const VelocityCommand& command) {
  commands_.put(time_sec_, command, acting("cmd_vel"));
  obey();
}

void World::inject(const FaultParams& fault) {
  if (external()) {
    const std::string why_not = whyNotBesideExternalVehicle(fault);
    if (!why_not.empty()) throw InputError("fault: " + why_not);
  }
  faults_.inject(fault, time_sec_);
}

std::optional<CameraFrame> World::takeFrame() {
  const auto exposure = takeExposure();
  return exposure ? std::optional<CameraFrame>(draw(*exposure)) : std::nullopt;
}

CameraFrame World::draw(const Exposure& exposure) {
  CameraFrame frame;
  frame.stamp_sec = exposure.stamp_sec;
  const VehicleTruth beside = sway_.besideHouse(exposure.truth, exposure.stamp_sec);
  frame.T_camera_window = (T_odom_window_.inverse() * beside.T_odom_base * T_base_camera_).inverse();
  if (!camera_) return frame;
  const auto motion = CameraTruth::of(exposure.shown, T_odom_window_, T_base_camera_);
  frame.image = camera_->expose(motion, exposure.index, exposure.stamp_sec);
  spoil(frame.image, exposure, seed_);
  return frame;
}

std::optional<double> World::readClock() {
  const FaultParams* fault = acting("clock");
  clock_.put(time_sec_, time_sec_, fault);
  std::optional<double> reading;
  while (const auto later = clock_.take(time_sec_, fault)) reading = later;
  return reading;
}

Eigen::Isometry3d World::T_odom_window() const {
  Eigen::Isometry3d now = T_odom_window_;
  now.translation() += sway_.offsetOdom(time_sec_);
  return now;
}

}  // namespace window_ingress::simulation
