/// Closed loops with a kinematic plant: the vehicle passes and never touches anything.
#include <gtest/gtest.h>

#include <algorithm>

#include "kinematic_plant.hpp"

namespace window_ingress::navigation::navigator_flight_test {

using test::FlownMission;
using test::KinematicPlant;
using test::PlantParams;

FlownMission flown(const PlantParams& plant_params, const NavigatorParams& params = test::withoutGlass()) {
  KinematicPlant plant(plant_params);
  Navigator navigator(params);
  return test::fly(plant, navigator);
}

int count(const FlownMission& mission, State state) {
  return static_cast<int>(std::count(mission.states.begin(), mission.states.end(), state));
}

void expectPassed(const FlownMission& mission) {
  EXPECT_EQ(mission.last.state, State::kPassed)
      << toString(mission.last.state) << ": " << mission.last.reason;
  EXPECT_FALSE(mission.hit);
  EXPECT_GT(mission.end_offset.x(), 0.5);
}

TEST(NavigatorFlight, PassesFromAheadAndFromBothSides) {
  for (const double off_axis_deg : {-60.0, -30.0, 0.0, 30.0, 60.0}) {
    for (unsigned seed = 1; seed <= 3; ++seed) {
      SCOPED_TRACE(off_axis_deg);
      PlantParams params;
      params.off_axis_rad = off_axis_deg * M_PI / 180.0;
      params.seed = seed;
      const auto mission = flown(params);
      expectPassed(mission);
      EXPECT_LT(mission.duration_sec, 20.0);
      EXPECT_EQ(mission.last.report.retries, 0);
    }
  }
}

TEST(NavigatorFlight, FindsAWindowBehindIt) {
  for (const double facing : {-2.1, 2.1, 3.1}) {
    PlantParams params;
    params.facing_rad = facing;
    params.off_axis_rad = 0.4;
    expectPassed(flown(params));
  }
}

TEST(NavigatorFlight, PassesWithAnySaneVehicle) {
  for (const double lag_sec : {0.1, 0.3, 0.6, 0.9}) {
    for (const double acceleration_mps2 : {1.2, 4.0}) {
      SCOPED_TRACE(testing::Message() << lag_sec << " s, " << acceleration_mps2 << " m/s2");
      PlantParams params;
      params.lag_sec = lag_sec;
      params.acceleration_mps2 = acceleration_mps2;
      params.off_axis_rad = 0.5;
      expectPassed(flown(params));
    }
  }
}

TEST(NavigatorFlight, PassesInGustsAndDrift) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    PlantParams params;
    params.seed = seed;
    params.off_axis_rad = -0.4;
    params.gust_mps = 0.15;
    params.odom_drift_mps = 0.02;
    const auto mission = flown(params);
    EXPECT_FALSE(mission.hit);
    EXPECT_EQ(mission.last.state, State::kPassed) << mission.last.reason;
  }
}

TEST(NavigatorFlight, ResolvesAnAmbiguousWindowByHeightAlone) {
  PlantParams params;
  params.is_ambiguous = true;
  params.off_axis_rad = 0.3;
  params.height_error_m = 0.0;
  KinematicPlant plant(params);
  Navigator navigator{test::withoutGlass()};
  const double start_y = plant.offset().y(), start_x = plant.offset().x();
  bool was_trusted = false;
  const auto mission = test::fly(plant, navigator, 120.0, [&](double, const NavigatorOutput&) {
    const auto input = plant.input();
    was_trusted = was_trusted || (input.target && input.target->sign_trusted);
    if (was_trusted) return;
    EXPECT_NEAR(plant.offset().y(), start_y, 1e-6);
    EXPECT_NEAR(plant.offset().x(), start_x, 1e-6);
  });
  EXPECT_TRUE(was_trusted);
  expectPassed(mission);
}

TEST(NavigatorFlight, GivesUpOnASignThatStaysAmbiguous) {
  PlantParams params;
  params.is_ambiguous = true;
  params.height_error_m = 0.0;
  NavigatorParams navigator = test::withoutGlass();
  navigator.align.probe_amplitude_m = 0.3;  // the plant reveals its sign after 0.4 m
  const auto mission = flown(params, navigator);
  EXPECT_EQ(mission.last.state, State::kAborted);
  EXPECT_NE(mission.last.reason.find("4 height probes"), std::string::npos) << mission.last.reason;
}

TEST(NavigatorFlight, LosingTheWindowNeverTouchesTheWall) {
  for (const double lost_sec : {0.5, 2.0, 5.0}) {
    for (double from_sec = 1.0; from_sec < 8.0; from_sec += 0.5) {
      SCOPED_TRACE(testing::Message() << lost_sec << " s from " << from_sec);
      PlantParams params;
      params.off_axis_rad = 0.4;
      KinematicPlant plant(params);
      Navigator navigator{test::withoutGlass()};
      const auto mission = test::fly(plant, navigator, 120.0, [&](double t, const NavigatorOutput&) {
        plant.hides_window = t > from_sec && t < from_sec + lost_sec;
      });
      expectPassed(mission);
    }
  }
}

