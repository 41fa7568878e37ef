#include "navigation/behaviours/align.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "navigation_samples.hpp"

namespace window_ingress::navigation::align_test {

const NavigatorParams kDefaults = test::withoutGlass();

TEST(HeightProbe, GoesUpAndBackThenDownAndBackWithinItsAmplitude) {
  const NavigatorParams params = test::withoutGlass();
  HeightProbe probe(params);
  double height = 1.5, highest = height, lowest = height;
  int steps = 0;
  for (; probe.count() < 2 && steps < 1000; ++steps) {
    height += 0.03 * probe.climb(height);
    highest = std::max(highest, height);
    lowest = std::min(lowest, height);
    if (probe.count() == 0) {
      EXPECT_GE(height, 1.5 - 1e-9);
    }
  }
  EXPECT_NEAR(highest, 1.5 + params.align.probe_amplitude_m, 0.08);
  EXPECT_NEAR(lowest, 1.5 - params.align.probe_amplitude_m, 0.08);
  EXPECT_NEAR(height, 1.5, 0.08);
  EXPECT_LT(0.03 * steps, 12.0);
  EXPECT_FALSE(probe.isExhausted());
  while (probe.count() < params.align.max_probes) height += 0.03 * probe.climb(height);
  EXPECT_TRUE(probe.isExhausted());
}

TEST(HeightProbe, AtALimitOfTheHeightGoesTheOtherWay) {
  NavigatorParams params = test::withoutGlass();
  params.limits.max_height_m = 1.5;
  HeightProbe probe(params);
  double height = 1.5, lowest = height;
  int steps = 0;
  for (; probe.count() < 1 && steps < 1000; ++steps) {
    height += 0.03 * probe.climb(height);
    lowest = std::min(lowest, height);
  }
  EXPECT_NEAR(lowest, 1.5 - params.align.probe_amplitude_m, 0.08);
}

TEST(AlignBehaviour, ProbesInsteadOfGoingOnWhileTheApproachIsForbidden) {
  Align align{kDefaults, 0.0};
  MissionState mission;
  bool climbed = false, gave_up = false;
  double height_m = 0.0;
  for (double now = 0.0; now < 60.0 && !gave_up; now += 0.05) {
    auto situation = test::situationAt({-3.0, 0.0, height_m}, now, true);
    situation.target->approach_forbidden = "twist looks like world frame";
    const Decision decision = align.step(situation, mission);
    EXPECT_NE(decision.event, Event::kAligned);
    gave_up = decision.event == Event::kGiveUp;
    EXPECT_TRUE(!gave_up || decision.reason.find("world frame") != std::string::npos);
    climbed = climbed || decision.wish.velocity_odom_mps.z() > 0.1;
    height_m += 0.05 * decision.wish.velocity_odom_mps.z();
  }
  EXPECT_TRUE(climbed);
  EXPECT_TRUE(gave_up);
}

TEST(AlignBehaviour, AProbeThatBeginsAnewStaysAroundTheAxis) {
  Align align{kDefaults, 0.0};
  MissionState mission;
  constexpr double kAxisM = 1.5;
  double height_m = kAxisM, highest_m = height_m, lowest_m = height_m;
  for (int i = 0; i < 2000; ++i) {
    auto situation = test::situationAt({-3.0, 0.0, height_m}, 0.05 * i, true);
    if (i % 35 > 0) situation.target->approach_forbidden = "size not known";
    height_m += 0.05 * align.step(situation, mission).wish.velocity_odom_mps.z();
    highest_m = std::max(highest_m, height_m), lowest_m = std::min(lowest_m, height_m);
  }
  EXPECT_GT(highest_m, kAxisM + 0.3);
  EXPECT_LT(highest_m, kAxisM + kDefaults.align.probe_amplitude_m + 0.1);
  EXPECT_GT(lowest_m, kAxisM - kDefaults.align.probe_amplitude_m - 0.1);
}

TEST(AlignBehaviour, MakesRoomOnlyToMoveSideways) {
  for (const double lateral_m : {0.0, 1.0}) {
    Align align{kDefaults, 0.0};
    MissionState mission;
    const double forward_mps =
        align.step(test::situationAt({-1.5, lateral_m, 1.5}, 0.0, true), mission).wish.velocity_odom_mps.x();
    EXPECT_EQ(forward_mps<-0.1, lateral_m> 0.0) << forward_mps;
  }
}

TEST(StepPacer, StepsSidewaysOrForwardAndLooksAfterEach) {
  NavigatorParams params = test::withoutGlass();
  const Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  const Eigen::Vector3d wish(0.3, 0.5, 0);
  EXPECT_EQ(StepPacer(params).pace(wish, axes, test::situationAt({0, 0, 0}, 0.0, false)), wish);
  params.scheme = "stepped";
  StepPacer pacer(params);
  EXPECT_EQ(pacer.pace(wish, axes, test::situationAt({0, 0, 0}, 0.0, false)).norm(), 0.0) << "looks first";
  const Eigen::Vector3d step = pacer.pace(wish, axes, test::situationAt({0, 0, 0}, 0.6, false));
  EXPECT_EQ(step.x(), 0.0);
  EXPECT_GT(step.y(), 0.2);
  const Eigen::Vector3d end = pacer.pace(wish, axes, test::situationAt({0, 0.2, 0}, 1.0, false));
  EXPECT_GT(end.y(), 0.0);
  EXPECT_LT(end.y(), step.y());
  auto moving = test::situationAt({0, 0.25, 0}, 1.2, false);
  moving.vehicle->velocity_odom_mps.y() = 0.3;
  EXPECT_EQ(pacer.pace(wish, axes, moving).norm(), 0.0);
  EXPECT_EQ(pacer.pace(wish, axes, test::situationAt({0, 0.27, 0}, 1.4, false)).norm(), 0.0);
  EXPECT_EQ(pacer.pace(wish, axes, test::situationAt({0, 0.27, 0}, 1.8, false)).norm(), 0.0);
  EXPECT_GT(pacer.pace(wish, axes, test::situationAt({0, 0.27, 0}, 1.95, false)).y(), 0.2);
}

}  // namespace window_ingress::navigation::align_test
