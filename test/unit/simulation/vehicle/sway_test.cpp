#include "simulation/vehicle/sway.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "simulation/world.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::simulation::sway_test {

SwayParams swing(double direction_rad) {
  SwayParams params;
  params.amplitude_m = 0.1;
  params.period_sec = 4.0;
  params.direction_rad = direction_rad;
  return params;
}

TEST(Sway, SwingsAlongTheWallOrThroughIt) {
  const Eigen::Matrix3d R_odom_window = geometry::yawRotation(0.7);
  EXPECT_TRUE(Sway(swing(0.0), R_odom_window).offsetOdom(1.0).isApprox(0.1 * R_odom_window.col(1)));
  EXPECT_TRUE(Sway(swing(M_PI / 2), R_odom_window).offsetOdom(1.0).isApprox(0.1 * R_odom_window.col(0)));
  EXPECT_TRUE(Sway({}, R_odom_window).offsetOdom(1.0).isZero());
}

TEST(Sway, VelocityIsTheChangeOfItsPlace) {
  const Sway sway(swing(0.5), geometry::yawRotation(-2.0));
  for (double time_sec = 0.0; time_sec < 8.0; time_sec += 0.3) {
    const Eigen::Vector3d slope =
        (sway.offsetOdom(time_sec + 1e-5) - sway.offsetOdom(time_sec - 1e-5)) / 2e-5;
    EXPECT_LT((sway.velocityOdom(time_sec) - slope).norm(), 1e-6);
  }
}

TEST(Sway, MovesTheWindowAndWhatTheCameraSees) {
  Scenario scenario;
  scenario.sway = swing(0.0);
  World world(scenario, 1, World::Images::kNone);
  const Eigen::Vector3d before = world.T_odom_window().translation();
  double furthest_m = 0.0;
  while (world.timeSec() < 4.0) {
    world.advance();
    furthest_m = std::max(furthest_m, (world.T_odom_window().translation() - before).norm());
    while (const auto exposure = world.takeExposure()) {
      const Sway sway(scenario.sway, scenario.T_odom_window().linear());
      Eigen::Isometry3d T_odom_window = scenario.T_odom_window();
      T_odom_window.translation() += sway.offsetOdom(exposure->stamp_sec);
      const Eigen::Isometry3d T_odom_camera = exposure->truth.T_odom_base * world.T_base_camera();
      EXPECT_TRUE(
          world.draw(*exposure).T_camera_window.isApprox(T_odom_camera.inverse() * T_odom_window, 1e-9));
    }
  }
  EXPECT_NEAR(furthest_m, 0.1, 1e-3);
}

TEST(Sway, AVehicleThatHoversIsMetByAWallThatComes) {
  Scenario scenario;
  scenario.sway = swing(M_PI / 2);
  scenario.sway.amplitude_m = 1.0;
  scenario.start.distance_m = 0.9;
  scenario.start.height_offset_m = 1.2;
  scenario.house.eaves_m = 4.0;
  World world(scenario, 1, World::Images::kNone);
  while (world.timeSec() < 4.0) world.advance();
  EXPECT_EQ(world.referee().judge(Claim::kNone).outcome, Outcome::kCollision);
}

}  // namespace window_ingress::simulation::sway_test
