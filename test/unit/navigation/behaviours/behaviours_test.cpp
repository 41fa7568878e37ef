/// The states one by one: search, height probe, steps, back-off, hold.
#include "navigation/behaviours/behaviours.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "navigation/motion/stopping.hpp"
#include "navigation_samples.hpp"

namespace window_ingress::navigation::behaviours_test {

const NavigatorParams kDefaults = test::withoutGlass();

Situation situationAt(const Eigen::Vector3d& position_m, double now_sec, bool with_target,
                      double yaw_rad = 0.0) {
  Situation situation;
  situation.now_sec = now_sec;
  situation.dt_sec = 0.03;
  situation.vehicle = test::vehicleAt(position_m, now_sec, yaw_rad);
  if (with_target) situation.target = test::targetAtOrigin(now_sec);
  situation.target_is_new = with_target;
  return situation;
}

TEST(SearchBehaviour, TurnsWithoutMovingSidewaysAndClimbsAfterEachTurn) {
  MissionState mission;
  const NavigatorParams params = test::withoutGlass();
  Search search{params, true};
  double yaw = 0.0, height = 1.5, turned = 0.0;
  Decision decision;
  while (!decision.event) {
    decision = search.step(situationAt({-4, 1, height}, 0.0, false, yaw), mission);
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
  mission.odometry_shift_m = 0.5;
  const NavigatorParams params = test::withoutGlass();
  Search search{params, true};
  double yaw = 0.0;
  for (Decision decision; !decision.event;) {
    decision = search.step(situationAt({-4, 1, 1.5}, 0.0, false, yaw), mission);
    EXPECT_EQ(decision.wish.velocity_odom_mps.z(), 0.0);
    yaw = geometry::wrapAngle(yaw + 0.03 * decision.wish.yaw_rate_radps);
  }
}

TEST(SearchBehaviour, NeverDescendsAndDoesNotClimbNearTheWindow) {
  MissionState mission;
  NavigatorParams params = test::withoutGlass();
  params.search.height_m = 3.0;
  Search search{params, false};
  EXPECT_EQ(search.step(situationAt({-4, 1, 1.5}, 0.0, false), mission).wish.velocity_odom_mps.z(), 0.0);
  search = Search(params, true);
  EXPECT_GT(search.step(situationAt({-4, 1, 1.5}, 0.0, false), mission).wish.velocity_odom_mps.z(), 0.0);
  search = Search(params, true);
  EXPECT_EQ(search.step(situationAt({-4, 1, 5.0}, 0.0, false), mission).wish.velocity_odom_mps.z(), 0.0);
}

TEST(SearchBehaviour, LooksFirstWhereTheWindowWas) {
  MissionState mission;
  for (const double yaw : {-1.0, 1.0}) {
    mission.window_odom_m = Eigen::Vector3d(0, 0, 1.5);
    Search search{kDefaults, false};
    const auto decision = search.step(situationAt({-4, 0, 1.5}, 0.0, false, yaw), mission);
    EXPECT_LT(decision.wish.yaw_rate_radps * yaw, 0.0);
  }
}

TEST(SearchBehaviour, OneImageIsNoWindow) {
  MissionState mission;
  Search search{kDefaults, true};
  EXPECT_FALSE(search.step(situationAt({-4, 0, 1.5}, 0.0, true), mission).event);
  EXPECT_FALSE(search.step(situationAt({-4, 0, 1.5}, 0.1, false), mission).event);
  for (int i = 0; i < 2; ++i) EXPECT_FALSE(search.step(situationAt({-4, 0, 1.5}, 0.2, true), mission).event);
  EXPECT_EQ(search.step(situationAt({-4, 0, 1.5}, 0.3, true), mission).event, Event::kWindowFound);
}

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
    auto situation = situationAt({-3.0, 0.0, height_m}, now, true);
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
    auto situation = situationAt({-3.0, 0.0, height_m}, 0.05 * i, true);
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
        align.step(situationAt({-1.5, lateral_m, 1.5}, 0.0, true), mission).wish.velocity_odom_mps.x();
    EXPECT_EQ(forward_mps<-0.1, lateral_m> 0.0) << forward_mps;
  }
}

