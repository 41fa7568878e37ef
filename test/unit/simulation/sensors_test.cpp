#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "simulation/random_stream.hpp"
#include "simulation/schedule.hpp"
#include "simulation/sensors/imu_sensor.hpp"
#include "simulation/sensors/odometry_sensor.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::simulation::sensors_test {

constexpr double kStep_sec = 0.0025;

double deviation(const std::vector<double>& values) {
  double sum = 0.0, squares = 0.0;
  for (const double v : values) sum += v;
  const double mean = sum / static_cast<double>(values.size());
  for (const double v : values) squares += (v - mean) * (v - mean);
  return std::sqrt(squares / static_cast<double>(values.size()));
}

VehicleTruth standing() {
  VehicleTruth truth;
  truth.T_odom_base = geometry::makePose(geometry::yawRotation(0.7), {3.0, -2.0, 1.5});
  return truth;
}

OdometryParams withoutNoise() {
  OdometryParams params;
  params.position_noise_m = params.velocity_noise_mps = params.attitude_noise_rad = 0.0;
  return params;
}

TEST(RandomStream, NamesAndSeedsGiveUnrelatedNumbersAndTheSameGiveTheSame) {
  RandomStream a(1, "a"), again(1, "a"), b(1, "b"), other(2, "a");
  for (int i = 0; i < 10; ++i) {
    const auto value = a.bits();
    EXPECT_EQ(value, again.bits());
    EXPECT_NE(value, b.bits());
    EXPECT_NE(value, other.bits());
  }
}

TEST(RandomStream, NormalNumbersHaveTheirMeanAndDeviation) {
  RandomStream random(3, "normal");
  std::vector<double> values;
  double sum = 0.0;
  for (int i = 0; i < 20000; ++i) sum += values.emplace_back(random.normal(2.0));
  EXPECT_NEAR(sum / 20000.0, 0.0, 0.06);
  EXPECT_NEAR(deviation(values), 2.0, 0.05);
}

TEST(Schedule, PeriodsNeitherDriftNorDoubleUp) {
  Periodic camera(30.0);
  int count = 0;
  for (int i = 1; i <= 4000; ++i) count += camera.due(i * kStep_sec);
  EXPECT_EQ(count, 301);
}

TEST(Schedule, DelayedValuesArriveInTimeAndInOrder) {
  DelayLine<int> line;
  line.push(0.1, 1);
  line.push(0.15, 2);
  line.push(0.3, 3);
  EXPECT_FALSE(line.take(0.09));
  EXPECT_EQ(line.take(0.15), 1);
  EXPECT_EQ(line.take(0.15), 2);
  EXPECT_FALSE(line.take(0.2));
  EXPECT_EQ(line.take(5.0), 3);
  EXPECT_FALSE(line.take(5.0));
}

TEST(Schedule, WhatLeftLaterNeverOvertakes) {
  DelayLine<int> line;
  line.push(0.5, 1);
  line.push(0.2, 2);
  EXPECT_FALSE(line.take(0.4));
  EXPECT_EQ(line.take(0.5), 1);
  EXPECT_EQ(line.take(0.5), 2);
}

TEST(Odometry, WithoutNoiseAndDriftItIsTheTruth) {
  OdometryParams params = withoutNoise();
  params.drift_m_per_sqrt_sec = params.height_drift_m_per_sqrt_sec = params.yaw_drift_rad_per_sqrt_sec = 0.0;
  OdometrySensor sensor(params, 1);
  VehicleTruth truth = standing();
  truth.velocity_odom_mps = {0.3, -0.2, 0.1};
  sensor.update(0.0, truth);
  const auto sample = sensor.take(1.0);
  ASSERT_TRUE(sample);
  EXPECT_TRUE(sample->T_odom_base.isApprox(truth.T_odom_base, 1e-12));
  EXPECT_TRUE(sample->velocity_odom_mps.isApprox(truth.velocity_odom_mps, 1e-12));
  EXPECT_DOUBLE_EQ(sample->stamp_sec, 0.0);
}

