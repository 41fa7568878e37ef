#include "estimation/filter/window_hypothesis.hpp"

#include <gtest/gtest.h>

#include "../pose_fixtures.hpp"

namespace window_ingress::estimation::window_hypothesis_test {

using namespace fixtures;

const Eigen::Isometry3d kWindow = geometry::makePose(geometry::yawRotation(0.4), {4, 0.5, 1.5});
const SizeEstimate kKnown{kOpening};
const YawBias kNoBias{0.0, 0.005};
const Eigen::Vector3d kOrigin = Eigen::Vector3d::Zero();
const Eigen::Isometry3d kCamera = geometry::makePose(geometry::R_optical_flu().transpose(), {0, 0, 1.5});

double yawSigma(const WindowHypothesis& window) { return std::sqrt(window.poseCovariance()(3, 3)); }

TEST(WindowHypothesis, OneImageFindsTheWindowFromAWidePrior) {
  std::mt19937 random(1);
  const auto lens = camera();
  const auto image =
      ImageMeasurement::make(bordersSeen(lens, kCamera.inverse() * kWindow, 0.5, random), lens, {}).value();
  WindowHypothesis window(FilterParams{}, geometry::makePose(geometry::yawRotation(0.1), {5, 0, 1.2}), kKnown,
                          kNoBias, kCamera.translation());
  const double before = yawSigma(window);
  const auto outcome = window.update(FilterParams{}, {image, image, lens, kCamera});
  ASSERT_TRUE(outcome);
  EXPECT_LT(outcome->squares, 20.0);
  EXPECT_LT(yawSigma(window), 0.1 * before);
  EXPECT_LT((window.T_odom_window().translation() - kWindow.translation()).norm(), 0.1);
  EXPECT_NEAR(geometry::yawOf(window.T_odom_window().linear()), 0.4, 4.0 * yawSigma(window));
}

TEST(WindowHypothesis, MirroringKeepsTheSightAndTurnsTheYaw) {
  const WindowHypothesis window(FilterParams{}, kWindow, kKnown, kNoBias, kOrigin);
  const Eigen::Vector3d position(0, -1, 1.5);
  const auto other = window.mirrored(position);
  EXPECT_NEAR(other.yawFromSight(position), -window.yawFromSight(position), 1e-12);
  EXPECT_EQ(other.state().position(), window.state().position());
  EXPECT_NEAR(other.mirrored(position).state().yaw(), window.state().yaw(), 1e-12);
  EXPECT_TRUE(other.mirrored(position).covariance().isApprox(window.covariance(), 1e-9));
}

TEST(WindowHypothesis, HeadingDriftCarriesTheWindowAround) {
  FilterParams params;
  params.drift_m_per_sqrt_sec = params.drift_m_per_sqrt_m = 0.0;
  params.drift_rad_per_sqrt_sec = 0.01;
  WindowHypothesis window(params, geometry::makePose(Eigen::Matrix3d::Identity(), {10, 0, 0}), kKnown,
                          kNoBias, kOrigin);
  const Eigen::Matrix4d before = window.poseCovariance();
  window.predict(params, 4.0, 0.0, {0, 0, 0});
  const Eigen::Matrix4d grown = window.poseCovariance() - before;
  EXPECT_NEAR(grown(3, 3), 4e-4, 1e-12);
  EXPECT_NEAR(grown(1, 1), 4e-2, 1e-12) << "10 m off, sideways";
  EXPECT_NEAR(grown(0, 0), 0.0, 1e-12);
  EXPECT_NEAR(grown(1, 3), 4e-3, 1e-12);
}

TEST(WindowHypothesis, MergingKeepsMeanAndSpread) {
  const WindowHypothesis a(FilterParams{}, geometry::makePose(geometry::yawRotation(3.1), {4, 0, 0}), kKnown,
                           kNoBias, kOrigin);
  const WindowHypothesis b(FilterParams{}, geometry::makePose(geometry::yawRotation(-3.1), {4, 2, 0}), kKnown,
                           kNoBias, kOrigin);
  const auto merged = a.mergedWith(b, 0.5);
  EXPECT_NEAR(merged.state().position().y(), 1.0, 1e-12);
  EXPECT_NEAR(std::abs(merged.state().yaw()), M_PI, 1e-9);
  EXPECT_NEAR(merged.poseCovariance()(1, 1) - a.poseCovariance()(1, 1), 1.0, 1e-4);
  EXPECT_NEAR(a.distanceTo(a), 0.0, 1e-12);
}

TEST(WindowHypothesis, BehindTheCameraThereIsNoUpdate) {
  std::mt19937 random(1);
  const auto lens = camera();
  const auto image =
      ImageMeasurement::make(bordersSeen(lens, kCamera.inverse() * kWindow, 0.5, random), lens, {}).value();
  WindowHypothesis window(FilterParams{}, geometry::makePose(Eigen::Matrix3d::Identity(), {-5, 0, 1.5}),
                          kKnown, kNoBias, kOrigin);
  const auto state = window.state().values;
  EXPECT_FALSE(window.update(FilterParams{}, {image, image, lens, kCamera}));
  EXPECT_EQ(window.state().values, state);
}

}  // namespace window_ingress::estimation::window_hypothesis_test
