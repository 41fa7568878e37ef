/// Whether the vehicle flies into an opening, depending on its openness.
#include "navigation/mission/opening_policy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "kinematic_plant.hpp"
#include "navigation/behaviours/behaviour.hpp"
#include "navigation/mission/window_choice.hpp"
#include "navigation_samples.hpp"

namespace window_ingress::navigation::opening_policy_test {

using openness::Openness;

NavigatorParams paramsFor(const std::string& unverified_opening, const std::string& glass = "excluded") {
  NavigatorParams params;
  params.commit.unverified_opening = unverified_opening;
  params.commit.glass = glass;
  return params;
}

enum class Answer { kEnters, kAsks, kRefuses };

Answer answerTo(Openness verdict, const CommitParams& params, const MissionState& mission = {}) {
  auto target = test::targetAtOrigin(0.0);
  target.openness.openness = verdict;
  const std::string why_not = whyNotEntered(target, mission, params);
  if (why_not.empty()) return Answer::kEnters;
  return why_not.find("confirm_opening") == std::string::npos ? Answer::kRefuses : Answer::kAsks;
}

/// The table of doc/navigation.md.
TEST(OpeningPolicy, EveryVerdictHasItsAnswer) {
  struct Row {
    const char *glass, *unverified_opening;
    Answer open, unknown;
  };
  for (const Row& row : {Row{"excluded", "ask", Answer::kEnters, Answer::kAsks},
                         {"excluded", "allow", Answer::kEnters, Answer::kEnters},
                         {"excluded", "deny", Answer::kEnters, Answer::kRefuses},
                         {"possible", "ask", Answer::kAsks, Answer::kAsks},
                         {"possible", "allow", Answer::kAsks, Answer::kAsks},
                         {"possible", "deny", Answer::kAsks, Answer::kRefuses}}) {
    const auto params = paramsFor(row.unverified_opening, row.glass).commit;
    const std::string which = std::string(row.glass) + ", " + row.unverified_opening;
    EXPECT_EQ(answerTo(Openness::kOpen, params), row.open) << which;
    EXPECT_EQ(answerTo(Openness::kUnknown, params), row.unknown) << which;
    EXPECT_EQ(answerTo(Openness::kClosed, params), Answer::kRefuses) << which;
    MissionState confirmed;
    confirmed.opening_confirmed = true;
    EXPECT_EQ(answerTo(Openness::kOpen, params, confirmed), Answer::kEnters) << which;
    EXPECT_EQ(answerTo(Openness::kUnknown, params, confirmed), Answer::kEnters) << which;
    EXPECT_EQ(answerTo(Openness::kClosed, params, confirmed), Answer::kRefuses) << which;
  }
}

TEST(OpeningPolicy, WaitsForAnAnswerWhereItAsksAndElseForWhatIsToBeSeen) {
  auto target = test::targetAtOrigin(0.0);
  const CommitParams asks = NavigatorParams().commit, denies = paramsFor("deny", "possible").commit;
  EXPECT_EQ(waitAtLineSec(target, asks), asks.ask_sec);
  EXPECT_EQ(waitAtLineSec(target, denies), denies.ask_sec);
  target.openness.openness = Openness::kUnknown;
  EXPECT_EQ(waitAtLineSec(target, asks), asks.ask_sec);
  EXPECT_EQ(waitAtLineSec(target, denies), denies.look_sec);
}

TEST(OpeningPolicy, SaysBeforeTheStartInItsStateWhatItWillAsk) {
  Navigator navigator{NavigatorParams()};
  const std::string reason = navigator.step(test::inputAt({-4, 0, 1.5}, 1.0), 1.0).reason;
  EXPECT_NE(reason.find("glass is not excluded"), std::string::npos) << reason;
  navigator.abort();
  navigator.reset();
  EXPECT_EQ(navigator.step(test::inputAt({-4, 0, 1.5}, 1.1), 1.1).reason, reason);
}

TEST(OpeningPolicy, SaysAtTheStartWhatItWillAskAndWhatItAssumes) {
  const auto said = [](const NavigatorParams& params) {
    return Navigator(params).start(test::inputAt({-4, 0, 1.5}, 1.0), 1.0).message;
  };
  const auto says = [](const std::string& message, const std::string& text) {
    return message.find(text) != std::string::npos;
  };
  const std::string asks = "will ask for ~confirm_opening at the line: glass is not excluded",
                    assumes = "assumes that there is no glass";
  EXPECT_TRUE(says(said(NavigatorParams()), asks)) << said(NavigatorParams());
  EXPECT_TRUE(says(said(paramsFor("deny", "possible")), "turns back"));
  for (const std::string policy : {"ask", "allow", "deny"}) {
    EXPECT_TRUE(says(said(paramsFor(policy, "possible")), asks)) << policy;
    EXPECT_TRUE(says(said(paramsFor(policy, "excluded")), assumes)) << policy;
    EXPECT_FALSE(says(said(paramsFor(policy, "excluded")), asks)) << policy;
  }
  EXPECT_TRUE(says(said(paramsFor("ask")), "will ask for ~confirm_opening if"));
  EXPECT_TRUE(says(said(paramsFor("allow")), "enters even if it is not seen to be open"));
}

TEST(OpeningPolicy, OfOneMissionHoldsForThisMissionAlone) {
  Navigator navigator{NavigatorParams()};
  const auto said = [&](double now_sec, const MissionPolicy& policy) {
    const std::string message =
        navigator.start(test::inputAt({-4, 0, 1.5}, now_sec), now_sec, policy).message;
    navigator.abort();
    navigator.reset();
    return message;
  };
  const std::string of_parameters = said(1.0, {});
  EXPECT_EQ(
      said(2.0, {"deny", "excluded"}),
      "started; assumes that there is no glass (commit/glass); turns back if it is not seen to be open");
  EXPECT_EQ(said(3.0, {}), of_parameters);
  EXPECT_EQ(said(4.0, {"ask", "possible"}), of_parameters);
}

TEST(OpeningPolicy, IsPartOfTheContractAfterItsGeometry) {
  const auto params = paramsFor("ask");
  auto target = test::targetAtOrigin(0.0);
  target.openness.openness = Openness::kUnknown;
  const CommitCriterion on_axis =
      criterionWith(target, test::situationAt({-1.5, 0, 1.5}, 0.0, false), {}, params);
  EXPECT_TRUE(on_axis.opening_unverified);
  EXPECT_FALSE(on_axis.holds);
  EXPECT_NE(on_axis.unmet.find("is it open?"), std::string::npos);
  const CommitCriterion aside =
      criterionWith(target, test::situationAt({-1.5, 0.4, 1.5}, 0.0, false), {}, params);
  EXPECT_NE(aside.unmet.find("lateral offset"), std::string::npos);
}

TEST(OpeningPolicy, ClosedOnesAreLeftForTheWholeMissionButNotTheirNeighbours) {
  MissionState mission;
  Situation situation;
  situation.vehicle = test::vehicleAt({-4, 0, 1.5}, 0.0);
  situation.target = test::targetAtOrigin(0.0);
  EXPECT_EQ(whyOtherWindow(*situation.target), "");
  mission.trusted = situation.target;
  mission.opening_confirmed = true;
  situation.target->openness.openness = Openness::kClosed;
  EXPECT_NE(whyOtherWindow(*situation.target), "");
  leaveOtherWindow(situation, mission);
  EXPECT_FALSE(mission.trusted || mission.opening_confirmed);
  mission.forgetWindow();  // after a full turn
  EXPECT_TRUE(isKnownOther(*situation.target, *situation.vehicle, mission));
  situation.target->T_odom_window.translation().y() += 1.0;
  EXPECT_FALSE(isKnownOther(*situation.target, *situation.vehicle, mission));
  mission.forgetPlaces();
  EXPECT_TRUE(mission.left_odom_m.empty()) << "places of an odometry that jumped";
}

TEST(OpeningPolicy, LooksToBothSidesWithinTheClearance) {
  CommitCriterion criterion;
  criterion.clearance_m.x() = 0.3;
  CommitParams params;
  EXPECT_GT(lookAside(0.5, criterion, params), 0.0);
  EXPECT_NEAR(lookAside(3.0, criterion, params), -lookAside(0.5, criterion, params), 1e-9);
  for (const double clearance_m : {-0.1, 0.0, 0.05, 0.3, 2.0}) {
    criterion.clearance_m.x() = clearance_m;
    EXPECT_LE(std::abs(lookAside(1.0, criterion, params)), std::max(0.0, clearance_m));
    EXPECT_LE(std::abs(lookAside(1.0, criterion, params)), params.look_aside_m);
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
  EXPECT_FALSE(navigator.confirmOpening().success) << "no window is being approached yet";
  double asked_sec = 0.0;
  const Flight flight = flown(plant, navigator, [&](const NavigatorOutput& output) {
    if (output.reason.find("confirm_opening") == std::string::npos) {
      if (asked_sec == 0.0) {
        EXPECT_FALSE(navigator.confirmOpening().success) << "nobody has asked: " << output.reason;
      }
      return;
    }
    EXPECT_LT(-plant.offset().x(), 2.5) << "near enough to see a pane";
    asked_sec += test::KinematicPlant::kStepSec;
    EXPECT_LT(plant.offset().x(), -0.6);
    if (asked_sec > 10.0) {
      EXPECT_TRUE(navigator.confirmOpening().success);
      EXPECT_TRUE(navigator.confirmOpening().success) << "said again";
    }
  });
  EXPECT_GT(asked_sec, 10.0);
  EXPECT_EQ(flight.mission.last.state, State::kPassed) << flight.mission.last.reason;
}

TEST(OpeningPolicy, StandsStillWhileItAsksAboutOneThatIsSeenToBeOpen) {
  const Flight flight = [] {
    test::KinematicPlant plant{test::PlantParams()};
    Navigator navigator{NavigatorParams()};
    return flown(plant, navigator);
  }();
  EXPECT_EQ(flight.mission.last.state, State::kAborted) << flight.mission.last.reason;
  EXPECT_LT(flight.furthest_in_m, -0.6);
  EXPECT_LT(std::max(flight.left_m, -flight.right_m), 0.1);
}

TEST(OpeningPolicy, WaitsForTheAnswerAsLongAsItSays) {
  NavigatorParams params;
  params.timeouts.approach_sec = 12.0;
  params.timeouts.total_sec = 40.0;
  params.commit.ask_sec = 15.0;
  test::KinematicPlant plant{test::PlantParams()};
  Navigator navigator{params};
  double asked_sec = 0.0;
  bool backed_off = false;
  flown(plant, navigator, [&](const NavigatorOutput& output) {
    const bool asks = output.reason.find("confirm_opening") != std::string::npos;
    backed_off |= output.state == State::kBackOff;
    if (asks && !backed_off) asked_sec += test::KinematicPlant::kStepSec;
  });
  EXPECT_TRUE(backed_off) << "not aborted in front of the wall";
  EXPECT_GT(asked_sec, params.commit.ask_sec - 1.0);
}

/// The verdict changes at random and is OPEN half of the time.
struct FickleVerdict {
  std::mt19937 random;
  double mean_sec = 1.0;
  Openness next(Openness now) {
    std::uniform_real_distribution<double> uniform;
    if (uniform(random) > test::KinematicPlant::kStepSec / mean_sec) return now;
    const double which = uniform(random);
    return which < 0.6 ? Openness::kOpen : which < 0.98 ? Openness::kUnknown : Openness::kClosed;
  }
};

struct Fickle {
  int flights = 0, committed = 0, asked = 0;
};

/// Flights with random sequences of verdicts, with or without the operator's confirmation.
Fickle flyFickle(const NavigatorParams& params, bool confirms) {
  Fickle result;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    FickleVerdict verdict{std::mt19937(seed), seed % 4 == 0 ? 30.0 : 0.1 * seed};
    test::PlantParams plant_params;
    plant_params.seed = seed;
    plant_params.off_axis_rad = 0.015 * seed;
    plant_params.openness = seed % 4 == 0 ? Openness::kOpen : Openness::kUnknown;
    test::KinematicPlant plant(plant_params);
    Navigator navigator(params);
    bool committed = false, asked = false;
    flown(plant, navigator, [&](const NavigatorOutput& output) {
      plant.openness = verdict.next(plant.openness);
      committed |= output.state == State::kCommit;
      asked |= output.reason.find("~confirm_opening") != std::string::npos;
      if (confirms && asked) navigator.confirmOpening();
    });
    ++result.flights, result.committed += committed, result.asked += asked;
  }
  return result;
}

TEST(OpeningPolicy, NoSequenceOfVerdictsLeadsIntoWhatMayBeGlazedUnlessConfirmed) {
  EXPECT_EQ(NavigatorParams().commit.glass, "possible");
  EXPECT_EQ(NavigatorParams().commit.unverified_opening, "ask");
  for (const std::string policy : {"ask", "allow", "deny"}) {
    const Fickle silent = flyFickle(paramsFor(policy, "possible"), false);
    EXPECT_EQ(silent.committed, 0) << policy;
    EXPECT_GT(silent.asked, 0.4 * silent.flights) << policy << ": otherwise nobody came so far";
  }
  EXPECT_GT(flyFickle(NavigatorParams(), true).committed, 15);
  EXPECT_GT(flyFickle(test::withoutGlass(), false).committed, 15);
}

TEST(OpeningPolicy, TurnsBackFromOneThatTurnsOutToBeClosedOnTheWayIn) {
  test::KinematicPlant plant{test::PlantParams()};
  NavigatorParams params = paramsFor("allow");
  params.commit.view_margin_m = 0.8;  // visible in some more images
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

}  // namespace window_ingress::navigation::opening_policy_test
