#include "simulation/referee.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "simulation/scene/scene.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::simulation::referee_test {

// The course of a real scenario: the referee is tested with the same walls that are rendered.
class Flight : public testing::Test {
 protected:
  Flight() : scene_(buildScene(scenario_)), referee_(course()) {}

  Course course() {
    Course course;
    course.T_odom_window = T_odom_window_;
    course.opening = scenario_.opening();
    course.wall_thickness_m = scene_.opening_depth_m;
    course.vehicle_half_extents_m = scenario_.vehicle.halfExtents();
    course.obstacles = scene_.obstacles;
    course.time_limit_sec = 60.0;
    course.ground_z_m = scene_.ground_z_m;
    return course;
  }

  // Flies straight and level to a point of the window frame; `yaw_rad_` turns the nose off the normal.
  void flyTo(const Eigen::Vector3d& target, double speed_mps = 1.0) {
    const Eigen::Vector3d start = position_;
    const int steps = std::max(1, static_cast<int>(std::ceil((target - start).norm() / speed_mps / 0.0025)));
    for (int i = 1; i <= steps; ++i)
      tick(start + (target - start) * i / steps, (target - start).normalized() * speed_mps);
  }
  void stand(double duration_sec) {
    for (double t = 0.0; t < duration_sec; t += 0.0025) tick(position_, Eigen::Vector3d::Zero());
  }
  void tick(const Eigen::Vector3d& position, const Eigen::Vector3d& velocity) {
    position_ = position;
    VehicleTruth truth;
    truth.T_odom_base = T_odom_window_ * geometry::makePose(geometry::yawRotation(yaw_rad_), position);
    truth.velocity_odom_mps = T_odom_window_.linear() * velocity;
    referee_.update(time_sec_ += 0.0025, truth);
  }
  Outcome outcome(Claim claim = Claim::kNone) const { return referee_.judge(claim).outcome; }

  Scenario scenario_;
  Scene scene_;
  Eigen::Isometry3d T_odom_window_ = geometry::makePose(geometry::yawRotation(2.1), {3, -4, 1.5});
  Referee referee_;
  Eigen::Vector3d position_{-4.0, 1.0, 0.0};
  double yaw_rad_ = 0.0, time_sec_ = 0.0;
};

TEST_F(Flight, WhoComesOutAgainHasNotCrossed) {
  flyTo({-1.5, 0, 0});
  flyTo({0.5, 0.1, 0});
  ASSERT_TRUE(referee_.crossing());
  flyTo({-1.5, 0, 0});
  EXPECT_FALSE(referee_.crossing());
  EXPECT_EQ(outcome(Claim::kPassed), Outcome::kFalseIngress);
  flyTo({1.5, -0.1, 0});
  stand(1.0);
  ASSERT_TRUE(referee_.crossing());
  EXPECT_LT(referee_.crossing()->offset_y_m, 0.0) << "the second way counts";
  EXPECT_EQ(outcome(), Outcome::kPassed);
}

TEST_F(Flight, TheTimeLimitRunsFromTheStartOfTheMission) {
  stand(60.1);
  EXPECT_EQ(outcome(), Outcome::kTimeout);
  EXPECT_EQ(referee_.judge(Claim::kNone, 10.0).outcome, Outcome::kRunning);
  stand(10.0);
  EXPECT_EQ(referee_.judge(Claim::kNone, 10.0).outcome, Outcome::kTimeout);
}

TEST_F(Flight, ACleanPassWithAStopBehindIsPassed) {
  flyTo({-1.5, 0, 0});
  flyTo({1.5, 0.1, -0.05});
  EXPECT_EQ(outcome(Claim::kPassed), Outcome::kRunning) << "it has not stopped yet";
  stand(0.6);
  EXPECT_EQ(outcome(), Outcome::kPassed) << referee_.judge(Claim::kNone).reason;
  ASSERT_TRUE(referee_.crossing());
  char expected[80];
  std::snprintf(expected, sizeof expected, "crossed at %.2f s, +0.050 m",
                referee_.crossing()->time_sec - 0.5);
  EXPECT_EQ(referee_.judge(Claim::kNone, 0.5).reason.rfind(expected, 0), 0u)
      << expected << " since the mission began, as the time of the flight";
  EXPECT_TRUE(referee_.crossing()->inside);
  EXPECT_NEAR(referee_.crossing()->offset_y_m, 0.05, 1e-6);
  EXPECT_NEAR(referee_.crossing()->offset_z_m, -0.025, 1e-6);
  EXPECT_NEAR(*referee_.minClearance(), 0.6 - 0.2 - 0.05 - 0.1 * (0.24 + 0.02 + 0.2) / 3.0, 1e-3);
  EXPECT_NEAR(referee_.maxSpeed(), 1.0, 1e-9);
}

TEST_F(Flight, TheNearestGapIsThatToTheFrameAndNeverMoreThanTheTrueOne) {
  flyTo({-1.0, 0, 0});
  const double before_m = referee_.nearest();
  EXPECT_GT(before_m, 0.3);
  flyTo({1.5, 0.1, 0});
  ASSERT_TRUE(referee_.minClearance());
  EXPECT_LE(referee_.nearest(), *referee_.minClearance() + 1e-9);
  EXPECT_GT(referee_.nearest(), 0.1);
}

TEST_F(Flight, StandingWithTheTailInTheOpeningIsNoPass) {
  flyTo({-1.5, 0, 0});
  flyTo({0.3, 0, 0});
  stand(2.0);
  EXPECT_EQ(outcome(Claim::kPassed), Outcome::kRunning);
}