TEST(VelocityTowards, AsksForNoHarderBrakingThanTheVehicleHas) {
  NavigatorParams params;
  for (const double braking_mps2 : {0.5, 1.2, 3.0}) {
    params.vehicle.braking_mps2 = braking_mps2;
    constexpr double kStep = 0.001;
    double error_m = 4.0, last_mps = velocityTowards(error_m, 10.0, params);
    EXPECT_EQ(velocityTowards(-error_m, 10.0, params), -last_mps);
    EXPECT_EQ(velocityTowards(error_m, 0.4, params), 0.4);
    for (double t = 0.0; t < 20.0; t += kStep) {
      error_m -= kStep * last_mps;
      const double speed_mps = velocityTowards(error_m, 10.0, params);
      EXPECT_LE(last_mps - speed_mps, kStep * braking_mps2 * 1.01);
      last_mps = speed_mps;
    }
    EXPECT_NEAR(error_m, 0.0, 1e-3);
    EXPECT_GE(error_m, 0.0) << "never beyond";
  }
}

TEST(ApproachBehaviour, TurnsBackToAligningWhenTheApproachIsForbidden) {
  Approach approach{kDefaults};
  MissionState mission;
  auto situation = situationAt({-3.0, 0.0, 0.0}, 1.0, true);
  EXPECT_NE(approach.step(situation, mission).event, Event::kMisaligned);
  situation.target->approach_forbidden = "fit NO_GO: width 0.50 m";
  const Decision decision = approach.step(situation, mission);
  EXPECT_EQ(decision.event, Event::kMisaligned);
  EXPECT_EQ(decision.wish.velocity_odom_mps, Eigen::Vector3d(0, 0, 0));
  EXPECT_NE(decision.reason.find("0.50 m"), std::string::npos);
}

TEST(ApproachBehaviour, WaitsAtTheLineForWhatIsUnverifiedAndBacksOff) {
  Approach approach{kDefaults};
  MissionState mission;
  Decision decision;
  double now_sec = 10.0;
  for (; !decision.event && now_sec < 20.0; now_sec += 0.03) {
    Situation situation = situationAt({-0.8, 0, 1.5}, now_sec, true);
    situation.target->unverified = "camera mounting: a turn of 9 deg cannot be excluded yet";
    decision = approach.step(situation, mission);
    EXPECT_EQ(decision.reason, situation.target->unverified);
  }
  EXPECT_EQ(decision.event, Event::kCriterionUnmet);
  EXPECT_NEAR(now_sec - 10.0, kDefaults.approach.patience_sec, 0.1);
  EXPECT_NE(mission.unmet.find("camera mounting"), std::string::npos) << "what is said where it gives up";
}

TEST(ApproachBehaviour, GoesBackToTheLineThatItWasBlownAcross) {
  Approach approach{kDefaults};
  MissionState mission;
  const Decision beside = approach.step(situationAt({-0.8, 0.5, 1.5}, 1.0, true), mission);
  EXPECT_LT(beside.wish.velocity_odom_mps.x(), -0.3);
  const Decision before_it = approach.step(situationAt({-0.8, 0.0, 1.5}, 1.0, true), mission);
  EXPECT_EQ(before_it.event, Event::kCommitReached);
}

