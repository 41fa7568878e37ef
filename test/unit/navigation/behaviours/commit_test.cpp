#include "navigation/behaviours/commit.hpp"

#include <gtest/gtest.h>

#include <optional>

#include "navigation_samples.hpp"

namespace window_ingress::navigation::commit_test {

const NavigatorParams kDefaults = test::withoutGlass();

TEST(CommitBehaviour, StaysBehindTheWindowAgainstTheWind) {
  MissionState mission;
  mission.committed = test::targetAtOrigin(0.0);
  Commit commit{kDefaults};
  auto at_exit = test::situationAt({kDefaults.commit.exit_distance_m, 0.0, 1.5}, 0.0, false);
  at_exit.wind_odom_mps = Eigen::Vector3d(-0.4, 0.3, 0.0);
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
    Situation situation = test::situationAt({-distance_m, kBesideM, 1.5}, 0.0, false);
    situation.told_odom_mps = {told_mps, 0.0, 0.0};
    Commit commit{kDefaults};
    return commit.step(situation, mission).event;
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
      auto situation = test::situationAt({-distance_m, 0.0, 1.5}, 0.05 * i, i > 0);
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
    Commit commit{kDefaults};
    auto situation = test::situationAt({-0.5, 0.0, 1.5}, 0.0, false);
    situation.vehicle->velocity_odom_mps.x() = 0.95;
    situation.wind_odom_mps.x() = wind_mps;
    return commit.step(situation, mission).wish.velocity_odom_mps.x();
  };
  EXPECT_NEAR(forwardWith(0.3), forwardWith(0.0) - 0.3, 1e-9);
  EXPECT_DOUBLE_EQ(forwardWith(-0.3), forwardWith(0.0)) << "a gust against it may end";
}

TEST(CommitBehaviour, HasPassedOnlyWhereItStopsNotWhereItIsBlownBackTo) {
  MissionState mission;
  mission.committed = test::targetAtOrigin(0.0);
  Commit commit{kDefaults};
  EXPECT_EQ(commit.step(test::situationAt({1.2, 0.0, 1.5}, 0.0, false), mission).event, Event::kCrossed);
  const auto blown_back = commit.step(test::situationAt({0.1, 0.0, 1.5}, 0.1, false), mission);
  EXPECT_FALSE(blown_back.event);
  EXPECT_GT(blown_back.wish.velocity_odom_mps.x(), 0.3);
}

}  // namespace window_ingress::navigation::commit_test
