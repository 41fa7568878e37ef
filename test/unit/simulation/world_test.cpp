#include "simulation/world.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "simulation/camera/reference_image.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::simulation::world_test {

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

TEST(World, ReferenceImageShowsTheTargetSquareWithItsFrameOutsideTheCorners) {
  Scenario scenario;
  scenario.camera.k1 = -0.2;
  const World world(scenario, 1);
  geometry::Quadrilateral corners;
  const cv::Mat image = referenceImage(world.scenario(), &corners);
  ASSERT_EQ(image.size(), cv::Size(640, 480));
  const double wide_px = corners[1].x() - corners[0].x(), high_px = corners[3].y() - corners[0].y();
  EXPECT_NEAR(wide_px / high_px, 1.2, 1e-9);
  const double frame_px = 0.07 * wide_px / 1.2;
  const auto at = [&](double x, double y) {
    return image.at<cv::Vec3b>(static_cast<int>(std::lround(y)), static_cast<int>(std::lround(x)));
  };
  const auto isOrange = [](const cv::Vec3b& bgr) {
    return bgr[2] > 120 && bgr[2] > 2 * bgr[1] && bgr[1] > bgr[0];
  };
  const Eigen::Vector2d middle = geometry::centroid(corners);
  EXPECT_TRUE(isOrange(at(corners[0].x() - 0.5 * frame_px, middle.y())));
  EXPECT_TRUE(isOrange(at(corners[1].x() + 0.5 * frame_px, middle.y())));
  EXPECT_TRUE(isOrange(at(middle.x(), corners[0].y() - 0.5 * frame_px)));
  EXPECT_TRUE(isOrange(at(middle.x(), corners[2].y() + 0.5 * frame_px)));
  EXPECT_FALSE(isOrange(at(corners[0].x() + 3.0, middle.y())));
  EXPECT_FALSE(isOrange(at(corners[0].x() - frame_px - 3.0, middle.y())));
}

TEST(World, CommandsAreUnderstoodInTheDriftedAxes) {
  Scenario scenario = quietScenario();
  scenario.odometry.yaw_drift_rad_per_sqrt_sec = 0.1;
  World world(scenario, 3);
  double worst_mps = 0.0, drifted_rad = 0.0;
  while (world.timeSec() < 12.0) {
    world.command({Eigen::Vector3d(0.5, 0, 0), 0.0});
    world.advance();
    const Eigen::Vector3d believed = world.odometryDrift().linear() * world.truth().velocity_odom_mps;
    if (world.timeSec() > 4.0) worst_mps = std::max(worst_mps, std::abs(believed.y()));
    drifted_rad = std::max(drifted_rad, std::abs(geometry::yawOf(world.odometryDrift().linear())));
  }
  EXPECT_GT(drifted_rad, 0.15);
  EXPECT_LT(worst_mps, 0.5 * 0.5 * drifted_rad + 0.03) << "in the true axes it would be all of the drift";
}

TEST(World, NoiseHasTheSizeAskedAndIsNewInEachImage) {
  Scenario scenario = quietScenario();
  scenario.camera.noise_grey = 3.0;
  scenario.odometry.velocity_noise_mps = 0.0;  // otherwise the vehicle would move between the two
  scenario.camera.blur_px = 0.0;
  World world(scenario, 1);
  std::vector<cv::Mat> images;
  while (images.size() < 2) {
    world.advance();
    if (const auto frame = world.takeFrame()) images.push_back(frame->image.clone());
  }
  cv::Mat difference;
  cv::subtract(images[1], images[0], difference, cv::noArray(), CV_16S);
  cv::Scalar mean, deviation;
  cv::meanStdDev(difference, mean, deviation);
  EXPECT_NEAR(deviation[1], 3.0 * std::sqrt(2.0), 0.4);
  EXPECT_NEAR(mean[1], 0.0, 0.2);
}

TEST(World, RefusesAScenarioThatCannotBe) {
  Scenario scenario;
  scenario.start.distance_m = std::nan("");
  EXPECT_THROW(World(scenario, 1), InputError);
  scenario = Scenario();
  scenario.camera.k1 = -0.9;
  scenario.camera.horizontal_fov_rad = 2.2;
  EXPECT_THROW(World(scenario, 1), InputError);
}