TEST(OtherWindow, IsLeftRememberedAndNotTakenAgain) {
  MissionState mission;
  Align align{kDefaults, 0.0};
  auto situation = situationAt({-5.0, 0.0, 1.5}, 0.0, true);
  situation.target->T_odom_window.translation() = Eigen::Vector3d(5.0, 2.0, 1.5);
  mission.trusted = situation.target;
  mission.window_odom_m = situation.target->T_odom_window.translation();
  EXPECT_NE(align.step(situation, mission).event, Event::kOtherWindow);
  situation.target->other_window = 0.5;
  situation.target->approach_forbidden = "another window: about 0.5 times as large";
  const Decision decision = align.step(situation, mission);
  EXPECT_EQ(decision.event, Event::kOtherWindow);
  EXPECT_EQ(decision.wish.velocity_odom_mps.norm(), 0.0);
  EXPECT_NE(decision.reason.find("0.5 times"), std::string::npos);
  ASSERT_EQ(mission.others_odom_m.size(), 1u);
  EXPECT_TRUE(mission.others_odom_m.front().isApprox(Eigen::Vector3d(0.0, 1.0, 1.5)));
  EXPECT_FALSE(mission.trusted || mission.window_odom_m) << "nothing may be flown by it any more";

  Search search{kDefaults, false};
  for (int i = 0; i < 10; ++i)
    EXPECT_FALSE(search.step(situationAt({-5.0, -1.0, 1.5}, 0.1 * i, false), mission).event);
  auto again = situationAt({-5.0, -1.0, 1.5}, 1.0, true);
  again.target->T_odom_window.translation() = Eigen::Vector3d(5.0, 3.1, 1.5);  // the same one, from elsewhere
  for (int i = 0; i < 10; ++i) EXPECT_FALSE(search.step(again, mission).event);
  auto right = situationAt({-5.0, -1.0, 1.5}, 2.0, true);
  Decision found;
  for (int i = 0; i < 3; ++i) found = search.step(right, mission);
  EXPECT_EQ(found.event, Event::kWindowFound);
}

TEST(OtherWindow, OnceAroundWithoutTheRightOneTheyGetAnotherChance) {
  MissionState mission;
  mission.others_odom_m.push_back({0.0, 0.0, 1.5});
  Search search{kDefaults, false};
  double yaw = 0.0;
  for (int i = 0; i < 10; ++i) search.step(situationAt({-4, 0, 1.5}, 0.0, true, yaw), mission);
  EXPECT_EQ(mission.others_odom_m.size(), 1u);
  for (double turned = 0.0; turned < 2.0 * M_PI + 0.1; turned += 0.05) {
    yaw = geometry::wrapAngle(yaw + 0.05);
    search.step(situationAt({-4, 0, 1.5}, 0.0, false, yaw), mission);
  }
  EXPECT_TRUE(mission.others_odom_m.empty());
}

TEST(StepPacer, StepsSidewaysOrForwardAndLooksAfterEach) {
  NavigatorParams params = test::withoutGlass();
  const Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  const Eigen::Vector3d wish(0.3, 0.5, 0);
  EXPECT_EQ(StepPacer(params).pace(wish, axes, situationAt({0, 0, 0}, 0.0, false)), wish);
  params.scheme = "stepped";
  StepPacer pacer(params);
  EXPECT_EQ(pacer.pace(wish, axes, situationAt({0, 0, 0}, 0.0, false)).norm(), 0.0) << "looks first";
  const Eigen::Vector3d step = pacer.pace(wish, axes, situationAt({0, 0, 0}, 0.6, false));
  EXPECT_EQ(step.x(), 0.0);
  EXPECT_GT(step.y(), 0.2);
  const Eigen::Vector3d end = pacer.pace(wish, axes, situationAt({0, 0.2, 0}, 1.0, false));
  EXPECT_GT(end.y(), 0.0);
  EXPECT_LT(end.y(), step.y());
  auto moving = situationAt({0, 0.25, 0}, 1.2, false);
  moving.vehicle->velocity_odom_mps.y() = 0.3;
  EXPECT_EQ(pacer.pace(wish, axes, moving).norm(), 0.0);
  EXPECT_EQ(pacer.pace(wish, axes, situationAt({0, 0.27, 0}, 1.4, false)).norm(), 0.0);
  EXPECT_EQ(pacer.pace(wish, axes, situationAt({0, 0.27, 0}, 1.8, false)).norm(), 0.0);
  EXPECT_GT(pacer.pace(wish, axes, situationAt({0, 0.27, 0}, 1.95, false)).y(), 0.2);
}