TEST(NavigatorFlight, LosingOdometryNeverTouchesTheWall) {
  for (const double lost_sec : {0.3, 1.0, 3.0, 100.0}) {
    for (double from_sec = 1.0; from_sec < 9.0; from_sec += 0.5) {
      SCOPED_TRACE(testing::Message() << lost_sec << " s from " << from_sec);
      PlantParams params;
      params.off_axis_rad = -0.4;
      KinematicPlant plant(params);
      Navigator navigator{test::withoutGlass()};
      const auto mission = test::fly(plant, navigator, 120.0, [&](double t, const NavigatorOutput&) {
        plant.hides_odometry = t > from_sec && t < from_sec + lost_sec;
      });
      EXPECT_FALSE(mission.hit);
      if (lost_sec < 5.0) {
        expectPassed(mission);
      }
      EXPECT_TRUE(isEnd(mission.last.state)) << toString(mission.last.state);
    }
  }
}

TEST(NavigatorFlight, AWindowLostForGoodEndsInAnAbortAwayFromTheWall) {
  PlantParams params;
  KinematicPlant plant(params);
  Navigator navigator{test::withoutGlass()};
  const auto mission = test::fly(plant, navigator, 200.0, [&](double, const NavigatorOutput& output) {
    if (output.state == State::kApproach && output.report.distance_m < 1.8) plant.hides_window = true;
  });
  EXPECT_EQ(mission.last.state, State::kAborted);
  EXPECT_FALSE(mission.hit);
  EXPECT_LT(mission.end_offset.x(), -2.0);
  EXPECT_EQ(count(mission, State::kBackOff), 1);
}

TEST(NavigatorFlight, AJumpOfTheOdometryDoesNotDisturbIt) {
  for (const double at_sec : {1.0, 2.0, 3.0, 4.0, 5.0, 5.5, 6.0}) {
    KinematicPlant plant{PlantParams()};
    Navigator navigator{test::withoutGlass()};
    bool jumped = false;
    const auto mission = test::fly(plant, navigator, 120.0, [&](double t, const NavigatorOutput&) {
      if (!jumped && t > at_sec) plant.shiftOdometry({4.0, 1.0, 0.0});
      jumped = jumped || t > at_sec;
    });
    EXPECT_TRUE(jumped);
    EXPECT_EQ(count(mission, State::kHold), 0) << at_sec;
    expectPassed(mission);
  }
}

TEST(NavigatorFlight, ASlideOfTheOdometryDoesNotDisturbIt) {
  for (const double at_sec : {1.0, 2.0, 3.0, 4.0, 5.0, 5.5}) {
    for (const double side : {-1.0, 1.0}) {
      PlantParams params;
      params.opening = {0.8, 0.8};
      KinematicPlant plant(params);
      Navigator navigator{test::withoutGlass()};
      const Eigen::Vector3d slide = plant.window().linear() * Eigen::Vector3d(0.0, side * 0.5, 0.0);
      const auto mission = test::fly(plant, navigator, 120.0, [&](double t, const NavigatorOutput&) {
        if (t > at_sec && t < at_sec + 2.0) plant.shiftOdometry(slide * KinematicPlant::kStepSec);
      });
      EXPECT_FALSE(mission.hit) << at_sec;
      expectPassed(mission);
    }
  }
}

TEST(NavigatorFlight, TurnsBackWhenPushedAsideBeforeThePlane) {
  PlantParams params;
  KinematicPlant plant(params);
  Navigator navigator{test::withoutGlass()};
  int pushes = 0;
  const auto mission = test::fly(plant, navigator, 120.0, [&](double, const NavigatorOutput& output) {
    if (pushes == 3 || output.state != State::kCommit) return;
    plant.push(plant.window().linear() * Eigen::Vector3d(0.0, 0.15, 0.0));
    ++pushes;
  });
  EXPECT_EQ(pushes, 3);
  EXPECT_GE(count(mission, State::kBackOff), 1);
  expectPassed(mission);
}

TEST(NavigatorFlight, RefusesAnOpeningThatIsTooSmall) {
  PlantParams params;
  params.opening = {0.5, 0.5};
  const auto mission = flown(params);
  EXPECT_EQ(mission.last.state, State::kAborted);
  EXPECT_EQ(mission.last.reason, "the opening is too small for the vehicle");
}

TEST(NavigatorFlight, GivesUpWhereThereIsNoWindow) {
  PlantParams params;
  KinematicPlant plant(params);
  plant.hides_window = true;
  Navigator navigator{test::withoutGlass()};
  const auto mission = test::fly(plant, navigator, 200.0);
  EXPECT_EQ(mission.last.state, State::kAborted);
  EXPECT_EQ(mission.last.reason, "window not found in 3 turns");
  EXPECT_NEAR(mission.end_offset.x(), -5.0, 1e-6);
}

TEST(NavigatorFlight, AnOdometryWithZDownIsNotClimbedAfter) {
  PlantParams params;
  KinematicPlant plant(params);
  plant.hides_window = plant.z_points_down = true;
  Navigator navigator{test::withoutGlass()};
  const auto mission = test::fly(plant, navigator, 200.0);
  EXPECT_EQ(mission.last.state, State::kAborted);
  EXPECT_NE(mission.last.reason.find("differ in axes, here z"), std::string::npos) << mission.last.reason;
  EXPECT_LT(mission.end_offset.z() - params.height_error_m, 1.0) << "climbed, in metres";
}

TEST(NavigatorFlight, PaperStepsPassTooButTakeLonger) {
  PlantParams plant;
  plant.off_axis_rad = 0.5;
  NavigatorParams stepped = test::withoutGlass();
  stepped.scheme = "stepped";
  const auto fast = flown(plant), slow = flown(plant, stepped);
  expectPassed(slow);
  EXPECT_GT(slow.duration_sec, 1.25 * fast.duration_sec);
}

}  // namespace window_ingress::navigation::navigator_flight_test
