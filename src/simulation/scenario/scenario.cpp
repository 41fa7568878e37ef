#include "simulation/scenario/scenario.hpp"

#include <cmath>

#include "simulation/scene/obstacle_collision.hpp"
#include "simulation/scene/scene_parts.hpp"
#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/parameters/calibration_file.hpp"
#include "window_ingress/parameters/fields.hpp"

namespace window_ingress::simulation {
namespace {

constexpr double kMinWallAround_m = 0.02;

void checkFits(const Scenario& s, std::vector<std::string>& faults) {
  const double side_m = 0.5 * s.window.width_m + s.window.frame_width_m + kMinWallAround_m;
  if (side_m > 0.5 * s.house.width_m) faults.push_back("window/width_m: the window is wider than the house");
  const double top_m = s.window.sill_m + s.window.height_m + s.window.frame_width_m + kMinWallAround_m;
  if (top_m > s.house.eaves_m) faults.push_back("window/sill_m: the window reaches above house/eaves_m");
  if (s.window.sill_m - s.window.frame_width_m < kMinWallAround_m)
    faults.push_back("window/sill_m: the window's frame reaches into the ground");
  if (s.window.bars != "none" && s.window.closed_by == "none")
    faults.push_back("window/bars: an open window has none; set closed_by, e.g. glass");
  if (s.window.dirt > 0.0 && s.window.closed_by != "glass")
    faults.push_back("window/dirt: only glass can be dirty; set closed_by: glass");
}

// The area of a window or a poster on the wall, relative to the target's centre.
struct Patch {
  double y_m, z_m, half_width_m, half_height_m;
  bool overlaps(const Patch& other) const {
    return std::abs(y_m - other.y_m) < half_width_m + other.half_width_m &&
           std::abs(z_m - other.z_m) < half_height_m + other.half_height_m;
  }
};

Patch patchOf(const DecoyParams& decoy) {
  return {decoy.y_m, decoy.z_m, 0.5 * decoy.width_m + decoy.frame_width_m,
          0.5 * decoy.height_m + decoy.frame_width_m};
}

Patch patchOf(const Scenario& s, const DoorParams& door) {
  const double half_m = 0.5 * door.height_m;
  return {door.y_m, half_m - s.windowCentreHeight(), 0.5 * door.width_m + door.frame_width_m, half_m};
}

// Nothing may cover the target, and windows and doors may not overlap. Posters may hang anywhere else.
void checkWall(const Scenario& s, std::vector<std::string>& faults) {
  std::vector<std::pair<std::string, Patch>> patches;
  const double margin_m = s.window.frame_width_m;
  if (s.window.present)
    patches.push_back(
        {"the window", {0, 0, 0.5 * s.window.width_m + margin_m, 0.5 * s.window.height_m + margin_m}});
  const auto add = [&](const std::string& list, std::size_t i, const Patch& patch, bool stays) {
    const std::string name = list + "[" + std::to_string(i) + "]";
    for (const auto& [other, taken] : patches)
      if (patch.overlaps(taken)) faults.push_back(name + ": overlaps " + other);
    if (stays) patches.push_back({name, patch});
  };
  for (std::size_t i = 0; i < s.posters.size(); ++i) {
    const auto& poster = s.posters[i];
    add("posters", i, {poster.y_m, poster.z_m, 0.5 * poster.width_m, 0.5 * poster.height_m}, false);
  }
  for (std::size_t i = 0; i < s.decoys.size(); ++i) add("decoys", i, patchOf(s.decoys[i]), true);
  for (std::size_t i = 0; i < s.doors.size(); ++i) add("doors", i, patchOf(s, s.doors[i]), true);
}

// An open decoy leads into the room, so it must lie within the wall.
void checkOpenDecoys(const Scenario& s, std::vector<std::string>& faults) {
  for (std::size_t i = 0; i < s.decoys.size(); ++i) {
    const Patch patch = patchOf(s.decoys[i]);
    const double bottom_m = s.windowCentreHeight() + patch.z_m - patch.half_height_m;
    const bool fits = std::abs(patch.y_m) + patch.half_width_m + 0.2 <= 0.5 * s.house.width_m &&
                      bottom_m >= kMinWallAround_m &&
                      bottom_m + 2.0 * patch.half_height_m + 0.05 <= s.house.eaves_m;
    if (s.decoys[i].showsRoom() && !fits)
      faults.push_back("decoys[" + std::to_string(i) + "]: shows the room and reaches beyond the wall");
  }
}

void checkStart(const Scenario& s, std::vector<std::string>& faults) {
  const double lowest_m = s.windowCentreHeight() + s.start.height_offset_m - s.vehicle.half_height_m;
  if (s.start.hovering && lowest_m < 0.05) faults.push_back("start/height_offset_m: starts in the ground");
  const double gap_m = -s.startPoseInWindow().translation().x() - s.vehicle.halfExtents().norm();
  if (gap_m < 0.05) faults.push_back("start/distance_m: starts in the wall");
  if (touches(s.startPoseInWindow(), s.vehicle.halfExtents(), roofBox(s)))
    faults.push_back("start/height_offset_m: starts in the roof");
}

// Leaves enough thrust to climb and to tilt.
void checkPayload(const Scenario& s, std::vector<std::string>& faults) {
  const double part = (1.0 + s.vehicle.thrust_gain_error) / s.vehicle.massRatio();
  if (part < 0.6) faults.push_back("vehicle/payload_kg: too heavy for its thrust");
}

void checkLens(const Scenario& s, std::vector<std::string>& faults) {
  const CameraParams& camera = s.camera;
  if (camera.lens == "equidistant") {
    if (camera.p1 != 0.0 || camera.p2 != 0.0)
      faults.push_back("camera/p1, camera/p2: must be 0, an equidistant lens has none");
    return;
  }
  if (camera.k4 != 0.0) faults.push_back("camera/k4: must be 0, only an equidistant lens has it");
  if (camera.horizontal_fov_rad > 2.4)
    faults.push_back("camera/horizontal_fov_rad: more than 2.4 needs an equidistant lens");
}

void checkFaults(const Scenario& s, std::vector<std::string>& faults) {
  for (std::size_t i = 0; i < s.faults.size(); ++i) {
    std::string why_not = whyNoSuchFault(s.faults[i]);
    if (why_not.empty() && s.vehicle.profile == "external")
      why_not = whyNotBesideExternalVehicle(s.faults[i]);
    if (!why_not.empty()) faults.push_back("faults[" + std::to_string(i) + "]: " + why_not);
  }
}

}  // namespace

geometry::PinholeCamera CameraParams::model() const {
  if (!calibration_file.empty()) return parameters::readCalibrationFile(calibration_file);
  auto camera = geometry::PinholeCamera::fromFieldOfView(width_px, height_px, horizontal_fov_rad);
  camera.distortion = {k1, k2, p1, p2, k3};
  if (lens != "equidistant") return camera;
  camera.model = geometry::LensModel::kEquidistant;
  camera.fx = camera.fy = width_px / horizontal_fov_rad;
  camera.distortion = {k1, k2, k3, k4, 0.0};
  return camera;
}

Eigen::Isometry3d CameraParams::T_base_camera() const {
  const Eigen::Matrix3d look = geometry::yawRotation(yaw_rad) *
                               Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()).toRotationMatrix();
  return geometry::makePose(look * geometry::R_optical_flu().transpose(), {x_m, y_m, z_m});
}