TEST(SearchBehaviour, TurnsSlowerForLongExposuresAndFewImages) {
  NavigatorParams params = test::withoutGlass();
  const auto rateWith = [&](double image_period_sec) {
    Search search{params, false};
    auto situation = situationAt({-4, 0, 1.5}, 0.0, false);
    situation.image_period_sec = image_period_sec;
    MissionState mission;
    return search.step(situation, mission).wish.yaw_rate_radps;
  };
  EXPECT_DOUBLE_EQ(rateWith(0.033), params.search.yaw_rate_radps);
  EXPECT_DOUBLE_EQ(rateWith(1.0), Search::kMaxTurnPerImage * params.vehicle.horizontal_fov_rad);
  params.vehicle.exposure_sec = 0.02;
  EXPECT_DOUBLE_EQ(rateWith(0.033), params.search.max_blur_px * params.vehicle.pixel_rad / 0.02);
}

TEST(BackOffBehaviour, GoesBackAlongTheAxisAndDoesNotTurnInTheReveal) {
  MissionState mission;
  mission.trusted = test::targetAtOrigin(0.0);
  mission.trusted->T_odom_window.linear() = geometry::yawRotation(0.4);
  BackOff back_off{kDefaults};
  const auto inside = back_off.step(situationAt({0.05, 0.05, 1.5}, 0.0, false, 0.8), mission);
  EXPECT_EQ(inside.wish.yaw_rate_radps, 0.0);
  const Eigen::Vector3d normal(std::cos(0.4), std::sin(0.4), 0.0);
  const Eigen::Vector3d left(-normal.y(), normal.x(), 0.0);
  EXPECT_NEAR(inside.wish.velocity_odom_mps.dot(normal), -kDefaults.back_off.speed_mps, 1e-12);
  const double offset_m = Eigen::Vector3d(0.05, 0.05, 0.0).dot(left);
  EXPECT_NEAR(inside.wish.velocity_odom_mps.dot(left), -kDefaults.align.lateral_gain_hz * offset_m, 1e-12);
  const auto outside = back_off.step(situationAt({-1.2, -0.35, 1.5}, 0.0, false, 1.2), mission);
  EXPECT_LT(outside.wish.yaw_rate_radps, 0.0);
  EXPECT_NEAR(outside.wish.velocity_odom_mps.dot(normal), -NavigatorParams().back_off.speed_mps, 1e-12);
  EXPECT_LT(outside.wish.velocity_odom_mps.dot(left), -0.1) << "clear of the reveal, back onto the normal";
}

TEST(BackOffBehaviour, EndsByTheWindowOrItsAbsenceOrTooManyTries) {
  MissionState mission;
  mission.trusted = test::targetAtOrigin(0.0);
  BackOff back_off{kDefaults};
  EXPECT_EQ(back_off.step(situationAt({-2.6, 0, 1.5}, 0.0, false), mission).event, Event::kBackedOff);
  EXPECT_FALSE(
      back_off.step(situationAt({-2.6, 0, 1.5}, 0.0, false, 1.0), mission).event);  // not facing it yet
  for (int i = 0; i < 2; ++i)
    EXPECT_FALSE(back_off.step(situationAt({-2.6, 0, 1.5}, 0.0, true), mission).event);
  EXPECT_EQ(back_off.step(situationAt({-2.6, 0, 1.5}, 0.0, true), mission).event, Event::kReacquired);
  mission.back_offs = BackOffParams().max_retries + 1;
  EXPECT_EQ(back_off.step(situationAt({-2.6, 0, 1.5}, 0.0, true), mission).event, Event::kGiveUp);
}

