// Stopping distances of the simulated vehicles for speed limits: the table of doc/autopilots.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "simulation/scenario/scenario.hpp"
#include "simulation/vehicle/quadrotor.hpp"
#include "window_ingress/configuration/overlay.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::simulation::stopping_distance_test {

constexpr double kStep_sec = 0.0025, kCruise_sec = 8.0, kRest_sec = 14.0;
constexpr double kGuard_sec = 0.2 + 1.0 / 30.0;  // late_sec and one period of the guard
constexpr double kTolerance_m = 0.05;
constexpr const char* kProfiles[] = {"arducopter_4_0", "arducopter_4_3", "crisp", "px4_1_13_gps"};

/// Largest distance that a vehicle flies after its sender has died at `speed`. Zeros follow after
/// `zeros_after_sec`; negative: never.
double travel(const std::string& profile, double speed_mps, double zeros_after_sec) {
  QuadrotorParams params;
  OdometryParams odometry;
  applyProfile(profile, params, odometry);
  Quadrotor vehicle(params, geometry::makePose(Eigen::Matrix3d::Identity(), {0, 0, 10}));
  double stop_m = 0.0, furthest_m = 0.0;
  for (double now = 0.0; now < kCruise_sec + kRest_sec; now += kStep_sec) {
    const double dead_sec = now - kCruise_sec;
    if (dead_sec < 0.0) vehicle.command({Eigen::Vector3d(speed_mps, 0, 0), 0.0});
    if (zeros_after_sec >= 0.0 && dead_sec >= zeros_after_sec) vehicle.command({});
    vehicle.step(kStep_sec, {}, vehicle.truth().velocity_odom_mps);
    const double x = vehicle.truth().T_odom_base.translation().x();
    if (dead_sec < 0.0) stop_m = x;
    furthest_m = std::max(furthest_m, x - stop_m);
  }
  return furthest_m;
}

/// Cells of the table below the line that names it, by the first two cells of each row.
std::map<std::string, std::vector<double>> documented() {
  std::ifstream file(std::string(WINDOW_INGRESS_SOURCE_DIR) + "/doc/autopilots.md");
  std::map<std::string, std::vector<double>> rows;
  std::string line, cell;
  while (std::getline(file, line)) {
    const auto names = [&](const char* profile) { return line.rfind("| `" + std::string(profile), 0) == 0; };
    if (std::none_of(std::begin(kProfiles), std::end(kProfiles), names)) continue;
    std::istringstream cells(line);
    std::vector<std::string> row;
    while (std::getline(cells, cell, '|')) row.push_back(cell);
    auto& values = rows[row.at(1) + row.at(2)];
    for (std::size_t i = 3; i < row.size(); ++i) values.push_back(std::stod(row[i]));
  }
  return rows;
}

TEST(StoppingDistance, IsAsDocumented) {
  const auto rows = documented();
  for (const char* profile : kProfiles)
    for (const double speed : {0.5, 1.0, 1.5}) {
      char name[60];
      std::snprintf(name, sizeof name, " `%s`  %.1f ", profile, speed);
      const double got[] = {travel(profile, speed, 0.0), travel(profile, speed, kGuard_sec),
                            travel(profile, speed, -1.0)};
      std::printf("| `%s` | %.1f | %.2f | %.2f | %.2f |\n", profile, speed, got[0], got[1], got[2]);
      const auto row = rows.find(name);
      if (row == rows.end() || row->second.size() != 3u) {
        ADD_FAILURE() << name << "is not in the table";
        continue;
      }
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(row->second[i], got[i], kTolerance_m) << name << i;
    }
}

// The vehicle values of px4.launch and ardupilot.launch are those that the speed schedule assumes.
TEST(StoppingDistance, IsNotLongerThanWhatTheLaunchFilesSay) {
  const std::string ardupilot = WINDOW_INGRESS_SOURCE_DIR "/config/ardupilot.yaml";
  const std::pair<const char*, std::string> flown[] = {{"px4_1_13_gps", ""},
                                                       {"arducopter_4_0", ardupilot},
                                                       {"arducopter_4_0_default", ardupilot},
                                                       {"arducopter_4_3", ardupilot}};
  for (const auto& [profile, file] : flown) {
    const auto vehicle = configuration::readOverlay(file).vehicle;
    for (const double speed : {0.5, 1.0, 1.5}) {
      const double said_m = speed * vehicle.response_sec + 0.5 * speed * speed / vehicle.braking_mps2;
      EXPECT_LT(travel(profile, speed, 0.0), said_m + 0.01) << profile << " at " << speed << " m/s";
    }
  }
}

TEST(StoppingDistance, TheGuardSavesMetresWhereTheLastVelocityIsHeld) {
  for (const char* profile : {"arducopter_4_0", "arducopter_4_3"})
    EXPECT_LT(travel(profile, 1.0, kGuard_sec) + 2.5, travel(profile, 1.0, -1.0)) << profile;
}

}  // namespace window_ingress::simulation::stopping_distance_test
