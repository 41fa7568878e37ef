/// Whether an opening is flown into, as to whether it is one.
#include "window_ingress/navigation/opening_policy.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "kinematic_plant.hpp"
#include "navigation_samples.hpp"

namespace window_ingress::navigation {
namespace {

using openness::Openness;

NavigatorParams paramsFor(const std::string& unverified_opening) {
  NavigatorParams params;
  params.commit.unverified_opening = unverified_opening;
  return params;
}

TEST(OpeningPolicy, OpenIsEnteredClosedNeverAndTheRestAsAllowed) {
  for (const std::string policy : {"allow", "ask", "deny"}) {
    const auto params = paramsFor(policy).commit;
    MissionMemory memory;
    auto target = test::targetAtOrigin(0.0);
    EXPECT_EQ(whyNotEntered(target, memory, params), "") << policy;
    target.openness.openness = Openness::kUnknown;
    EXPECT_EQ(whyNotEntered(target, memory, params).empty(), policy == "allow");
    EXPECT_EQ(whyNotEntered(target, memory, params).find("confirm_opening") != std::string::npos,
              policy == "ask");
    memory.opening_confirmed = true;
    EXPECT_EQ(whyNotEntered(target, memory, params), "") << policy;
    target.openness.openness = Openness::kClosed;
    EXPECT_NE(whyNotEntered(target, memory, params).find("closed"), std::string::npos) << policy;
  }
}

TEST(OpeningPolicy, IsPartOfTheContractAfterItsGeometry) {
  const auto params = paramsFor("ask");
  auto target = test::targetAtOrigin(0.0);
  target.openness.openness = Openness::kUnknown;
  const Contract on_axis = contractWith(target, test::vehicleAt({-1.5, 0, 1.5}, 0.0), {}, params);
  EXPECT_TRUE(on_axis.opening_unverified);
  EXPECT_FALSE(on_axis.holds);
  EXPECT_NE(on_axis.unmet.find("is it open?"), std::string::npos);
  const Contract aside = contractWith(target, test::vehicleAt({-1.5, 0.4, 1.5}, 0.0), {}, params);
  EXPECT_NE(aside.unmet.find("lateral offset"), std::string::npos);
}

TEST(OpeningPolicy, ClosedOnesAreLeftForTheWholeMissionButNotTheirNeighbours) {
  MissionMemory memory;
  Situation situation;
  situation.vehicle = test::vehicleAt({-4, 0, 1.5}, 0.0);
  situation.target = test::targetAtOrigin(0.0);
  EXPECT_FALSE(leaveClosedOpening(situation, memory));
  memory.trusted = situation.target;
  memory.opening_confirmed = true;
  situation.target->openness.openness = Openness::kClosed;
  const auto decision = leaveOtherWindow(situation, memory);
  ASSERT_TRUE(decision);
  EXPECT_EQ(decision->event, Event::kOtherWindow);
  EXPECT_FALSE(memory.trusted || memory.opening_confirmed);
  memory.forgetWindow();  // after a full turn
  EXPECT_TRUE(isKnownOther(*situation.target, *situation.vehicle, memory));
  situation.target->T_odom_window.translation().y() += 1.0;
  EXPECT_FALSE(isKnownOther(*situation.target, *situation.vehicle, memory));
  memory.forgetPlaces();
  EXPECT_TRUE(memory.left_odom_m.empty()) << "places of an odometry that jumped";
}

TEST(OpeningPolicy, LooksToBothSidesWithinTheClearance) {
  Contract contract;
  contract.clearance_lateral_m = 0.3;
  CommitParams params;
  EXPECT_GT(lookAside(0.5, contract, params), 0.0);
  EXPECT_EQ(lookAside(2.5, contract, params), -lookAside(0.5, contract, params));
  for (const double clearance_m : {-0.1, 0.0, 0.05, 0.3, 2.0}) {
    contract.clearance_lateral_m = clearance_m;
    EXPECT_LE(std::abs(lookAside(1.0, contract, params)), std::max(0.0, clearance_m));
    EXPECT_LE(std::abs(lookAside(1.0, contract, params)), params.look_aside_m);
  }
}

struct Flight {
  test::FlownMission mission;
  double furthest_in_m = -10.0;  ///< of the body's centre, into the opening
  double left_m = 0.0, right_m = 0.0;
};

Flight flown(test::KinematicPlant& plant, Navigator& navigator,
             const std::function<void(const NavigatorOutput&)>& disturb = {}) {
  Flight flight;
  flight.mission = test::fly(plant, navigator, 200.0, [&](double, const NavigatorOutput& output) {
    flight.furthest_in_m = std::max(flight.furthest_in_m, plant.offset().x());
    if (plant.offset().x() > -1.6) {
      flight.left_m = std::max(flight.left_m, plant.offset().y());
      flight.right_m = std::min(flight.right_m, plant.offset().y());
    }
    if (disturb) disturb(output);
  });
  return flight;
}

Flight flown(Openness openness, const std::string& policy) {
  test::PlantParams params;
  params.openness = openness;
  params.off_axis_rad = 0.3;
  test::KinematicPlant plant(params);
  Navigator navigator(paramsFor(policy));
  return flown(plant, navigator);
}

TEST(OpeningPolicy, ClosedOnesAreNeverEnteredWhateverIsAllowed) {
  for (const std::string policy : {"allow", "ask", "deny"}) {
    const Flight flight = flown(Openness::kClosed, policy);
    EXPECT_EQ(flight.mission.last.state, State::kAborted);
    EXPECT_NE(flight.mission.last.reason.find("closed"), std::string::npos) << flight.mission.last.reason;
    EXPECT_LT(flight.furthest_in_m, -2.0) << "nobody goes near it";
    EXPECT_FALSE(flight.mission.hit);
  }
}

TEST(OpeningPolicy, UnknownOnesAreEnteredOnlyWhereThatIsAllowed) {
  const Flight allowed = flown(Openness::kUnknown, "allow");
  EXPECT_EQ(allowed.mission.last.state, State::kPassed) << allowed.mission.last.reason;
  for (const std::string policy : {"ask", "deny"}) {
    const Flight flight = flown(Openness::kUnknown, policy);
    EXPECT_EQ(flight.mission.last.state, State::kAborted) << flight.mission.last.reason;
    EXPECT_LT(flight.furthest_in_m, -0.6) << policy;
    EXPECT_FALSE(flight.mission.hit);
  }
}

TEST(OpeningPolicy, LooksFromBothSidesWhileItDoesNotKnow) {
  const Flight flight = flown(Openness::kUnknown, "deny");
  EXPECT_GT(flight.left_m, 0.1);
  EXPECT_LT(flight.right_m, -0.1);
}

TEST(OpeningPolicy, GoesInAsSoonAsItIsSeenToBeOpen) {
  test::PlantParams params;
  params.openness = Openness::kUnknown;
  test::KinematicPlant plant(params);
  Navigator navigator(paramsFor("deny"));
  const Flight flight = flown(plant, navigator, [&](const NavigatorOutput&) {
    if (plant.offset().x() > -1.4 && plant.offset().y() < -0.1) plant.openness = Openness::kOpen;
  });
  EXPECT_EQ(flight.mission.last.state, State::kPassed) << flight.mission.last.reason;
  EXPECT_FALSE(flight.mission.hit);
}

TEST(OpeningPolicy, WaitsForTheOperatorAndGoesInWhenHeSaysSo) {
  test::PlantParams params;
  params.openness = Openness::kUnknown;
  test::KinematicPlant plant(params);
  Navigator navigator(paramsFor("ask"));
  EXPECT_FALSE(navigator.confirmOpening().success) << "no window is flown at yet";
  double asked_sec = 0.0;
  const Flight flight = flown(plant, navigator, [&](const NavigatorOutput& output) {
    if (output.reason.find("confirm_opening") == std::string::npos) return;
    asked_sec += test::KinematicPlant::kStepSec;
    EXPECT_LT(plant.offset().x(), -0.6);
    if (asked_sec > 10.0) {
      EXPECT_TRUE(navigator.confirmOpening().success);
    }
  });
  EXPECT_GT(asked_sec, 10.0);
  EXPECT_EQ(flight.mission.last.state, State::kPassed) << flight.mission.last.reason;
}

TEST(OpeningPolicy, TurnsBackFromOneThatTurnsOutToBeClosedOnTheWayIn) {
  test::KinematicPlant plant{test::PlantParams()};
  NavigatorParams params = paramsFor("allow");
  params.commit.view_margin_m = 0.8;  // it is seen for some more pictures
  Navigator navigator(params);
  bool committed = false;
  const Flight flight = flown(plant, navigator, [&](const NavigatorOutput& output) {
    committed |= output.state == State::kCommit;
    if (output.state == State::kCommit) plant.openness = Openness::kClosed;
  });
  EXPECT_TRUE(committed);
  EXPECT_EQ(flight.mission.last.state, State::kAborted) << flight.mission.last.reason;
  EXPECT_LT(flight.furthest_in_m, -0.25);
  EXPECT_FALSE(flight.mission.hit);
}

}  // namespace
}  // namespace window_ingress::navigation