TEST(BackOffBehaviour, WithoutANormalItGoesNowhere) {
  MissionState mission;
  BackOff back_off{kDefaults};
  const auto decision = back_off.step(situationAt({-1.0, 0, 1.5}, 0.0, false), mission);
  EXPECT_EQ(decision.event, Event::kBackedOff);
  EXPECT_EQ(decision.wish.velocity_odom_mps.norm(), 0.0);
  mission.back_offs = BackOffParams().max_retries + 1;
  EXPECT_EQ(back_off.step(situationAt({-1.0, 0, 1.5}, 0.0, false), mission).event, Event::kGiveUp);
}

// An autopilot that limits the magnitude of its acceleration, in any direction.
TEST(VelocityAlongAxis, WhatAcceleratesSlowlyIsAskedForLittleForwardWhileItIsToMoveAcross) {
  NavigatorParams params = kDefaults;
  const TargetEstimate target = test::targetAtOrigin(0.0);
  const auto forwardAt = [&](double across_m) {
    const RelativeState relative = relate(test::vehicleAt({-1.5, across_m, 1.5}, 0.0), target);
    return velocityAlongAxis(relative, target, 0.9, Eigen::Vector3d::Zero(), params).x();
  };
  EXPECT_NEAR(forwardAt(0.0), 0.9, 1e-9);
  params.vehicle.braking_mps2 = 0.5;
  EXPECT_LT(forwardAt(0.3), 0.2);
  EXPECT_LT(forwardAt(-0.3), 0.2);
  EXPECT_NEAR(forwardAt(0.0), 0.9, 1e-9);
}

TEST(VelocityAlongAxis, AwayFromTheWindowGoesBeforeSideways) {
  const TargetEstimate target = test::targetAtOrigin(0.0);
  const auto wishFor = [&](double forward_mps) -> Eigen::Vector3d {
    const RelativeState relative = relate(test::vehicleAt({-1.5, 2.0, 2.5}, 0.0), target);
    return velocityAlongAxis(relative, target, forward_mps, {0.0, 0.4, 0.0}, kDefaults);
  };
  EXPECT_EQ(wishFor(-0.8).x(), -0.8);
  EXPECT_NEAR(wishFor(-0.8).norm(), kDefaults.limits.speed_mps, 1e-9);
  EXPECT_EQ(wishFor(-3.0), Eigen::Vector3d(-kDefaults.limits.speed_mps, 0.0, 0.0));
  EXPECT_NEAR(wishFor(0.8).tail<2>().norm(), kDefaults.limits.speed_mps, 1e-9);
}

TEST(CommitBehaviour, StaysBehindTheWindowAgainstTheWind) {
  MissionState mission;
  mission.committed = test::targetAtOrigin(0.0);
  mission.wind_odom_mps = Eigen::Vector3d(-0.4, 0.3, 0.0);
  Commit commit{kDefaults};
  auto at_exit = situationAt({kDefaults.commit.exit_distance_m, 0.0, 1.5}, 0.0, false);
  const auto decision = commit.step(at_exit, mission);
  EXPECT_NEAR(decision.wish.velocity_odom_mps.x(), 0.4, 1e-9);
  EXPECT_NEAR(decision.wish.velocity_odom_mps.y(), -0.3, 1e-9);
}

