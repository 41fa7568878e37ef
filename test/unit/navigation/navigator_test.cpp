/// The navigator's requests and transitions, step by step.
#include "window_ingress/navigation/navigator.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <stdexcept>

#include "navigation_samples.hpp"

namespace window_ingress::navigation::navigator_test {

using test::inputAt;
using test::targetAtOrigin;

constexpr double kStep = 1.0 / 30.0;

/// Steps a navigator with constant inputs.
class NavigatorSteps : public testing::Test {
 protected:
  NavigatorParams params_ = test::withoutGlass();
  double now_ = 10.0;

  NavigatorOutput steps(Navigator& navigator, const Eigen::Vector3d& at, int count, bool with_target = true,
                        bool trusted = true, const Eigen::Vector3d& velocity_mps = Eigen::Vector3d::Zero()) {
    NavigatorOutput output;
    for (int i = 0; i < count; ++i) {
      now_ += kStep;
      auto input = inputAt(at, now_, with_target);
      input.vehicle->velocity_odom_mps = velocity_mps;
      if (with_target) input.target = targetAtOrigin(now_, trusted);
      output = navigator.step(input, now_);
    }
    return output;
  }
  /// Moves the vehicle there in small steps and stops it, as odometry would report it.
  NavigatorOutput walk(Navigator& navigator, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                       bool with_target = true) {
    NavigatorOutput output;
    constexpr int kSteps = 100;  // about as fast as commanded
    const Eigen::Vector3d velocity_mps = (to - from) / (kSteps * kStep);
    for (int i = 1; i < kSteps; ++i)
      output = steps(navigator, from + (to - from) * i / kSteps, 1, with_target, true, velocity_mps);
    output = steps(navigator, to, 1, with_target);
    return output;
  }
  void start(Navigator& navigator, const Eigen::Vector3d& at) {
    EXPECT_TRUE(navigator.start(inputAt(at, now_), now_).success);
  }
};

const Eigen::Vector3d kFar(-4.0, 0.0, 1.5), kLine(-1.1, 0.0, 1.5), kAside(-4.0, 3.8, 1.5);

TEST_F(NavigatorSteps, IsSilentBeforeTheStart) {
  Navigator navigator(params_);
  const auto output = steps(navigator, kFar, 10);
  EXPECT_EQ(output.state, State::kIdle);
  EXPECT_FALSE(output.enabled);
  EXPECT_EQ(output.setpoint.velocity_odom_mps.norm(), 0.0);
}

TEST_F(NavigatorSteps, StartListsEveryUnmetCondition) {
  Navigator navigator(params_);
  NavigatorInput nothing;
  nothing.engaged = false;
  nothing.image_stamp_sec = 1.0;
  const auto reply = navigator.start(nothing, now_);
  EXPECT_FALSE(reply.success);
  EXPECT_EQ(reply.message,
            "not started: no odometry; last image in window_pose 9.00 s old; "
            "the vehicle is not armed, not in a mode that follows setpoints, or in a failsafe");
  NavigatorInput blind = inputAt(kFar, now_);
  blind.image_stamp_sec.reset();
  EXPECT_EQ(navigator.start(blind, now_).message, "not started: no image searched so far");
  EXPECT_FALSE(navigator.start(inputAt(kFar, now_), std::numeric_limits<double>::quiet_NaN()).success);
  EXPECT_EQ(steps(navigator, kFar, 1).state, State::kIdle);
}

TEST_F(NavigatorSteps, StartIsRefusedWhereNoImageCanGiveAPose) {
  Navigator navigator(params_);
  NavigatorInput input = inputAt(kFar, now_);
  input.camera_fault = "no calibration: no camera_info on /camera/camera_info so far";
  const Reply reply = navigator.start(input, now_);
  EXPECT_FALSE(reply.success);
  EXPECT_EQ(reply.message, "not started: " + input.camera_fault);
  input.camera_fault.clear();
  input.camera = CameraInBody{0.1, 1.2, 0.1, 0.002};
  EXPECT_NE(navigator.start(input, now_).message.find("vertical_fov_rad"), std::string::npos);
  input.camera = CameraInBody{0.1, 1.2, 0.95, 0.002};
  EXPECT_TRUE(navigator.start(input, now_).success);
}

TEST_F(NavigatorSteps, TheCommitLineIsThatOfTheCameraThereIsNotOfTheOneConfigured) {
  const auto commitDistance = [&](const std::optional<CameraInBody>& camera) {
    Navigator navigator(params_);
    NavigatorInput input = inputAt(kFar, now_);
    input.camera = camera;
    return navigator.step(input, now_).report.commit_distance_m;
  };
  CameraInBody camera = params_.vehicle.camera;
  const double configured_m = commitDistance(std::nullopt);
  EXPECT_DOUBLE_EQ(commitDistance(camera), configured_m);
  camera.forward_m += 0.2;
  EXPECT_NEAR(commitDistance(camera), configured_m + 0.2, 1e-9);
  camera.horizontal_fov_rad = camera.vertical_fov_rad = 0.8;
  EXPECT_GT(commitDistance(camera), configured_m + 0.3);
  camera.forward_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_DOUBLE_EQ(commitDistance(camera), configured_m);
}

TEST_F(NavigatorSteps, StartSaysThatTheApproachIsForbiddenAlready) {
  Navigator navigator(params_);
  NavigatorInput forbidden = inputAt(kFar, now_);
  forbidden.target->approach_forbidden = "fit NO_GO: too narrow";
  const Reply reply = navigator.start(forbidden, now_);
  EXPECT_TRUE(reply.success);
  EXPECT_NE(reply.message.find("the approach is forbidden so far: fit NO_GO: too narrow"), std::string::npos)
      << reply.message;
}

TEST_F(NavigatorSteps, StartTwiceAbortTwiceResetTwice) {
  Navigator navigator(params_);
  start(navigator, kFar);
  EXPECT_EQ(navigator.start(inputAt(kFar, now_), now_).message, "already flying: SEARCH");
  EXPECT_FALSE(navigator.reset().success);
  EXPECT_TRUE(navigator.abort().success);
  EXPECT_TRUE(navigator.abort().success);
  EXPECT_EQ(navigator.start(inputAt(kFar, now_), now_).message, "mission ended as ABORTED: reset first");
  EXPECT_TRUE(navigator.reset().success);
  EXPECT_TRUE(navigator.reset().success);
  start(navigator, kFar);
}

TEST_F(NavigatorSteps, AbortIsZeroInTheNextStepAndLaterSilent) {
  Navigator navigator(params_);
  start(navigator, kFar);
  EXPECT_GT(steps(navigator, kFar, 40).setpoint.velocity_odom_mps.norm(), 0.3);
  navigator.abort();
  auto output = steps(navigator, kFar, 1);
  EXPECT_EQ(output.state, State::kAborted);
  EXPECT_EQ(output.setpoint.velocity_odom_mps.norm(), 0.0);
  EXPECT_TRUE(output.enabled);
  output = steps(navigator, kFar, 120);
  EXPECT_FALSE(output.enabled);
  EXPECT_EQ(output.reason, "aborted by the operator");
}

TEST_F(NavigatorSteps, GoesThroughTheStatesAsTheInputSays) {
  Navigator navigator(params_);
  start(navigator, kFar);
  EXPECT_EQ(steps(navigator, kFar, 5, false).state, State::kSearch);
  EXPECT_EQ(steps(navigator, kFar, 4).state, State::kAlign);
  EXPECT_EQ(steps(navigator, kFar, 10).state, State::kApproach);
  EXPECT_EQ(steps(navigator, kFar, 1, true, false).state, State::kAlign);  // sign lost: misaligned
  EXPECT_EQ(steps(navigator, kFar, 10).state, State::kApproach);
  EXPECT_EQ(walk(navigator, kFar, kLine).state, State::kCommit);
  EXPECT_EQ(walk(navigator, kLine, {1.2, 0.0, 1.5}).state, State::kPassed);
  const auto output = steps(navigator, {1.2, 0.0, 1.5}, 1);
  EXPECT_TRUE(output.enabled);
  EXPECT_LE(output.setpoint.velocity_odom_mps.norm(), params_.hold.speed_mps) << "keeps its place";
}

TEST_F(NavigatorSteps, AWindowOnceFlownAtIsNotExchangedForAnother) {
  Navigator navigator(params_);
  start(navigator, kFar);
  EXPECT_EQ(steps(navigator, kFar, 20).state, State::kApproach);
  NavigatorOutput output;
  std::set<State> states;
  for (int i = 0; i < 200; ++i) {
    now_ += kStep;
    auto input = inputAt(kFar, now_);
    input.target->T_odom_window.translation().y() += 2.2;
    output = navigator.step(input, now_);
    states.insert(output.state);
    const double most_mps = i > 12 ? params_.hold.speed_mps : params_.limits.speed_mps;
    EXPECT_LE(output.setpoint.velocity_odom_mps.head<2>().norm(), most_mps + 1e-9) << i;
  }
  EXPECT_TRUE(states.count(State::kHold) && states.count(State::kSearch));
  EXPECT_EQ(steps(navigator, kFar, 30).state, State::kApproach) << "the right one is taken again";
}

TEST_F(NavigatorSteps, TurnsBackFromACommitWhenTheWindowIsSeenElsewhere) {
  Navigator navigator(params_);
  start(navigator, kFar);
  NavigatorOutput output = walk(navigator, kFar, kLine);
  ASSERT_EQ(output.state, State::kCommit);
  for (int i = 0; i < 3; ++i) {
    now_ += kStep;
    auto input = inputAt(kLine, now_);
    input.target = targetAtOrigin(now_);
    input.target->T_odom_window.translation().y() += 0.3;  // the effect of an odometry drift of 0.3 m
    EXPECT_EQ(output.state, State::kCommit);
    output = navigator.step(input, now_);
  }
  EXPECT_EQ(output.state, State::kBackOff) << output.reason;
  EXPECT_LE(output.setpoint.velocity_odom_mps.x(), 0.0);
  EXPECT_NEAR(output.report.lateral_m, -0.3, 1e-3) << "by the window as it is seen now";
}

TEST_F(NavigatorSteps, TurnsBackFromACommitWhenItIsCarriedOffTheAxisAgainstWhatItIsTold) {
  Navigator navigator(params_);
  start(navigator, kFar);
  NavigatorOutput output = walk(navigator, kFar, kLine);
  ASSERT_EQ(output.state, State::kCommit);
  for (int i = 0; i < 30 && output.state == State::kCommit; ++i) {
    now_ += kStep;
    auto input = inputAt(kLine, now_);
    input.vehicle->velocity_odom_mps.y() = 0.6;  // carried by the wind, whatever the command
    output = navigator.step(input, now_);
  }
  EXPECT_EQ(output.state, State::kBackOff) << output.reason;
}

TEST_F(NavigatorSteps, AClockThatJumpsAheadHoldsAndGoesOn) {
  Navigator navigator(params_);
  start(navigator, kFar);
  EXPECT_EQ(steps(navigator, kFar, 20).state, State::kApproach);
  const auto stale = inputAt(kFar, now_);
  now_ += 950.0;
  const auto output = navigator.step(stale, now_);
  EXPECT_EQ(output.state, State::kHold) << output.reason;
  EXPECT_EQ(output.setpoint.velocity_odom_mps.norm(), 0.0);
  EXPECT_NE(steps(navigator, kFar, 20).state, State::kAborted);
}

TEST_F(NavigatorSteps, BacksOffFromTheLineWithoutAContractAndComesBack) {
  params_.vehicle.margin_m = 0.33;  // leaves almost no clearance
  Navigator navigator(params_);
  start(navigator, kFar);
  walk(navigator, kFar, kFar);
  auto output = walk(navigator, kFar, kLine);
  output = steps(navigator, kLine, 65);
  EXPECT_EQ(output.state, State::kBackOff) << output.reason;
  EXPECT_LT(output.setpoint.velocity_odom_mps.x(), 0.0);
  EXPECT_EQ(output.report.retries, 1);
  output = walk(navigator, kLine, {-2.6, 0.0, 1.5});
  EXPECT_TRUE(output.state == State::kAlign || output.state == State::kApproach) << toString(output.state);
}

TEST_F(NavigatorSteps, BacksOffAndSearchesWhenTheWindowIsLost) {
  Navigator navigator(params_);
  start(navigator, kFar);
  walk(navigator, kFar, {-2.0, 0, 1.5});
  auto output = steps(navigator, {-2.0, 0, 1.5}, 11, false);
  EXPECT_EQ(output.state, State::kHold);
  EXPECT_EQ(output.setpoint.velocity_odom_mps.norm(), 0.0);
  output = steps(navigator, {-2.0, 0, 1.5}, 35, false);
  EXPECT_EQ(output.state, State::kBackOff);
  output = walk(navigator, {-2.0, 0, 1.5}, {-2.55, 0, 1.5}, false);
  EXPECT_EQ(output.state, State::kSearch) << output.reason;
  EXPECT_EQ(output.setpoint.velocity_odom_mps.head<2>().norm(), 0.0);
}

TEST_F(NavigatorSteps, NoMissionStartsInTheOpeningThatTheLastOneFlewAt) {
  for (const bool aborted : {false, true}) {
    Navigator navigator(params_);
    start(navigator, kFar);
    walk(navigator, kFar, kLine);
    const Eigen::Vector3d there(-0.3, 0.0, 1.5);
    ASSERT_EQ(walk(navigator, kLine, there).state, State::kCommit);
    auto input = inputAt(there, now_ += kStep);
    input.engaged = aborted;  // otherwise the pilot has taken over
    if (aborted) navigator.abort("asked");
    navigator.step(input, now_);
    EXPECT_TRUE(navigator.reset().success);
    ASSERT_EQ(steps(navigator, there, 1).state, State::kIdle);
    const auto reply = navigator.start(inputAt(there, now_), now_);
    EXPECT_FALSE(reply.success);
    EXPECT_EQ(reply.message,
              "not started: the vehicle is in the opening of the previous mission, 0.30 m from its plane: "
              "take it a metre away by hand");
    walk(navigator, there, {-1.5, 0.0, 1.5});
    EXPECT_TRUE(navigator.start(inputAt({-1.5, 0.0, 1.5}, now_), now_).success);
  }
}

TEST_F(NavigatorSteps, NearTheWallThatTheLastMissionFlewAtASearchDoesNotClimb) {
  for (const double x_m : {-2.0, 1.5, -4.0}) {
    Navigator navigator(params_);
    start(navigator, kFar);
    walk(navigator, kFar, {-2.0, 0.0, 1.5});
    auto input = inputAt({-2.0, 0.0, 1.5}, now_ += kStep);
    input.engaged = false;
    navigator.step(input, now_);
    const Eigen::Vector3d there(x_m, 0.0, 0.6);
    walk(navigator, {-2.0, 0.0, 1.5}, there, false);
    start(navigator, there);
    double fastest_mps = 0.0;
    for (int i = 0; i < 30; ++i)
      fastest_mps = std::max(fastest_mps, steps(navigator, there, 1, false).setpoint.velocity_odom_mps.z());
    EXPECT_EQ(fastest_mps > 0.01, x_m == -4.0) << x_m;
  }
}

TEST_F(NavigatorSteps, NeverFliesAtAWindowFromBehind) {
  Navigator navigator(params_);
  start(navigator, kFar);
  for (int i = 0; i < 200; ++i) {
    now_ += kStep;
    auto input = inputAt(kFar, now_);
    input.target->T_odom_window.linear() = geometry::yawRotation(M_PI);
    EXPECT_LE(navigator.step(input, now_).setpoint.velocity_odom_mps.head<2>().norm(), 1e-3) << i;
  }
}

TEST_F(NavigatorSteps, TurnsBackFromACommitThatIsForbidden) {
  Navigator navigator(params_);
  start(navigator, kFar);
  NavigatorOutput output = walk(navigator, kFar, kLine);
  ASSERT_EQ(output.state, State::kCommit);
  for (int i = 0; i < 3; ++i) {
    auto input = inputAt(kLine, now_ += kStep);
    input.target->approach_forbidden = "fit NO_GO: width 0.50 m";
    output = navigator.step(input, now_);
  }
  EXPECT_EQ(output.state, State::kBackOff) << output.reason;
}

TEST_F(NavigatorSteps, AHoldDoesNotLeadBackToAnotherWindow) {
  Navigator navigator(params_);
  start(navigator, kFar);
  EXPECT_EQ(steps(navigator, kFar, 4).state, State::kAlign);
  const auto input = [&](bool has_images) {
    auto input = inputAt(kFar, now_ += kStep);
    input.target->other_window = 0.6;
    input.target->approach_forbidden = "another window";
    if (!has_images) input.image_stamp_sec = now_ - 2.0;
    return input;
  };
  EXPECT_EQ(navigator.step(input(true), now_).state, State::kSearch);
  EXPECT_EQ(navigator.step(input(false), now_).state, State::kHold);
  for (int i = 0; i < 30; ++i) EXPECT_NE(navigator.step(input(true), now_).state, State::kAlign);
}

TEST_F(NavigatorSteps, AbortAfterTheEndKeepsNoPlace) {
  for (const bool aborts : {false, true}) {
    Navigator navigator(params_);
    now_ += 100.0;
    start(navigator, kFar);
    walk(navigator, kFar, kLine);
    const Eigen::Vector3d inside(1.2, 0.0, 1.5);
    ASSERT_EQ(walk(navigator, kLine, inside).state, State::kPassed);
    steps(navigator, inside, 10);
    if (aborts) navigator.abort();
    const auto output = walk(navigator, inside, inside + Eigen::Vector3d(0.0, 0.5, 0.0));
    EXPECT_EQ(output.setpoint.velocity_odom_mps.norm() > 0.05, !aborts);
  }
}

TEST_F(NavigatorSteps, HoldKeepsThePlaceOfSearch) {
  Navigator navigator(params_);
  start(navigator, kFar);
  ASSERT_EQ(steps(navigator, kFar, 10, false).state, State::kSearch);
  const Eigen::Vector3d drifted = kFar + Eigen::Vector3d(0.0, 0.3, 0.0);
  walk(navigator, kFar, drifted, false);
  NavigatorOutput output;
  for (int i = 0; i < 40; ++i) {
    NavigatorInput blind = inputAt(drifted, now_ += kStep, false);
    blind.image_stamp_sec = now_ - 5.0;
    output = navigator.step(blind, now_);
  }
  ASSERT_EQ(output.state, State::kHold);
  EXPECT_LT(output.setpoint.velocity_odom_mps.y(), -0.1) << "back to where the search began";
}

TEST_F(NavigatorSteps, GoesBackToNoPlaceThatSomebodyTookItFarAwayFrom) {
  Navigator navigator(params_);
  start(navigator, kFar);
  walk(navigator, kFar, kLine);
  const Eigen::Vector3d inside(1.2, 0.0, 1.5), elsewhere(4.0, 0.0, 1.5);
  ASSERT_EQ(walk(navigator, kLine, inside).state, State::kPassed);
  for (int i = 0; i < 60; ++i) {
    auto input = inputAt(inside + (elsewhere - inside) * i / 60.0, now_ += kStep);
    input.vehicle->velocity_odom_mps.x() = 1.5;
    navigator.step(input, now_);
  }
  EXPECT_LT(steps(navigator, elsewhere, 20).setpoint.velocity_odom_mps.norm(), 1e-3);
}

TEST_F(NavigatorSteps, AClockThatJumpsBackGivesNoTimeBack) {
  params_.timeouts.total_sec = 5.0;
  Navigator navigator(params_);
  now_ = 1000.0;
  start(navigator, kFar);
  steps(navigator, kFar, 30, false);
  now_ = 100.0;
  EXPECT_EQ(steps(navigator, kFar, 160, false).state, State::kAborted);
}

TEST_F(NavigatorSteps, OdometryThatRepeatsItselfWhileTheVehicleIsToldToMoveIsStuck) {
  Navigator navigator(params_);
  start(navigator, kFar);
  EXPECT_EQ(steps(navigator, kFar, 20).state, State::kApproach);
  const auto frozen = inputAt(kFar, now_).vehicle;
  NavigatorOutput output;
  for (int i = 0; i < 300; ++i) {
    auto input = inputAt(kFar, now_ += kStep);
    input.vehicle->T_odom_base = frozen->T_odom_base;
    output = navigator.step(input, now_);
    if (i > 20) {
      EXPECT_EQ(output.setpoint.velocity_odom_mps.norm(), 0.0) << i;
    }
  }
  EXPECT_EQ(output.state, State::kAborted);
  EXPECT_NE(output.reason.find("stuck"), std::string::npos) << output.reason;
}

TEST_F(NavigatorSteps, EveryStateTimesOutByName) {
  params_.timeouts.search_sec = params_.timeouts.align_sec = params_.timeouts.approach_sec = 1.0;
  params_.timeouts.commit_sec = 1.0;
  Navigator searching(params_), aligning(params_), approaching(params_), committed(params_);
  start(searching, kFar);
  EXPECT_EQ(steps(searching, kFar, 40, false).reason, "SEARCH timed out");
  start(aligning, kAside);
  EXPECT_EQ(steps(aligning, kAside, 60).reason, "ALIGN timed out");
  start(approaching, kFar);
  EXPECT_EQ(steps(approaching, kFar, 60).reason, "APPROACH timed out");
  params_.timeouts.approach_sec = 30.0;
  start(committed, kFar);
  walk(committed, kFar, kFar);
  params_.timeouts.total_sec = 2.0;
  Navigator total(params_);
  start(total, kFar);
  EXPECT_EQ(steps(total, kFar, 70).state, State::kAborted);
}

TEST_F(NavigatorSteps, HoldsAndGivesUpWithoutOdometry) {
  Navigator navigator(params_);
  start(navigator, kFar);
  steps(navigator, kFar, 20);
  NavigatorInput input;
  input.target = targetAtOrigin(now_);
  auto output = navigator.step(input, now_ += kStep);
  EXPECT_EQ(output.state, State::kHold);
  EXPECT_EQ(output.reason, "no odometry");
  EXPECT_EQ(output.setpoint.velocity_odom_mps.norm(), 0.0);
  for (double held = 0.0; held < params_.hold.timeout_sec + 0.2; held += kStep)
    output = navigator.step(input, now_ += kStep);
  EXPECT_EQ(output.state, State::kAborted);
  EXPECT_EQ(output.reason, "held too long: no odometry");
}

TEST_F(NavigatorSteps, HoldsWhenTheCameraFallsSilentDuringTheSearch) {
  Navigator navigator(params_);
  start(navigator, kFar);
  auto input = inputAt(kFar, now_, false);
  input.image_stamp_sec = now_ - 2.0;
  const auto output = navigator.step(input, now_);
  EXPECT_EQ(output.state, State::kHold);
  EXPECT_EQ(output.reason, "last image in window_pose 2.00 s old");
}

TEST(NavigatorParamsCheck, RefusesLimitsThatCannotBrakeAsPlanned) {
  NavigatorParams params;
  params.limits.acceleration_mps2 = 0.5 * params.vehicle.braking_mps2;
  EXPECT_THROW(Navigator{params}, std::invalid_argument);
}

TEST(NavigatorParamsCheck, ListsEveryFault) {
  NavigatorParams params;
  params.limits.speed_mps = std::numeric_limits<double>::quiet_NaN();
  params.search.turns = 0;
  params.limits.min_height_m = 11.0;
  try {
    Navigator navigator(params);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    const std::string text = error.what();
    for (const char* name : {"limits/speed_mps", "search/turns", "limits/min_height_m"}) {
      EXPECT_NE(text.find(name), std::string::npos) << text;
    }
  }
}

}  // namespace window_ingress::navigation::navigator_test
