#include "navigation/behaviours/back_off.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "navigation_samples.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::navigation::back_off_test {

const NavigatorParams kDefaults = test::withoutGlass();

TEST(BackOffBehaviour, GoesBackAlongTheAxisAndDoesNotTurnInTheReveal) {
  MissionState mission;
  mission.trusted = test::targetAtOrigin(0.0);
  mission.trusted->T_odom_window.linear() = geometry::yawRotation(0.4);
  BackOff back_off{kDefaults};
  const auto inside = back_off.step(test::situationAt({0.05, 0.05, 1.5}, 0.0, false, 0.8), mission);
  EXPECT_EQ(inside.wish.yaw_rate_radps, 0.0);
  const Eigen::Vector3d normal(std::cos(0.4), std::sin(0.4), 0.0);
  const Eigen::Vector3d left(-normal.y(), normal.x(), 0.0);
  EXPECT_NEAR(inside.wish.velocity_odom_mps.dot(normal), -kDefaults.back_off.speed_mps, 1e-12);
  const double offset_m = Eigen::Vector3d(0.05, 0.05, 0.0).dot(left);
  EXPECT_NEAR(inside.wish.velocity_odom_mps.dot(left), -kDefaults.align.lateral_gain_hz * offset_m, 1e-12);
  const auto outside = back_off.step(test::situationAt({-1.2, -0.35, 1.5}, 0.0, false, 1.2), mission);
  EXPECT_LT(outside.wish.yaw_rate_radps, 0.0);
  EXPECT_NEAR(outside.wish.velocity_odom_mps.dot(normal), -NavigatorParams().back_off.speed_mps, 1e-12);
  EXPECT_LT(outside.wish.velocity_odom_mps.dot(left), -0.1) << "clear of the reveal, back onto the normal";
}

TEST(BackOffBehaviour, EndsByTheWindowOrItsAbsenceOrTooManyTries) {
  MissionState mission;
  mission.trusted = test::targetAtOrigin(0.0);
  BackOff back_off{kDefaults};
  EXPECT_EQ(back_off.step(test::situationAt({-2.6, 0, 1.5}, 0.0, false), mission).event, Event::kBackedOff);
  EXPECT_FALSE(
      back_off.step(test::situationAt({-2.6, 0, 1.5}, 0.0, false, 1.0), mission).event);  // not facing it yet
  for (int i = 0; i < 2; ++i)
    EXPECT_FALSE(back_off.step(test::situationAt({-2.6, 0, 1.5}, 0.0, true), mission).event);
  EXPECT_EQ(back_off.step(test::situationAt({-2.6, 0, 1.5}, 0.0, true), mission).event, Event::kReacquired);
  mission.back_offs = BackOffParams().max_retries + 1;
  EXPECT_EQ(back_off.step(test::situationAt({-2.6, 0, 1.5}, 0.0, true), mission).event, Event::kGiveUp);
}

TEST(BackOffBehaviour, WithoutANormalItGoesNowhere) {
  MissionState mission;
  BackOff back_off{kDefaults};
  const auto decision = back_off.step(test::situationAt({-1.0, 0, 1.5}, 0.0, false), mission);
  EXPECT_EQ(decision.event, Event::kBackedOff);
  EXPECT_EQ(decision.wish.velocity_odom_mps.norm(), 0.0);
  mission.back_offs = BackOffParams().max_retries + 1;
  EXPECT_EQ(back_off.step(test::situationAt({-1.0, 0, 1.5}, 0.0, false), mission).event, Event::kGiveUp);
}

}  // namespace window_ingress::navigation::back_off_test