// Until the vehicle responds, it continues as commanded: it stops too late.
TEST(CommitBehaviour, TurnsBackOnlyWhereItCanStopFromWhatItTakesUpOfWhatItWasTold) {
  static constexpr double kBesideM = 0.8;  // here no commit criterion holds
  const auto eventAt = [](double distance_m, double told_mps) {
    MissionState mission;
    mission.committed = test::targetAtOrigin(0.0);
    mission.told_odom_mps = {told_mps, 0.0, 0.0};
    Commit commit{kDefaults};
    return commit.step(situationAt({-distance_m, kBesideM, 1.5}, 0.0, false), mission).event;
  };
  const auto& vehicle = kDefaults.vehicle;
  const double gained_mps = vehicle.response_sec * vehicle.braking_mps2;  // gained before it responds
  const double needed_m = vehicle.half_length_m + stoppingDistance(gained_mps, vehicle);
  EXPECT_EQ(eventAt(needed_m - 0.02, 0.0), Event::kCriterionUnmet);
  EXPECT_EQ(eventAt(needed_m - 0.02, 0.95), std::nullopt);
  EXPECT_EQ(eventAt(needed_m + 0.02, 0.95), Event::kCriterionUnmet);
}

// In the last metre a wrong heading comes back and moves the window in odom.
TEST(CommitBehaviour, FollowsAWindowThatIsSeenElsewhereOnlyWhereItCannotStop) {
  for (const double distance_m : {0.8, 2.5}) {
    MissionState mission;
    mission.committed = test::targetAtOrigin(0.0);
    Commit commit{kDefaults};
    Decision decision;
    for (int i = 0; i < 6; ++i) {
      auto situation = situationAt({-distance_m, 0.0, 1.5}, 0.05 * i, i > 0);
      situation.vehicle->velocity_odom_mps.x() = 0.95;
      if (i > 0) situation.target->T_odom_window.translation().y() += 0.3;
      EXPECT_EQ(decision.event, std::nullopt);
      decision = commit.step(situation, mission);
      const bool turns_back = i >= 3 && distance_m > 2.0;
      EXPECT_EQ(decision.event.has_value(), turns_back) << decision.reason;
      if (turns_back) break;
      EXPECT_NEAR(mission.committed->T_odom_window.translation().y(), i < 4 ? 0.0 : 0.3, 1e-9);
    }
    EXPECT_EQ(decision.wish.velocity_odom_mps.y() > 0.1, distance_m < 2.0);
  }
}

TEST(CommitBehaviour, IsNoFasterThanToldWithTheWindBehindIt) {
  const auto forwardWith = [](double wind_mps) {
    MissionState mission;
    mission.committed = test::targetAtOrigin(0.0);
    mission.wind_odom_mps.x() = wind_mps;
    Commit commit{kDefaults};
    auto situation = situationAt({-0.5, 0.0, 1.5}, 0.0, false);
    situation.vehicle->velocity_odom_mps.x() = 0.95;
    return commit.step(situation, mission).wish.velocity_odom_mps.x();
  };
  EXPECT_NEAR(forwardWith(0.3), forwardWith(0.0) - 0.3, 1e-9);
  EXPECT_DOUBLE_EQ(forwardWith(-0.3), forwardWith(0.0)) << "a gust against it may end";
}

TEST(CommitBehaviour, HasPassedOnlyWhereItStopsNotWhereItIsBlownBackTo) {
  MissionState mission;
  mission.committed = test::targetAtOrigin(0.0);
  Commit commit{kDefaults};
  EXPECT_EQ(commit.step(situationAt({1.2, 0.0, 1.5}, 0.0, false), mission).event, Event::kCrossed);
  const auto blown_back = commit.step(situationAt({0.1, 0.0, 1.5}, 0.1, false), mission);
  EXPECT_FALSE(blown_back.event);
  EXPECT_GT(blown_back.wish.velocity_odom_mps.x(), 0.3);
}

TEST(HoldBehaviour, LeavesTheWallAtOnceWhereWindCouldCarryItThere) {
  MissionState mission;
  mission.trusted = test::targetAtOrigin(0.0);
  for (const double distance_m : {0.5, 2.0}) {
    Hold hold{kDefaults, State::kApproach};
    const auto decision = hold.step(situationAt({-distance_m, 0.1, 1.5}, 0.0, false), mission);
    EXPECT_EQ(decision.event == Event::kWindowLost, distance_m < kDefaults.limits.wall_distance_m);
  }
}

