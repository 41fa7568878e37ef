#include "navigation/behaviours/approach.hpp"

#include <gtest/gtest.h>

#include <string>

#include "navigation_samples.hpp"

namespace window_ingress::navigation::approach_test {

const NavigatorParams kDefaults = test::withoutGlass();

TEST(ApproachBehaviour, TurnsBackToAligningWhenTheApproachIsForbidden) {
  Approach approach{kDefaults};
  MissionState mission;
  auto situation = test::situationAt({-3.0, 0.0, 0.0}, 1.0, true);
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
    Situation situation = test::situationAt({-0.8, 0, 1.5}, now_sec, true);
    situation.target->unverified = "camera mounting: a turn of 9 deg cannot be excluded yet";
    decision = approach.step(situation, mission);
    EXPECT_EQ(decision.reason, situation.target->unverified);
  }
  EXPECT_EQ(decision.event, Event::kCriterionUnmet);
  EXPECT_NEAR(now_sec - 10.0, kDefaults.approach.patience_sec, 0.1);
  EXPECT_NE(mission.unmet.find("camera mounting"), std::string::npos) << "what is said where it gives up";
}

// While it waits, the line moves by decimetres with the vehicle's attitude; an answer must count all the
// same.
TEST(ApproachBehaviour, WhatItHasAskedAtTheLineStaysAsked) {
  const NavigatorParams asks;
  Approach approach{asks};
  MissionState mission;
  const auto saidAt = [&](double distance_m, double now_sec) {
    return approach.step(test::situationAt({-distance_m, 0.0, 1.5}, now_sec, true), mission).reason;
  };
  EXPECT_NE(saidAt(3.0, 1.0).find("will ask at the commit line"), std::string::npos);
  EXPECT_FALSE(mission.opening_asked);
  EXPECT_NE(saidAt(0.8, 2.0).find("call ~confirm_opening"), std::string::npos);
  EXPECT_TRUE(mission.opening_asked);
  EXPECT_NE(saidAt(3.0, 3.0).find("call ~confirm_opening"), std::string::npos);
  EXPECT_TRUE(mission.opening_asked);
  mission.leaveWindow();
  EXPECT_NE(saidAt(3.0, 4.0).find("will ask at the commit line"), std::string::npos) << "another window";
}

TEST(ApproachBehaviour, GoesBackToTheLineThatItWasBlownAcross) {
  Approach approach{kDefaults};
  MissionState mission;
  const Decision beside = approach.step(test::situationAt({-0.8, 0.5, 1.5}, 1.0, true), mission);
  EXPECT_LT(beside.wish.velocity_odom_mps.x(), -0.3);
  const Decision before_it = approach.step(test::situationAt({-0.8, 0.0, 1.5}, 1.0, true), mission);
  EXPECT_EQ(before_it.event, Event::kCommitReached);
}

}  // namespace window_ingress::navigation::approach_test