TEST(Odometry, DriftGrowsWithTheRootOfTimeAndTurnsVelocityToo) {
  OdometryParams params = withoutNoise();
  params.drift_m_per_sqrt_sec = 0.02;
  std::vector<double> ends, yaws;
  for (std::uint32_t seed = 0; seed < 120; ++seed) {
    OdometrySensor sensor(params, seed);
    for (double t = 0.0; t < 25.0; t += 0.02) sensor.update(t, standing());
    ends.push_back((sensor.drift() * standing().T_odom_base).translation().x() - 3.0);
    yaws.push_back(geometry::yawOf(sensor.drift().linear()));
  }
  EXPECT_NEAR(deviation(ends), 0.02 * 5.0, 0.025);
  EXPECT_NEAR(deviation(yaws), params.yaw_drift_rad_per_sqrt_sec * 5.0, 0.002);

  params.yaw_drift_rad_per_sqrt_sec = 0.2;
  OdometrySensor turning(params, 4);
  VehicleTruth truth = standing();
  truth.velocity_odom_mps = {1.0, 0.0, 0.0};
  for (double t = 0.0; t < 5.0; t += 0.02) turning.update(t, truth);
  std::optional<OdometrySample> sample;
  while (const auto next = turning.take(10.0)) sample = next;
  EXPECT_NEAR(std::atan2(sample->velocity_odom_mps.y(), sample->velocity_odom_mps.x()),
              geometry::yawOf(turning.drift().linear()), 1e-9);
}

TEST(Odometry, NoiseHasItsSize) {
  OdometryParams params;
  params.drift_m_per_sqrt_sec = params.height_drift_m_per_sqrt_sec = params.yaw_drift_rad_per_sqrt_sec = 0.0;
  OdometrySensor sensor(params, 9);
  std::vector<double> position, velocity;
  for (double t = 0.0; t < 40.0; t += 0.02) {
    sensor.update(t, standing());
    if (const auto sample = sensor.take(t)) {
      position.push_back(sample->T_odom_base.translation().y());
      velocity.push_back(sample->velocity_odom_mps.z());
      EXPECT_TRUE(geometry::isValidPose(sample->T_odom_base));
    }
  }
  EXPECT_NEAR(deviation(position), params.position_noise_m, 0.0004);
  EXPECT_NEAR(deviation(velocity), params.velocity_noise_mps, 0.002);
}

TEST(Imu, AttitudeErrorHasItsSizeAndLastsAndLeavesTheHeading) {
  ImuParams params;
  ImuSensor sensor(params, 5);
  const VehicleTruth truth = standing();
  std::vector<double> tilts, changes;
  for (double t = 0.0; t < 200.0; t += 0.01) {
    sensor.update(t, truth, {0, 0, 9.81}, Eigen::Isometry3d::Identity());
    const auto sample = sensor.take(t);
    if (!sample) continue;
    const Eigen::Matrix3d error =
        truth.T_odom_base.linear().transpose() * sample->R_odom_base.toRotationMatrix();
    if (!tilts.empty()) changes.push_back(error(2, 1) - tilts.back());
    tilts.push_back(error(2, 1));
    EXPECT_NEAR(geometry::yawOf(error), 0.0, 1e-3);
    EXPECT_NEAR(sample->specific_force_base_mps2.z(), 9.81, 0.6);
  }
  EXPECT_NEAR(deviation(tilts), params.attitude_noise_rad, 0.0012);
  EXPECT_LT(deviation(changes), 0.3 * params.attitude_noise_rad) << "it must not jump from sample to sample";
}

OdometryParams exact() {
  OdometryParams params = withoutNoise();
  params.drift_m_per_sqrt_sec = params.height_drift_m_per_sqrt_sec = params.yaw_drift_rad_per_sqrt_sec = 0.0;
  return params;
}