TEST(HoldBehaviour, NeverRetreatsThroughTheOpening) {
  for (const double behind_m : {-0.5, 0.5}) {
    MissionState mission;
    mission.trusted = mission.committed = test::targetAtOrigin(0.0);
    Hold hold{kDefaults, State::kCommit};
    std::optional<Event> event;
    for (double now = 0.0; now < 2.0 && !event; now += 0.03) {
      auto situation = situationAt({behind_m, 0, 1.5}, now, false);
      const bool is_gone = std::fmod(now, 0.15) > 0.1;  // often interrupted: nothing can resume
      if (is_gone) situation.vehicle.reset();
      event = hold.step(situation, mission).event;
    }
    EXPECT_EQ(event == Event::kWindowLost, behind_m < 0.0);
  }
}

TEST(HoldBehaviour, RetreatsBeforeItGivesUpWhereOnlyTheImagesAreMissing) {
  for (const auto from : {State::kAlign, State::kApproach, State::kSearch}) {
    MissionState mission;
    mission.trusted = test::targetAtOrigin(0.0);
    Hold hold{kDefaults, from};
    std::optional<Event> event;
    for (double now = 0.0; now < 10.0 && !event; now += 0.03) {
      auto situation = situationAt({-1.0, 0, 1.5}, now, false);
      situation.image_fault = "last image 2.00 s old";
      event = hold.step(situation, mission).event;
    }
    EXPECT_EQ(event, from == State::kSearch ? Event::kGiveUp : Event::kWindowLost) << toString(from);
  }
}

/// First event of a HOLD that began at 0 s, with constant inputs; empty if there is none within 10 s.
std::optional<Event> wayOutOf(State from, MissionState mission, bool with_vehicle, bool with_target) {
  Hold hold{kDefaults, from};
  for (double now = 0.0; now < 10.0; now += 0.03) {
    auto situation = situationAt({-0.8, 0, 1.5}, now, with_target);
    if (!with_vehicle) situation.vehicle.reset();
    const auto decision = hold.step(situation, mission);
    EXPECT_EQ(decision.wish.velocity_odom_mps.norm(), 0.0);
    if (decision.event) return decision.event;
  }
  return std::nullopt;
}

TEST(HoldBehaviour, GoesOnFromWhereItCan) {
  MissionState nothing, known, committed;
  known.trusted = test::targetAtOrigin(0.0);
  committed.trusted = committed.committed = test::targetAtOrigin(0.0);
  EXPECT_EQ(wayOutOf(State::kApproach, known, true, true), Event::kReacquired);
  EXPECT_EQ(wayOutOf(State::kApproach, known, true, false), Event::kWindowLost);
  EXPECT_EQ(wayOutOf(State::kAlign, nothing, true, false), Event::kInputFresh);
  EXPECT_EQ(wayOutOf(State::kSearch, known, true, false), Event::kInputFresh);
  EXPECT_EQ(wayOutOf(State::kBackOff, known, true, false), Event::kWindowLost);
  EXPECT_EQ(wayOutOf(State::kCommit, committed, true, true), Event::kResumed);
  EXPECT_EQ(wayOutOf(State::kCommit, committed, true, false),
            Event::kWindowLost);  // odometry may have jumped
  EXPECT_EQ(wayOutOf(State::kCommit, known, true, true), Event::kWindowLost);
  EXPECT_EQ(wayOutOf(State::kCommit, nothing, true, true), Event::kReacquired);
  nothing.was_in_front = false;
  EXPECT_EQ(wayOutOf(State::kCommit, nothing, true, true), Event::kGiveUp);
  EXPECT_EQ(wayOutOf(State::kCommit, committed, false, true), Event::kGiveUp);
}

}  // namespace window_ingress::navigation::behaviours_test
