/// The transitions out of every live state, taken from each of these states.
#include <gtest/gtest.h>

#include "navigation_samples.hpp"
#include "window_ingress/navigation/navigator.hpp"

namespace window_ingress::navigation::navigator_edges_test {

constexpr double kStep = 1.0 / 30.0;
const Eigen::Vector3d kFar(-4.0, 0.0, 1.5), kLine(-1.1, 0.0, 1.5), kAside(-4.0, 3.8, 1.5),
    kInside(1.2, 0.0, 1.5);
constexpr State kLive[] = {State::kSearch, State::kAlign,   State::kApproach,
                           State::kCommit, State::kBackOff, State::kHold};

/// A mission that has reached a given state.
struct Mission {
  explicit Mission(const NavigatorParams& params = test::withoutGlass()) : navigator(params) {}

  Navigator navigator;
  double now = 10.0;
  Eigen::Vector3d at = kFar;
  NavigatorOutput output;

  void stay(int steps, bool with_target = true) {
    for (int i = 0; i < steps; ++i) step(test::inputAt(at, now + kStep, with_target));
  }
  void step(const NavigatorInput& input) { output = navigator.step(input, now += kStep); }
  /// Flies there and stops, as odometry would report it.
  void walk(const Eigen::Vector3d& to) {
    const Eigen::Vector3d way = (to - at) / 60.0;
    for (int i = 1; i <= 60; ++i) {
      at += way;
      auto input = test::inputAt(at, now + kStep);
      input.vehicle->velocity_odom_mps = i < 60 ? Eigen::Vector3d(way / kStep) : Eigen::Vector3d::Zero();
      step(input);
    }
  }
  void start(const Eigen::Vector3d& from) {
    at = from;
    ASSERT_TRUE(navigator.start(test::inputAt(at, now), now).success);
  }
  void leadInto(State state) {
    start(state == State::kAlign ? kAside : kFar);
    if (state == State::kSearch) return stay(2, false);
    stay(20);
    if (state == State::kCommit || state == State::kPassed) walk(kLine);
    if (state == State::kPassed) walk(kInside);
    if (state == State::kBackOff) walk({-2.0, 0.0, 1.5});
    if (state == State::kHold || state == State::kBackOff) stay(12, false);
    if (state == State::kBackOff) stay(35, false);
  }
};

TEST(NavigatorEdges, EveryLiveStateIsAbortedByTheOperator) {
  for (const State state : kLive) {
    Mission mission;
    mission.leadInto(state);
    ASSERT_EQ(mission.output.state, state) << toString(state) << ": " << mission.output.reason;
    EXPECT_TRUE(mission.navigator.abort().success);
    mission.stay(1);
    EXPECT_EQ(mission.output.state, State::kAborted);
    EXPECT_EQ(mission.output.setpoint.velocity_odom_mps.norm(), 0.0);
  }
  Mission idle;
  EXPECT_TRUE(idle.navigator.abort().success);
  idle.stay(1);
  EXPECT_EQ(idle.output.state, State::kAborted);
}

TEST(NavigatorEdges, WithoutAGuardThatPassesSetpointsOnEveryMovingStateHoldsUntilItIsBack) {
  for (const State state : kLive) {
    Mission mission;
    mission.leadInto(state);
    ASSERT_EQ(mission.output.state, state);
    for (int i = 0; i < 30; ++i) {
      auto input = test::inputAt(mission.at, mission.now + kStep, i % 2 == 0);
      input.passed_on = false;
      mission.step(input);
      ASSERT_EQ(mission.output.state, State::kHold) << toString(state);
      EXPECT_LT(mission.output.setpoint.velocity_odom_mps.x(), 1e-9) << "towards the window";
      EXPECT_NE(mission.output.reason.find("guard"), std::string::npos) << mission.output.reason;
    }
    mission.stay(60);
    EXPECT_TRUE(isMoving(mission.output.state) || mission.output.state == State::kPassed)
        << mission.output.reason;
  }
  Navigator navigator(test::withoutGlass());
  auto input = test::inputAt(kFar, 10.0);
  input.passed_on = false;
  const Reply reply = navigator.start(input, 10.0);
  EXPECT_FALSE(reply.success);
  EXPECT_NE(reply.message.find("guard"), std::string::npos) << reply.message;
}

TEST(NavigatorEdges, EveryLiveStateYieldsToThePilotAndFliesNothingWhenHeGivesItBack) {
  for (const State state : kLive) {
    Mission mission;
    mission.leadInto(state);
    ASSERT_EQ(mission.output.state, state);
    auto input = test::inputAt(mission.at, mission.now + kStep);
    input.engaged = false;
    mission.step(input);
    EXPECT_EQ(mission.output.state, State::kIdle);
    mission.stay(30);
    EXPECT_EQ(mission.output.state, State::kIdle);
    EXPECT_FALSE(mission.output.enabled);
    EXPECT_EQ(mission.output.setpoint.velocity_odom_mps.norm(), 0.0);
  }
}

TEST(NavigatorEdges, EveryMovingStateHoldsWithoutOdometry) {
  for (const State state : kLive) {
    Mission mission;
    mission.leadInto(state);
    ASSERT_EQ(mission.output.state, state);
    auto input = test::inputAt(mission.at, mission.now + kStep);
    input.vehicle.reset();
    mission.step(input);
    EXPECT_EQ(mission.output.state, State::kHold) << toString(state);
    EXPECT_EQ(mission.output.setpoint.velocity_odom_mps.norm(), 0.0);
  }
}

TEST(NavigatorEdges, AfterZerosOfTheCallerTheVelocityGrowsAnew) {
  const LimitParams limits;
  Mission mission;
  mission.leadInto(State::kApproach);
  mission.stay(30);
  ASSERT_GT(mission.output.setpoint.velocity_odom_mps.norm(), 0.3) << mission.output.reason;
  mission.navigator.sentZero();
  mission.stay(1);
  ASSERT_EQ(mission.output.state, State::kApproach) << mission.output.reason;
  EXPECT_GT(mission.output.setpoint.velocity_odom_mps.norm(), 0.0);
  EXPECT_LE(mission.output.setpoint.velocity_odom_mps.norm(), limits.acceleration_mps2 * kStep + 1e-9);
}

TEST(NavigatorEdges, EveryLiveStateGivesUpWhenTheMissionTakesTooLong) {
  for (const State state : kLive) {
    NavigatorParams params = test::withoutGlass();
    params.timeouts.total_sec = 30.0;
    Mission mission(params);
    mission.leadInto(state);
    ASSERT_EQ(mission.output.state, state);
    for (int i = 0; i < 40; ++i) {
      mission.now += 0.9;  // not a clock jump
      mission.stay(1);
    }
    EXPECT_EQ(mission.output.state, State::kAborted) << toString(state);
  }
}

TEST(NavigatorEdges, CommitAndBackOffTimeOutByName) {
  for (const State state : {State::kCommit, State::kBackOff}) {
    NavigatorParams params = test::withoutGlass();
    params.timeouts.commit_sec = params.timeouts.back_off_sec = 1.0;
    params.search.next_window = true;  // a vehicle that cannot retreat must not turn to another window
    Mission mission(params);
    mission.leadInto(state);
    ASSERT_EQ(mission.output.state, state);
    mission.stay(31, state == State::kCommit);
    EXPECT_EQ(mission.output.state, State::kAborted);
    EXPECT_EQ(mission.output.reason, std::string(toString(state)) + " timed out");
  }
}

TEST(NavigatorEdges, ApproachLeavesAnotherWindow) {
  Mission mission;
  mission.leadInto(State::kApproach);
  ASSERT_EQ(mission.output.state, State::kApproach);
  auto input = test::inputAt(mission.at, mission.now + kStep);
  input.target->other_window = 0.6;
  input.target->approach_forbidden = "another window";
  mission.step(input);
  EXPECT_EQ(mission.output.state, State::kSearch);
}

TEST(NavigatorEdges, AClosedWindowIsGivenUpOnce) {
  Mission mission;
  mission.leadInto(State::kSearch);
  for (int i = 0; i < 30 && mission.output.report.given_up.empty(); ++i) {
    auto input = test::inputAt(mission.at, mission.now + kStep);
    input.target->window_id = 3;
    input.target->openness.openness = openness::Openness::kClosed;
    mission.step(input);
  }
  mission.stay(10, false);
  EXPECT_EQ(mission.output.report.given_up, std::vector<std::uint32_t>{3});
}

/// Odometry is missing for a moment during COMMIT, without images before and after.
NavigatorOutput interruptedAt(const Eigen::Vector3d& place, int step) {
  Mission mission;
  mission.leadInto(State::kCommit);
  mission.walk(place);
  const double last_image_sec = mission.now;
  for (int i = 0; i < 90; ++i) {
    auto input = test::inputAt(mission.at, mission.now + kStep, false);
    if (mission.output.state == State::kCommit && i > 0)
      input.vehicle->velocity_odom_mps = mission.output.setpoint.velocity_odom_mps;
    input.image_stamp_sec = last_image_sec;
    if (i >= step && i < step + 4) input.vehicle.reset();
    mission.step(input);
    if (i == step + 3) {
      EXPECT_EQ(mission.output.state, State::kHold) << mission.output.reason;
    }
    if (mission.output.state == State::kCommit)
      mission.at += kStep * mission.output.setpoint.velocity_odom_mps;
  }
  return mission.output;
}

TEST(NavigatorEdges, BehindThePlaneACommitIsResumedWithoutImages) {
  const auto output = interruptedAt({0.0, 0.0, 1.5}, 31);
  EXPECT_EQ(output.state, State::kPassed) << output.reason;
}

TEST(NavigatorEdges, InFrontOfThePlaneItIsNot) {
  const auto output = interruptedAt({-1.1, 0.0, 1.5}, 8);
  EXPECT_NE(output.state, State::kCommit);
  EXPECT_NE(output.state, State::kPassed);
  EXPECT_LE(output.setpoint.velocity_odom_mps.x(), 0.0);
}

TEST(NavigatorEdges, WhenTheClockLeapsAheadEverythingIsOldAndNothingMoves) {
  for (const State state : kLive) {
    Mission mission;
    mission.leadInto(state);
    ASSERT_EQ(mission.output.state, state);
    const auto before = test::inputAt(mission.at, mission.now + kStep);
    mission.now += 5.0;
    mission.step(before);
    EXPECT_EQ(mission.output.setpoint.velocity_odom_mps.norm(), 0.0) << toString(state);
    EXPECT_TRUE(mission.output.state == State::kHold || isEnd(mission.output.state))
        << toString(mission.output.state);
  }
}

TEST(NavigatorEdges, AResetLeadsOnFromAPassedWindow) {
  Mission mission;
  mission.leadInto(State::kPassed);
  ASSERT_EQ(mission.output.state, State::kPassed) << mission.output.reason;
  EXPECT_TRUE(mission.navigator.reset().success);
  mission.stay(1);
  EXPECT_EQ(mission.output.state, State::kIdle);
}

}  // namespace window_ingress::navigation::navigator_edges_test