VehicleTruth movingAt(double time_sec, const Eigen::Vector3d& velocity_mps) {
  VehicleTruth truth = standing();
  truth.T_odom_base.translation() += time_sec * velocity_mps;
  truth.velocity_odom_mps = velocity_mps;
  return truth;
}

TEST(Odometry, AScaleErrorStretchesHorizontalMovementAndSpeed) {
  OdometryParams params = exact();
  params.scale_error = -0.1;
  OdometrySensor sensor(params, 1);
  std::optional<OdometrySample> first, last;
  for (double t = 0.0; t < 4.0; t += kStep_sec) {
    sensor.update(t, movingAt(t, {1.0, -0.5, 0.2}));
    while (const auto sample = sensor.take(t)) {
      if (!first) first = sample;
      last = sample;
    }
  }
  const Eigen::Vector3d moved = last->T_odom_base.translation() - first->T_odom_base.translation();
  EXPECT_TRUE(moved.isApprox((last->stamp_sec - first->stamp_sec) * Eigen::Vector3d(0.9, -0.45, 0.2), 1e-9));
  EXPECT_TRUE(last->velocity_odom_mps.isApprox(Eigen::Vector3d(0.9, -0.45, 0.2), 1e-9));
  EXPECT_TRUE(sensor.velocityEstimate().isApprox(Eigen::Vector3d(0.9, -0.45, 0.2), 1e-9));
  EXPECT_LT((sensor.drift() * movingAt(last->stamp_sec, {1.0, -0.5, 0.2}).T_odom_base.translation() -
             last->T_odom_base.translation())
                .norm(),
            0.01)
      << "drift says where the scale has put it";
}

double horizontalNoise(double height_m, double texture) {
  OdometryParams params = exact();
  params.position_noise_m = 0.01;
  params.height_factor_per_m = 0.5;
  params.texture_quality = texture;
  OdometrySensor sensor(params, 2);
  VehicleTruth truth = standing();
  truth.T_odom_base.translation().z() = height_m;
  std::vector<double> x, z;
  for (double t = 0.0; t < 60.0; t += 0.02) {
    sensor.update(t, truth);
    while (const auto sample = sensor.take(t)) {
      x.push_back(sample->T_odom_base.translation().x());
      z.push_back(sample->T_odom_base.translation().z());
    }
  }
  EXPECT_NEAR(deviation(z), 0.01, 0.001) << "the height comes from elsewhere";
  return deviation(x);
}

TEST(Odometry, ErrorsGrowWithHeightAndLackOfTexture) {
  EXPECT_NEAR(horizontalNoise(0.0, 1.0), 0.01, 0.001);
  EXPECT_NEAR(horizontalNoise(4.0, 1.0), 0.03, 0.002);
  EXPECT_NEAR(horizontalNoise(4.0, 0.5), 0.06, 0.004);
  EXPECT_NEAR(horizontalNoise(0.0, 0.0), 0.2, 0.02) << "bounded where there is nothing to see";
}

TEST(Odometry, SamplesOfABurstComeTogetherInOrderAndNoneIsLost) {
  OdometryParams params = exact();
  params.burst_period_sec = 0.1;
  params.jitter_sec = 0.03;
  OdometrySensor sensor(params, 1);
  double last_stamp_sec = -1.0;
  std::size_t count = 0;
  for (int step = 0; step <= 800; ++step) {
    const double now_sec = step * kStep_sec;
    sensor.update(now_sec, standing());
    std::size_t burst = 0;
    while (const auto sample = sensor.take(now_sec)) {
      EXPECT_NEAR(std::remainder(now_sec, 0.1), 0.0, 1e-9);
      EXPECT_GT(sample->stamp_sec, last_stamp_sec);
      last_stamp_sec = sample->stamp_sec;
      ++burst;
    }
    EXPECT_LE(burst, 8u);
    count += burst;
  }
  EXPECT_NEAR(static_cast<double>(count), 98.0, 3.0);
}

