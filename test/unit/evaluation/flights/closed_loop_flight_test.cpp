#include "evaluation/flights/closed_loop_flight.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "evaluation/flights/flight_results.hpp"
#include "refusal.hpp"
#include "simulation/scenario/scenario.hpp"

namespace window_ingress::evaluation::closed_loop_flight_test {

using navigation::State;
using simulation::Outcome;

simulation::Scenario shortFlight() {
  simulation::Scenario scenario;
  scenario.start.distance_m = 2.5;
  scenario.start.off_axis_rad = 0.2;
  scenario.time_limit_sec = 20.0;
  scenario.glass = "excluded";
  scenario.unverified_opening = "allow";
  return scenario;
}

std::string csvOf(const FlightLog& log) {
  std::ostringstream text;
  writeCsv(log, text);
  return text.str();
}

TEST(ClosedLoopFlight, PassesAWindowRightAheadAndSaysHow) {
  FlightLog log;
  const auto flight = flyOnce(shortFlight(), 1, FlightParams(), {&log});
  ASSERT_EQ(flight.outcome, Outcome::kPassed) << flight.reason;
  EXPECT_LT(flight.time_sec, 10.0);
  ASSERT_TRUE(flight.offset_y_m && flight.offset_z_m && flight.predicted_miss_m && flight.min_clearance_m);
  EXPECT_LT(std::max(std::abs(*flight.offset_y_m), std::abs(*flight.offset_z_m)), *flight.predicted_miss_m);
  EXPECT_GT(*flight.min_clearance_m, 0.1);
  EXPECT_GT(flight.blind_sec, 0.0);
  EXPECT_EQ(log.records.back().state, State::kPassed);
  const auto is_committed = [](const FlightRecord& record) { return record.state == State::kCommit; };
  EXPECT_TRUE(std::any_of(log.records.begin(), log.records.end(), is_committed));
}

// Without images the target is the only window that is seen.
TEST(ClosedLoopFlight, WithoutImagesNobodyWaitsForATargetToBeChosen) {
  auto scenario = shortFlight();
  scenario.target_chosen = true;
  FlightParams params;
  params.without_images = true;
  const auto flight = flyOnce(scenario, 1, params);
  EXPECT_EQ(flight.outcome, Outcome::kPassed) << flight.reason;
}

// ArduCopter stamps its odometry 0.08 s late, and its heading is off relative to the axes of its positions.
simulation::Scenario ofArduCopter(const std::string& profile, double off_axis_rad, double heading_rad) {
  auto scenario = shortFlight();
  scenario.start.distance_m = 5.0;
  scenario.start.off_axis_rad = off_axis_rad;
  scenario.start.heading_rad = heading_rad;
  scenario.time_limit_sec = 60.0;
  simulation::applyProfile(profile, scenario.vehicle, scenario.odometry);
  return scenario;
}

TEST(ClosedLoopFlight, AStartThatIsRefusedSaysWhy) {
  simulation::Scenario scenario = shortFlight();
  scenario.time_limit_sec = 2.0;
  FlightParams params;
  params.without_images = true;
  params.ingress_navigator.navigator.limits.max_height_m = 0.8;
  const FlightResult flight = flyOnce(scenario, 1, params);
  EXPECT_EQ(flight.outcome, Outcome::kTimeout);
  EXPECT_TRUE(test::says(flight.reason, "not started: ")) << flight.reason;
  EXPECT_TRUE(test::says(flight.reason, "above limits/max_height_m")) << flight.reason;
}

TEST(ClosedLoopFlight, AFenceBeforeTheWindowIsNamed) {
  FlightParams params;
  params.without_images = true;
  params.ingress_navigator.navigator.limits.fence_radius_m = 1.0;
  const FlightResult flight = flyOnce(shortFlight(), 1, params);
  EXPECT_NE(flight.outcome, Outcome::kPassed);
  EXPECT_TRUE(test::says(flight.reason, "fence_radius_m")) << flight.reason;
}

TEST(ClosedLoopFlight, ACameraTurnedByTenDegreesIsFoundBesideAHeadingThatIsOff) {
  auto scenario = ofArduCopter("arducopter_4_0_default", -0.4, -1.0);
  scenario.camera.told_yaw_error_rad = 10.0 * M_PI / 180.0;
  FlightParams params;
  params.without_images = true;
  for (const std::uint32_t seed : {1u, 2u, 6u, 8u, 10u}) {
    const auto flight = flyOnce(scenario, seed, params);
    EXPECT_EQ(flight.outcome, Outcome::kAborted) << seed << ": " << flight.reason;
    EXPECT_NE(flight.reason.find("camera mounting"), std::string::npos) << seed << ": " << flight.reason;
  }
}

TEST(ClosedLoopFlight, OdometryStampedLateIsNoTurnedCamera) {
  FlightParams params;
  params.without_images = true;
  for (const std::uint32_t seed : {3u, 4u, 7u, 8u, 12u}) {
    const auto flight = flyOnce(ofArduCopter("arducopter_4_0", -0.1, 2.0), seed, params);
    EXPECT_EQ(flight.outcome, Outcome::kPassed) << seed << ": " << flight.reason;
  }
}

TEST(ClosedLoopFlight, LatenessOfOdometryDoesNotPassForAnErrorOfTheHeading) {
  FlightParams params;
  params.without_images = true;
  for (const std::uint32_t seed : {3u, 4u, 8u, 12u}) {
    FlightLog log;
    flyOnce(ofArduCopter("arducopter_4_0", -0.4, -1.0), seed, params, {&log});
    const auto committed =
        std::find_if(log.records.begin(), log.records.end(),
                     [](const FlightRecord& record) { return record.state == State::kCommit; });
    ASSERT_NE(committed, log.records.end()) << seed;
    EXPECT_LT(std::abs(committed->target_yaw_error_rad), 2.0 * committed->target_yaw_sigma_rad) << seed;
  }
}

TEST(ClosedLoopFlight, WhereItIsDeniedNobodyEntersWhatWasNotSeenToBeOpen) {
  auto scenario = shortFlight();
  scenario.unverified_opening = "deny";
  scenario.time_limit_sec = 12.0;
  FlightParams params;
  params.window_detector.interior.enabled = false;
  const auto flight = flyOnce(scenario, 1, params);
  EXPECT_EQ(flight.outcome, Outcome::kTimeout) << flight.reason;
  EXPECT_FALSE(flight.offset_y_m);
}

TEST(ClosedLoopFlight, UnderTheDefaultsNobodyEntersACleanPaneThatLooksOpen) {
  auto scenario = shortFlight();
  scenario.glass = scenario.unverified_opening = "as_set";
  scenario.window.closed_by = "glass";
  scenario.house.furniture = "full";
  const auto flight = flyOnce(scenario, 1, FlightParams());
  EXPECT_EQ(flight.outcome, Outcome::kTimeout) << flight.reason;
  EXPECT_NE(flight.reason.find("~confirm_opening"), std::string::npos) << flight.reason;
  scenario.glass = "excluded";  // the operator is wrong; the verdict OPEN lets the vehicle in
  const auto wrong = flyOnce(scenario, 1, FlightParams());
  EXPECT_EQ(wrong.outcome, Outcome::kCollision) << wrong.reason;
  EXPECT_NE(wrong.reason.find("touched glass"), std::string::npos) << wrong.reason;
}

/// Estimated lateness of the image stamps relative to those of odometry, which are this much ahead.
std::optional<double> lateSecFound(double odometry_ahead_sec) {
  auto scenario = shortFlight();
  scenario.start.heading_rad = 1.2;  // it has to turn towards the window
  scenario.start.distance_m = 4.0;
  scenario.odometry.stamp_offset_sec = odometry_ahead_sec;
  FlightParams params;
  params.without_images = true;
  const auto flight = flyOnce(scenario, 3, params);
  return flight.clock_offset ? std::optional(flight.clock_offset->late_sec) : std::nullopt;
}

TEST(ClosedLoopFlight, FindsOutByHowMuchTheClocksOfCameraAndOdometryDiffer) {
  for (const double behind_sec : {0.0, 0.04, 0.08}) {
    const auto late_sec = lateSecFound(-behind_sec);
    ASSERT_TRUE(late_sec) << behind_sec;
    EXPECT_NEAR(*late_sec, behind_sec, 0.04);
  }
}

TEST(ClosedLoopFlight, StampsOfOdometryThatAreAheadOfTheirArrivalAreTakenBack) {
  for (const double ahead_sec : {0.08, 0.15}) {
    const auto late_sec = lateSecFound(ahead_sec);
    ASSERT_TRUE(late_sec) << ahead_sec;
    EXPECT_NEAR(*late_sec, 0.0, 0.04);
  }
}

/// A flight without images in which the guard dies at full speed, for this long.
FlightResult withDeadGuard(double duration_sec) {
  auto scenario = shortFlight();
  simulation::FaultParams dead;
  dead.unit = "guard";
  dead.at_sec = 3.0;
  dead.duration_sec = duration_sec;
  scenario.faults = {dead};
  scenario.vehicle.command_timeout_sec = 3.2;
  FlightParams params;
  params.without_images = true;
  return flyOnce(scenario, 3, params);
}

TEST(ClosedLoopFlight, ZerosPastADeadGuardStopTheVehicleUntilItIsBack) {
  EXPECT_EQ(withDeadGuard(1.0).outcome, Outcome::kPassed);
  const auto flight = withDeadGuard(100.0);
  EXPECT_EQ(flight.outcome, Outcome::kAborted);
  EXPECT_NE(flight.reason.find("the guard is silent"), std::string::npos) << flight.reason;
  EXPECT_LT(flight.max_speed_mps, 1.3);
}

TEST(ClosedLoopFlight, SaysWhatForbadeTheApproach) {
  auto scenario = shortFlight();
  FlightParams params;
  params.without_images = true;
  EXPECT_EQ(flyOnce(scenario, 3, params).forbidden, "");
  scenario.camera.told_yaw_error_rad = 0.3;
  const auto flight = flyOnce(scenario, 3, params);
  EXPECT_NE(flight.forbidden.find("yaw"), std::string::npos) << flight.forbidden;
}

TEST(ClosedLoopFlight, LogHoldsWhatEachImageSaidAndThePredictedMiss) {
  FlightLog log;
  const auto flight = flyOnce(shortFlight(), 1, FlightParams(), {&log});
  EXPECT_FALSE(log.records.front().image);
  ASSERT_TRUE(flight.predicted_miss_m);
  EXPECT_EQ(log.records.back().predicted_miss_m, *flight.predicted_miss_m);
  int images = 0;
  for (const auto& record : log.records) {
    if (!record.image || record.position_m.x() > -1.5) continue;
    EXPECT_LT(record.image->time_sec, record.time_sec + 1e-6);
    EXPECT_NEAR(record.image->yaw_rad, -record.heading_rad, 0.1);
    EXPECT_NEAR(record.image->left_side_px / record.image->right_side_px, 1.0, 0.5);
    EXPECT_GT(record.image->opening_width_m, 0.8);
    ++images;
  }
  EXPECT_GT(images, 20);
  std::istringstream text(csvOf(log));
  std::string line;
  std::getline(text, line);
  const auto fields = std::count(line.begin(), line.end(), ',');
  while (std::getline(text, line)) EXPECT_EQ(std::count(line.begin(), line.end(), ','), fields) << line;
}

TEST(ClosedLoopFlight, RepeatsToTheBit) {
  auto scenario = shortFlight();
  scenario.time_limit_sec = 1.0;
  scenario.camera.width_px = 320;
  scenario.camera.height_px = 240;
  FlightLog first, second, other;
  const auto a = flyOnce(scenario, 5, FlightParams(), {&first});
  const auto b = flyOnce(scenario, 5, FlightParams(), {&second});
  flyOnce(scenario, 6, FlightParams(), {&other});
  EXPECT_EQ(csvRow(a), csvRow(b));
  EXPECT_EQ(csvOf(first), csvOf(second));
  EXPECT_NE(csvOf(first), csvOf(other));
  EXPECT_EQ(a.outcome, Outcome::kTimeout);
}

TEST(ClosedLoopFlight, RefusesAVehicleThatIsFlownElsewhere) {
  auto scenario = shortFlight();
  scenario.vehicle.profile = "external";
  EXPECT_THROW(flyOnce(scenario, 1, FlightParams()), InputError);
}

TEST(ClosedLoopFlight, RefusesBadParameters) {
  FlightParams params;
  params.ingress_navigator.navigator.limits.speed_mps = -1.0;
  EXPECT_THROW(flyOnce(shortFlight(), 1, params), std::invalid_argument);
}

}  // namespace window_ingress::evaluation::closed_loop_flight_test