TEST(World, AVehicleThatHitsTheWallStopsThereAndFallsToTheGround) {
  Scenario scenario = quietScenario();
  World world(scenario, 4);
  const auto inWindow = [&] {
    return Eigen::Vector3d(world.T_odom_window().inverse() * world.truth().T_odom_base.translation());
  };
  while (world.timeSec() < 14.0) {  // at the wall, 1.5 m beside the opening's centre
    const Eigen::Vector3d way =
        inWindow().x() < -2.0 ? Eigen::Vector3d(0, 1.5 - inWindow().y(), 0) : Eigen::Vector3d::Zero();
    world.command({world.T_odom_window().linear() * (Eigen::Vector3d(1.0, 0, 0) + way)});
    world.advance();
  }
  const Verdict verdict = world.referee().judge(Claim::kNone);
  EXPECT_EQ(verdict.outcome, Outcome::kCollision);
  EXPECT_EQ(verdict.reason.rfind("touched wall at", 0), 0u) << verdict.reason;
  EXPECT_LT(inWindow().x(), 0.0) << "outside, however long it is told to go on";
  EXPECT_NEAR(world.truth().T_odom_base.translation().z(), world.scenario().vehicle.half_height_m, 1e-6);
  EXPECT_EQ(world.truth().velocity_odom_mps, Eigen::Vector3d::Zero().eval());
}

TEST(World, TheVehicleActsOnWhatItsOdometrySays) {
  Scenario scenario = quietScenario();
  scenario.odometry.scale_error = 0.25;
  World world(scenario, 1);
  while (world.timeSec() < 4.0) {
    world.command({Eigen::Vector3d(1.0, 0, 0)});
    world.advance();
  }
  EXPECT_NEAR(world.truth().velocity_odom_mps.x(), 0.8, 0.04) << "too slow, as it believes to be faster";
}

std::vector<double> stormyFlight(std::uint32_t seed) {
  Scenario scenario = quietScenario();
  scenario.wind.gusts = "dryden";
  scenario.wind.draught_mps = 2.0;
  scenario.odometry.jitter_sec = 0.02;
  scenario.odometry.burst_period_sec = 0.05;
  scenario.odometry.wander_m = 0.02;
  scenario.imu.gyro_bias_radps = 0.01;
  World world(scenario, seed);
  std::vector<double> numbers;
  while (world.timeSec() < 3.0) {
    world.command({Eigen::Vector3d(0.5, 0.1, 0.0), 0.1});
    world.advance();
    while (const auto sample = world.takeOdometry()) numbers.push_back(sample->T_odom_base.translation().y());
    while (const auto sample = world.takeImu()) numbers.push_back(sample->angular_velocity_base_radps.x());
  }
  return numbers;
}

TEST(World, GustsBurstsAndBiasesFollowFromTheSeedAlone) {
  const auto first = stormyFlight(3);
  EXPECT_GT(first.size(), 400u);
  EXPECT_EQ(first, stormyFlight(3));
  EXPECT_NE(first, stormyFlight(4));
}

TEST(World, ForwardIsWhereTheNosePointsWhateverTheHeading) {
  for (const double heading_rad : {0.0, 0.8, -1.9}) {
    for (const double odom_yaw_rad : {0.0, 2.6}) {
      Scenario scenario = quietScenario();
      scenario.start.heading_rad = heading_rad;
      scenario.start.odom_yaw_rad = odom_yaw_rad;
      World world(scenario, 1);
      const Eigen::Isometry3d start = world.truth().T_odom_base;
      while (world.timeSec() < 2.0) {
        world.command({start.linear() * Eigen::Vector3d(1.0, 0, 0), 0.0});
        world.advance();
      }
      const Eigen::Vector3d moved = (start.inverse() * world.truth().T_odom_base).translation();
      EXPECT_NEAR(moved.x(), 1.6, 0.2);
      EXPECT_LT(moved.tail<2>().norm(), 0.1);
    }
  }
}

TEST(World, RefusesAPayloadThatItCannotLift) {
  Scenario scenario;
  scenario.vehicle.payload_kg = 1.2 * scenario.vehicle.mass_kg;
  EXPECT_THROW(World(scenario, 1), InputError);
  scenario.vehicle.payload_kg = 0.4 * scenario.vehicle.mass_kg;
  EXPECT_NO_THROW(World(scenario, 1));
}

}  // namespace window_ingress::simulation::world_test
