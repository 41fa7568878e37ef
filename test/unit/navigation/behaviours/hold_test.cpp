#include "navigation/behaviours/hold.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "navigation_samples.hpp"

namespace window_ingress::navigation::hold_test {

const NavigatorParams kDefaults = test::withoutGlass();

TEST(HoldBehaviour, LeavesTheWallAtOnceWhereWindCouldCarryItThere) {
  MissionState mission;
  mission.trusted = test::targetAtOrigin(0.0);
  for (const double distance_m : {0.5, 2.0}) {
    Hold hold{kDefaults, State::kApproach};
    const auto decision = hold.step(test::situationAt({-distance_m, 0.1, 1.5}, 0.0, false), mission);
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
      auto situation = test::situationAt({behind_m, 0, 1.5}, now, false);
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
      auto situation = test::situationAt({-1.0, 0, 1.5}, now, false);
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
    auto situation = test::situationAt({-0.8, 0, 1.5}, now, with_target);
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
  auto long_ago = committed;
  long_ago.committed->stamp_sec -= kDefaults.commit.max_blind_sec;
  EXPECT_EQ(wayOutOf(State::kCommit, long_ago, true, true), Event::kWindowLost);
  EXPECT_EQ(wayOutOf(State::kCommit, nothing, true, true), Event::kReacquired);
  nothing.was_in_front = false;
  EXPECT_EQ(wayOutOf(State::kCommit, nothing, true, true), Event::kGiveUp);
  EXPECT_EQ(wayOutOf(State::kBackOff, nothing, true, false), Event::kGiveUp) << "may be in the opening";
  EXPECT_EQ(wayOutOf(State::kCommit, committed, false, true), Event::kGiveUp);
}

}  // namespace window_ingress::navigation::hold_test
