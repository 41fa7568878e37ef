#include "navigation/behaviours/search.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "navigation_samples.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::navigation::search_test {

const NavigatorParams kDefaults = test::withoutGlass();

TEST(SearchBehaviour, TurnsWithoutMovingSidewaysAndClimbsAfterEachTurn) {
  MissionState mission;
  const NavigatorParams params = test::withoutGlass();
  Search search{params, true};
  double yaw = 0.0, height = 1.5, turned = 0.0;
  Decision decision;
  while (!decision.event) {
    decision = search.step(test::situationAt({-4, 1, height}, 0.0, false, yaw), mission);
    ASSERT_EQ(decision.wish.velocity_odom_mps.head<2>().norm(), 0.0);
    ASSERT_LE(std::abs(decision.wish.velocity_odom_mps.z()), params.search.climb_speed_mps + 1e-12);
    yaw = geometry::wrapAngle(yaw + 0.03 * decision.wish.yaw_rate_radps);
    turned += 0.03 * decision.wish.yaw_rate_radps;
    height += 0.03 * decision.wish.velocity_odom_mps.z();
  }
  EXPECT_EQ(*decision.event, Event::kGiveUp);
  EXPECT_NEAR(turned, params.search.turns * 2 * M_PI, 0.2);
  EXPECT_NEAR(height, 1.5 + (params.search.turns - 1) * params.search.height_step_m, 0.1);
}

TEST(SearchBehaviour, DoesNotClimbWhereItsPlaceIsUncertain) {
  MissionState mission;
  const NavigatorParams params = test::withoutGlass();
  Search search{params, true};
  double yaw = 0.0;
  for (Decision decision; !decision.event;) {
    Situation situation = test::situationAt({-4, 1, 1.5}, 0.0, false, yaw);
    situation.odometry.shift_m = 0.5;
    decision = search.step(situation, mission);
    EXPECT_EQ(decision.wish.velocity_odom_mps.z(), 0.0);
    yaw = geometry::wrapAngle(yaw + 0.03 * decision.wish.yaw_rate_radps);
  }
}

TEST(SearchBehaviour, NeverDescendsAndDoesNotClimbNearTheWindow) {
  MissionState mission;
  NavigatorParams params = test::withoutGlass();
  params.search.height_m = 3.0;
  Search search{params, false};
  EXPECT_EQ(search.step(test::situationAt({-4, 1, 1.5}, 0.0, false), mission).wish.velocity_odom_mps.z(),
            0.0);
  search = Search(params, true);
  EXPECT_GT(search.step(test::situationAt({-4, 1, 1.5}, 0.0, false), mission).wish.velocity_odom_mps.z(),
            0.0);
  search = Search(params, true);
  EXPECT_EQ(search.step(test::situationAt({-4, 1, 5.0}, 0.0, false), mission).wish.velocity_odom_mps.z(),
            0.0);
}

TEST(SearchBehaviour, LooksFirstWhereTheWindowWas) {
  MissionState mission;
  for (const double yaw : {-1.0, 1.0}) {
    mission.window_odom_m = Eigen::Vector3d(0, 0, 1.5);
    Search search{kDefaults, false};
    const auto decision = search.step(test::situationAt({-4, 0, 1.5}, 0.0, false, yaw), mission);
    EXPECT_LT(decision.wish.yaw_rate_radps * yaw, 0.0);
  }
}

TEST(SearchBehaviour, OneImageIsNoWindow) {
  MissionState mission;
  Search search{kDefaults, true};
  EXPECT_FALSE(search.step(test::situationAt({-4, 0, 1.5}, 0.0, true), mission).event);
  EXPECT_FALSE(search.step(test::situationAt({-4, 0, 1.5}, 0.1, false), mission).event);
  for (int i = 0; i < 2; ++i)
    EXPECT_FALSE(search.step(test::situationAt({-4, 0, 1.5}, 0.2, true), mission).event);
  EXPECT_EQ(search.step(test::situationAt({-4, 0, 1.5}, 0.3, true), mission).event, Event::kWindowFound);
}

TEST(SearchBehaviour, TurnsSlowerForLongExposuresAndFewImages) {
  NavigatorParams params = test::withoutGlass();
  const auto rateWith = [&](double image_period_sec) {
    Search search{params, false};
    auto situation = test::situationAt({-4, 0, 1.5}, 0.0, false);
    situation.image_period_sec = image_period_sec;
    MissionState mission;
    return search.step(situation, mission).wish.yaw_rate_radps;
  };
  EXPECT_DOUBLE_EQ(rateWith(0.033), params.search.yaw_rate_radps);
  EXPECT_DOUBLE_EQ(rateWith(1.0), Search::kMaxTurnPerImage * params.vehicle.camera.horizontal_fov_rad);
  params.vehicle.exposure_sec = 0.02;
  EXPECT_DOUBLE_EQ(rateWith(0.033), params.search.max_blur_px * params.vehicle.camera.pixel_rad / 0.02);
}

}  // namespace window_ingress::navigation::search_test