Eigen::Isometry3d CameraParams::toldT_base_camera() const {
  CameraParams told = *this;
  told.pitch_rad += told_pitch_error_rad;
  told.yaw_rad += told_yaw_error_rad;
  return told.T_base_camera();
}

Eigen::Isometry3d Scenario::startPoseInWindow() const {
  const double height_m =
      start.hovering ? start.height_offset_m : vehicle.half_height_m - windowCentreHeight();
  const Eigen::Vector3d position(-start.distance_m * std::cos(start.off_axis_rad),
                                 start.distance_m * std::sin(start.off_axis_rad), height_m);
  return geometry::makePose(geometry::yawRotation(start.heading_rad - start.off_axis_rad), position);
}

Eigen::Isometry3d Scenario::startPoseInOdom() const {
  const double height_m = windowCentreHeight() + startPoseInWindow().translation().z();
  return geometry::makePose(geometry::yawRotation(start.odom_yaw_rad),
                            {start.odom_x_m, start.odom_y_m, height_m});
}

void Scenario::startAt(const Eigen::Isometry3d& T_odom_base) {
  start.odom_x_m = T_odom_base.translation().x();
  start.odom_y_m = T_odom_base.translation().y();
  start.odom_yaw_rad = geometry::yawOf(T_odom_base.linear());
}

Eigen::Isometry3d Scenario::T_odom_window() const {
  return startPoseInOdom() * startPoseInWindow().inverse();
}

std::vector<std::string> faultsOf(const Scenario& scenario) {
  auto faults = parameters::outOfRange(scenario);
  if (!faults.empty()) return faults;
  checkFits(scenario, faults);
  checkWall(scenario, faults);
  checkOpenDecoys(scenario, faults);
  checkStart(scenario, faults);
  checkPayload(scenario, faults);
  checkLens(scenario, faults);
  checkFaults(scenario, faults);
  return faults;
}

std::string whyNoSuchFault(const FaultParams& fault) {
  const std::string what = fault.unit + " " + fault.kind + ": ";
  if (fault.unit == "clock" && fault.kind == "garbage")
    return what + "every bit pattern is a valid time; use wrong";
  if (fault.kind == "slide" && fault.unit != "odom") return what + "only odom can slide";
  if (fault.unit == "camera_info" && fault.kind == "stuck")
    return what + "the calibration never changes; use off or wrong";
  if (fault.unit == "guard" && fault.kind != "off") return what + "the guard can only be off";
  return "";
}

std::string whyNotBesideExternalVehicle(const FaultParams& fault) {
  if (fault.unit == "image" || fault.unit == "camera_info") return "";
  return fault.unit + " " + fault.kind + ": with vehicle external, the world does not simulate " + fault.unit;
}

}  // namespace window_ingress::simulation