TEST_F(Flight, AGrazeOfTheSideIsACollisionForEver) {
  flyTo({-1.0, 0.41, 0});
  EXPECT_FALSE(referee_.touched());
  flyTo({1.0, 0.41, 0});
  EXPECT_TRUE(referee_.touched());
  flyTo({1.5, 0, 0});
  stand(1.0);
  EXPECT_EQ(outcome(Claim::kPassed), Outcome::kCollision);
  EXPECT_EQ(referee_.judge(Claim::kNone).reason.rfind("touched frame at", 0), 0u);
  EXPECT_LT(*referee_.minClearance(), 0.0);
}

TEST_F(Flight, AMillimetreOfAirOnEachSideIsEnough) {
  flyTo({-1.0, 0.399, 0});
  flyTo({1.5, 0.399, 0});
  EXPECT_FALSE(referee_.touched()) << referee_.judge(Claim::kNone).reason;
  EXPECT_NEAR(*referee_.minClearance(), 0.001, 1e-6);
}

TEST_F(Flight, AYawedBodyNeedsMoreRoom) {
  yaw_rad_ = 0.6;
  flyTo({-1.0, 0.36, 0});
  flyTo({1.0, 0.36, 0});
  EXPECT_TRUE(referee_.touched());
}

TEST_F(Flight, CrossingBesideTheOpeningIsACollisionWithTheWall) {
  flyTo({-1.5, 1.5, 0});
  flyTo({1.5, 1.5, 0});
  EXPECT_EQ(outcome(), Outcome::kCollision);
  EXPECT_EQ(referee_.judge(Claim::kNone).reason.rfind("touched wall at", 0), 0u);
  ASSERT_TRUE(referee_.crossing());
  EXPECT_FALSE(referee_.crossing()->inside);
}

TEST_F(Flight, TheGroundCountsOnceAirborne) {
  flyTo({-4.0, 0, scene_.ground_z_m + 0.06});
  EXPECT_EQ(outcome(), Outcome::kCollision);
  EXPECT_EQ(referee_.judge(Claim::kNone).reason.rfind("touched ground at", 0), 0u);
}

TEST_F(Flight, TakingOffFromTheGroundIsNoContact) {
  position_ = {-4.0, 0, scene_.ground_z_m + scenario_.vehicle.half_height_m};
  stand(1.0);
  flyTo({-4.0, 0, 0});
  EXPECT_FALSE(referee_.touched());
}

TEST_F(Flight, AClaimWithoutACrossingIsAFalseIngress) {
  flyTo({-0.5, 0, 0});
  EXPECT_EQ(outcome(Claim::kNone), Outcome::kRunning);
  EXPECT_EQ(outcome(Claim::kPassed), Outcome::kFalseIngress);
  EXPECT_EQ(outcome(Claim::kAborted), Outcome::kAborted);
  EXPECT_FALSE(referee_.judge(Claim::kPassed).reason.empty());
}

TEST(Referee, AClaimAfterAnotherWindowIsTold) {
  Referee referee(Course{});  // nothing to touch
  VehicleTruth truth;
  for (const double x_m : {-1.0, 1.0}) {
    truth.T_odom_base.translation() = Eigen::Vector3d(x_m, 1.9, 0.0);
    referee.update(x_m + 1.0, truth);
  }
  const Verdict verdict = referee.judge(Claim::kPassed);
  EXPECT_EQ(verdict.outcome, Outcome::kFalseIngress);
  EXPECT_NE(verdict.reason.find("+1.900 m left"), std::string::npos) << verdict.reason;
}

TEST_F(Flight, RunningOutOfTimeIsATimeout) {
  stand(60.1);
  EXPECT_EQ(outcome(), Outcome::kTimeout);
}

TEST_F(Flight, FurnitureBehindTheWindowIsInTheWay) {
  flyTo({-1.5, 0, 0});
  flyTo({scene_.opening_depth_m + scenario_.house.room_depth_m, 0, 0});
  EXPECT_EQ(outcome(), Outcome::kCollision);
  EXPECT_EQ(referee_.judge(Claim::kNone).reason.rfind("touched back wall at", 0), 0u);
}

TEST_F(Flight, WrongSideIsMeasuredBeyondTheStart) {
  flyTo({-3.0, 0.5, 0});
  EXPECT_DOUBLE_EQ(referee_.wrongSide(), 0.0);
  flyTo({-3.0, -0.4, 0});
  EXPECT_DOUBLE_EQ(referee_.wrongSide(), 0.0) << "an overshoot within the start's distance is none";
  flyTo({-3.0, -1.3, 0});
  EXPECT_NEAR(referee_.wrongSide(), 0.3, 0.01);
  flyTo({-3.0, 1.8, 0});
  EXPECT_NEAR(referee_.wrongSide(), 0.8, 0.01);
}

TEST(Obstacle, TurnedBoxesTouchExactlyWhenTheyShouldAlongEdges) {
  const Eigen::AlignedBox3d cube(Eigen::Vector3d(-1, -1, -1), Eigen::Vector3d(1, 1, 1));
  const Eigen::Vector3d half(1, 1, 1);
  const Eigen::Matrix3d eighth = geometry::yawRotation(M_PI / 4);
  EXPECT_TRUE(touches(geometry::makePose(eighth, {1 + std::sqrt(2.0) - 0.001, 0, 0}), half, cube));
  EXPECT_FALSE(touches(geometry::makePose(eighth, {1 + std::sqrt(2.0) + 0.001, 0, 0}), half, cube));
  EXPECT_FALSE(touches(geometry::makePose(Eigen::Matrix3d::Identity(), {0, 0, 2.001}), half, cube));
  EXPECT_TRUE(touches(geometry::makePose(eighth, {0, 0, 0}), half, cube)) << "one within the other";
}

}  // namespace window_ingress::simulation::referee_test
