#include "window_ingress/simulation/world.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::simulation {
namespace {

Scenario quietScenario() {
  Scenario scenario;
  scenario.camera.width_px = 160;
  scenario.camera.height_px = 120;
  return scenario;
}

struct Recording {
  std::vector<cv::Mat> images;
  std::vector<double> numbers;
};

Recording record(std::uint32_t seed, double duration_sec) {
  World world(quietScenario(), seed);
  Recording recording;
  while (world.timeSec() < duration_sec) {
    world.command({Eigen::Vector3d(0.5, 0.1, 0.0), 0.2});
    world.advance();
    if (const auto frame = world.takeFrame()) recording.images.push_back(frame->image.clone());
    if (const auto odometry = world.takeOdometry())
      for (int i = 0; i < 3; ++i) recording.numbers.push_back(odometry->T_odom_base.translation()[i]);
    if (const auto imu = world.takeImu()) recording.numbers.push_back(imu->R_odom_base.x());
  }
  return recording;
}

bool sameBytes(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0.0;
}

TEST(World, SameSeedGivesTheSameBytesAndAnotherDoesNot) {
  const Recording first = record(5, 0.5), again = record(5, 0.5), other = record(6, 0.5);
  ASSERT_GE(first.images.size(), 13u);
  ASSERT_EQ(first.images.size(), again.images.size());
  for (std::size_t i = 0; i < first.images.size(); ++i)
    EXPECT_TRUE(sameBytes(first.images[i], again.images[i])) << i;
  EXPECT_EQ(first.numbers, again.numbers);
  EXPECT_NE(first.numbers, other.numbers);
  EXPECT_FALSE(sameBytes(first.images.back(), other.images.back()));
}

TEST(World, DeliversAtItsRatesWithStampsOfTheMeasurement) {
  Scenario scenario = quietScenario();
  scenario.camera.latency_sec = 0.05;
  World world(scenario, 1);
  int frames = 0, odometry = 0, imu = 0;
  while (world.timeSec() < 1.9999) {
    world.advance();
    if (const auto frame = world.takeFrame()) {
      ++frames;
      EXPECT_NEAR(world.timeSec() - frame->stamp_sec, 0.05, World::kStepSec);
    }
    odometry += world.takeOdometry().has_value();
    imu += world.takeImu().has_value();
  }
  EXPECT_NEAR(frames, 30 * 1.95, 1);
  EXPECT_NEAR(odometry, 50 * 1.97, 1);
  EXPECT_NEAR(imu, 200, 1);
}

TEST(World, FliesAsCommandedAndTellsTheTruthAboutIt) {
  World world(quietScenario(), 1);
  const Eigen::Isometry3d start = world.truth().T_odom_base;
  EXPECT_NEAR((world.T_odom_window().inverse() * start).translation().x(), -5.0, 1e-9);
  while (world.timeSec() < 2.0) {
    world.command({Eigen::Vector3d(1.0, 0.0, 0.0), 0.0});
    world.advance();
  }
  EXPECT_NEAR((start.inverse() * world.truth().T_odom_base).translation().x(), 1.6, 0.2);
  EXPECT_EQ(world.referee().judge(Claim::kNone).outcome, Outcome::kRunning);
}

TEST(World, AFlightStraightAtTheWindowPasses) {
  World world(quietScenario(), 2);
  while (world.timeSec() < 20.0 && world.referee().judge(Claim::kNone).outcome == Outcome::kRunning) {
    const Eigen::Isometry3d T_window_base = world.T_odom_window().inverse() * world.truth().T_odom_base;
    const Eigen::Vector3d to_go = Eigen::Vector3d(1.6, 0, 0) - T_window_base.translation();
    world.command(
        {world.T_odom_window().linear() * Eigen::Vector3d(std::min(1.0, to_go.x()), to_go.y(), to_go.z())});
    world.advance();
  }
  const Verdict verdict = world.referee().judge(Claim::kNone);
  EXPECT_EQ(verdict.outcome, Outcome::kPassed) << verdict.reason;
  EXPECT_GT(*world.referee().minClearance(), 0.2);
}

TEST(World, RefusesAScenarioThatCannotBe) {
  Scenario scenario;
  scenario.start.distance_m = std::nan("");
  EXPECT_THROW(World(scenario, 1), ScenarioError);
  scenario = Scenario();
  scenario.camera.k1 = -0.9;
  scenario.camera.horizontal_fov_rad = 2.2;
  EXPECT_THROW(World(scenario, 1), ScenarioError);
}

}  // namespace
}  // namespace window_ingress::simulation