TEST(Odometry, StampsMayBeInTheFutureAndTheLoopsOwnEstimateIsOfItsOwnAge) {
  OdometryParams params = exact();
  params.latency_sec = 0.0;
  params.stamp_offset_sec = 0.054;
  params.estimate_delay_sec = 0.1;
  OdometrySensor sensor(params, 1);
  for (int step = 0; step <= 400; ++step) {
    const double now_sec = step * kStep_sec;
    sensor.update(now_sec, movingAt(0.0, {now_sec, 0, 0}));  // speeds up by 1 m/s each second
    while (const auto sample = sensor.take(now_sec)) {
      EXPECT_NEAR(sample->stamp_sec, now_sec + 0.054, 1e-9);
      EXPECT_NEAR(sample->velocity_odom_mps.x(), now_sec, 1e-9);
    }
    EXPECT_NEAR(sensor.velocityEstimate().x(), std::max(0.0, now_sec - 0.1), kStep_sec);
  }
}

TEST(Odometry, WanderOfPositionAndVelocityComesAndGoesAndStaysBounded) {
  OdometryParams params = exact();
  params.wander_m = 0.05;
  params.velocity_wander_mps = 0.12;
  params.wander_correlation_sec = params.velocity_wander_correlation_sec = 2.0;
  OdometrySensor sensor(params, 3);
  std::vector<double> of_position, of_velocity;
  for (double t = 0.0; t < 2000.0; t += 0.02) {
    sensor.update(t, standing());
    while (const auto sample = sensor.take(t)) {
      of_position.push_back(sample->T_odom_base.translation().x() - 3.0);
      of_velocity.push_back(sample->velocity_odom_mps.y());
    }
  }
  for (const auto& [errors, spread] : {std::pair{of_position, 0.05}, std::pair{of_velocity, 0.12}}) {
    EXPECT_NEAR(deviation(errors), spread, 0.12 * spread);
    double next = 0.0;
    for (std::size_t i = 0; i + 100 < errors.size(); ++i) next += errors[i] * errors[i + 100];
    EXPECT_NEAR(next / static_cast<double>(errors.size() - 100) / (spread * spread), std::exp(-1.0), 0.12);
  }
}

TEST(Imu, BiasesStayTheSameAllFlightAndLatencyAndStampsAreTheirOwn) {
  ImuParams params;
  params.attitude_noise_rad = params.gyro_noise_radps = params.accelerometer_noise_mps2 = 0.0;
  params.roll_bias_rad = 0.02;
  params.pitch_bias_rad = -0.01;
  params.gyro_bias_radps = 0.05;
  params.latency_sec = 0.04;
  params.stamp_offset_sec = -0.02;
  const VehicleTruth truth = standing();
  std::vector<double> biases;
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    ImuSensor sensor(params, seed);
    sensor.update(0.0, truth, {0, 0, 9.81}, Eigen::Isometry3d::Identity());
    sensor.update(0.01, truth, {0, 0, 9.81}, Eigen::Isometry3d::Identity());
    EXPECT_FALSE(sensor.take(0.035));
    const auto first = sensor.take(0.06), second = sensor.take(0.06);
    ASSERT_TRUE(first && second);
    EXPECT_NEAR(first->stamp_sec, -0.02, 1e-12);
    EXPECT_EQ(first->angular_velocity_base_radps, second->angular_velocity_base_radps);
    biases.push_back(first->angular_velocity_base_radps.x());
    const Eigen::Matrix3d error =
        truth.T_odom_base.linear().transpose() * first->R_odom_base.toRotationMatrix();
    EXPECT_NEAR(error(2, 1), 0.02, 2e-4);
    EXPECT_NEAR(error(0, 2), -0.01, 2e-4);
  }
  EXPECT_NEAR(deviation(biases), 0.05, 0.008);
}

}  // namespace window_ingress::simulation::sensors_test
