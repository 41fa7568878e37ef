#include "navigation/mission/window_choice.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "navigation/behaviours/align.hpp"
#include "navigation/behaviours/search.hpp"
#include "navigation_samples.hpp"
#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/navigation/navigator.hpp"

namespace window_ingress::navigation::window_choice_test {

const NavigatorParams kDefaults = test::withoutGlass();

NavigatorInput inputFor(std::uint32_t window_id, double now_sec, double aside_m = 0.0) {
  NavigatorInput input = test::inputAt({-4.0, 0.0, 1.5}, now_sec);
  input.target->window_id = window_id;
  input.target->T_odom_window.translation().y() += aside_m;
  return input;
}

/// A navigator whose target is window 1.
struct Flying {
  Navigator navigator{test::withoutGlass()};
  double now_sec = 1.0;
  NavigatorOutput step(const NavigatorInput& input) { return navigator.step(input, now_sec); }
  Flying() {
    navigator.start(inputFor(1, now_sec), now_sec);
    for (int n = 0; n < 30; ++n, now_sec += 0.033) step(inputFor(1, now_sec));
  }
};

TEST(WindowChoice, FliesAtTheWindowThatTheReportNames) {
  Flying flying;
  const auto output = flying.step(inputFor(1, flying.now_sec));
  EXPECT_TRUE(output.state == State::kAlign || output.state == State::kApproach);
  EXPECT_EQ(output.report.window_id, 1u);
}

TEST(WindowChoice, SaysWhyItLeavesAWindowWhenAnotherIsChosen) {
  Flying flying;
  const auto output = flying.step(inputFor(2, flying.now_sec));
  EXPECT_EQ(output.state, State::kSearch);
  EXPECT_NE(output.reason.find("window 2 is now the target instead of window 1"), std::string::npos);
}

TEST(WindowChoice, TurnsToTheWindowThatIsChosenInFlightWhereverItIs) {
  Flying flying;
  NavigatorOutput output;
  for (int n = 0; n < 60; ++n, flying.now_sec += 0.033)
    output = flying.step(inputFor(2, flying.now_sec, 2.0));
  EXPECT_EQ(output.report.window_id, 2u);
  EXPECT_TRUE(output.report.given_up.empty()) << "the one before may be chosen again";
}

TEST(WindowChoice, AWindowWithoutANumberIsNoOtherWindow) {
  Flying flying;
  EXPECT_NE(flying.step(inputFor(0, flying.now_sec)).state, State::kSearch);
}

TEST(WindowChoice, CommitFliesOn) {
  Situation situation;
  situation.target = test::targetAtOrigin(1.0);
  situation.target->window_id = 2;
  MissionState mission;
  mission.trusted = test::targetAtOrigin(1.0);
  mission.trusted->window_id = 1;
  EXPECT_EQ(whySentElsewhere(situation, State::kCommit, mission), "");
  for (const State state : {State::kAlign, State::kApproach, State::kHold, State::kBackOff, State::kSearch})
    EXPECT_NE(whySentElsewhere(situation, state, mission), "");
}

TEST(WindowChoice, AWindowTriedInVainIsLeftForTheNextOneOnlyIfThatIsAllowed) {
  for (const bool allowed : {false, true}) {
    NavigatorParams params = test::withoutGlass();
    params.search.next_window = allowed;
    MissionState mission;
    mission.trusted = test::targetAtOrigin(1.0);
    mission.trusted->window_id = 7;
    mission.back_offs = 6;
    Decision decision;
    decision.event = Event::kGiveUp;
    turnToNextWindow(State::kBackOff, params, mission, decision);
    EXPECT_EQ(decision.event == Event::kBackedOff, allowed);
    EXPECT_EQ(mission.given_up.size(), allowed ? 1u : 0u);
    EXPECT_EQ(mission.back_offs, allowed ? 0 : 6);
    EXPECT_EQ(wasLeftForGood(test::targetAtOrigin(2.0), mission), allowed);
  }
}

TEST(WindowChoice, OnlyATryInVainIsTurnedIntoTheNextWindow) {
  NavigatorParams params = test::withoutGlass();
  params.search.next_window = true;
  MissionState mission;
  mission.trusted = test::targetAtOrigin(1.0);
  Decision decision;
  decision.event = Event::kGiveUp;
  turnToNextWindow(State::kApproach, params, mission, decision);
  EXPECT_EQ(decision.event, Event::kGiveUp);
  decision.event = Event::kReacquired;
  turnToNextWindow(State::kBackOff, params, mission, decision);
  EXPECT_EQ(decision.event, Event::kReacquired);
}

TEST(OtherWindow, IsLeftRememberedAndNotTakenAgain) {
  MissionState mission;
  Align align{kDefaults, 0.0};
  auto situation = test::situationAt({-5.0, 0.0, 1.5}, 0.0, true);
  situation.target->T_odom_window.translation() = Eigen::Vector3d(5.0, 2.0, 1.5);
  mission.trusted = situation.target;
  mission.window_odom_m = situation.target->T_odom_window.translation();
  EXPECT_NE(align.step(situation, mission).event, Event::kOtherWindow);
  situation.target->other_window = 0.5;
  situation.target->approach_forbidden = "another window: about 0.5 times as large";
  const Decision decision = align.step(situation, mission);
  EXPECT_EQ(decision.event, Event::kOtherWindow);
  leaveOtherWindow(situation, mission);
  EXPECT_EQ(decision.wish.velocity_odom_mps.norm(), 0.0);
  EXPECT_NE(decision.reason.find("0.5 times"), std::string::npos);
  ASSERT_EQ(mission.others_odom_m.size(), 1u);
  EXPECT_TRUE(mission.others_odom_m.front().isApprox(Eigen::Vector3d(0.0, 1.0, 1.5)));
  EXPECT_FALSE(mission.trusted || mission.window_odom_m) << "nothing may be flown by it any more";

  Search search{kDefaults, false};
  for (int i = 0; i < 10; ++i)
    EXPECT_FALSE(search.step(test::situationAt({-5.0, -1.0, 1.5}, 0.1 * i, false), mission).event);
  auto again = test::situationAt({-5.0, -1.0, 1.5}, 1.0, true);
  again.target->T_odom_window.translation() = Eigen::Vector3d(5.0, 3.1, 1.5);  // the same one, from elsewhere
  for (int i = 0; i < 10; ++i) EXPECT_FALSE(search.step(again, mission).event);
  auto right = test::situationAt({-5.0, -1.0, 1.5}, 2.0, true);
  Decision found;
  for (int i = 0; i < 3; ++i) found = search.step(right, mission);
  EXPECT_EQ(found.event, Event::kWindowFound);
}

TEST(OtherWindow, OnceAroundWithoutTheRightOneTheyGetAnotherChance) {
  MissionState mission;
  mission.others_odom_m.push_back({0.0, 0.0, 1.5});
  Search search{kDefaults, false};
  double yaw = 0.0;
  for (int i = 0; i < 10; ++i) search.step(test::situationAt({-4, 0, 1.5}, 0.0, true, yaw), mission);
  EXPECT_EQ(mission.others_odom_m.size(), 1u);
  for (double turned = 0.0; turned < 2.0 * M_PI + 0.1; turned += 0.05) {
    yaw = geometry::wrapAngle(yaw + 0.05);
    search.step(test::situationAt({-4, 0, 1.5}, 0.0, false, yaw), mission);
  }
  EXPECT_TRUE(mission.others_odom_m.empty());
}

}  // namespace window_ingress::navigation::window_choice_test
