#include "estimation/filter/window_state.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "../pose_fixtures.hpp"

namespace window_ingress::estimation::window_state_test {

using namespace fixtures;

constexpr double kStep = 1e-6;

WindowState randomState(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  WindowState state;
  state.anchor_m = {unit(random), unit(random), 1.5};
  state.values << 4.0 + unit(random), unit(random), 0.3 * unit(random), 0.6 * unit(random),
      0.3 * unit(random), 0.3 * unit(random), 0.3 * unit(random), 0.3 * unit(random),
      1.0 + 0.3 * unit(random), 0.1 * unit(random), 0.05 * unit(random), 0.2 * unit(random),
      0.2 * unit(random), 0.2 * unit(random);
  return state;
}

ScaledCamera randomCamera(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const Eigen::Matrix3d R =
      geometry::rotationFromEuler({0.1 * unit(random), 0.1 * unit(random), 0.2 * unit(random)}) *
      geometry::R_optical_flu().transpose();
  return {geometry::makePose(R, {unit(random), unit(random), 1.5 + 0.2 * unit(random)}),
          {{unit(random), unit(random), unit(random)}, {unit(random), unit(random), unit(random)}},
          {0.02 * unit(random), 0.02 * unit(random), 0.02 * unit(random)}};
}

// Dividing by the window's height keeps the part that does not scale.
ScaledCamera at(const ScaledCamera& camera, const WindowState& from, const WindowState& to) {
  const double share = from.values(WindowState::kInverseHeight) / to.values(WindowState::kInverseHeight);
  ScaledCamera moved = camera;
  moved.unscaled_m *= share;
  moved.T_odom_camera.translation() += moved.unscaled_m - camera.unscaled_m;
  return moved;
}

TEST(WindowState, PlaceAndSizeComeInHeightsOfTheOpening) {
  WindowState state;
  state.anchor_m = {1, 2, 3};
  state.values << 4, 0, 1, 0.5, 0, 0, 0, std::log(1.5), 1.0 / 0.8, 0, 0, 0.1, 0.0, -0.2;
  EXPECT_LT((state.position() - Eigen::Vector3d(1 + 3.2, 2, 3 + 0.8)).norm(), 1e-12);
  EXPECT_LT((state.velocity() - Eigen::Vector3d(0.08, 0.0, -0.16)).norm(), 1e-12);
  EXPECT_NEAR(state.opening().width_m, 1.2, 1e-12);
  EXPECT_NEAR(state.opening().height_m, 0.8, 1e-12);
  EXPECT_NEAR(geometry::yawOf(state.T_odom_window().linear()), 0.5, 1e-12);
}

TEST(WindowState, WhatTheAnchorSeesDoesNotDependOnTheScale) {
  std::mt19937 random(1);
  WindowState state = randomState(random);
  const auto T = geometry::makePose(geometry::R_optical_flu().transpose(), state.anchor_m);
  const auto seen = geometry::projectOpening(camera(), state.T_camera_window(T), state.opening()).value();
  state.values(WindowState::kInverseHeight) *= 0.4;
  const auto larger = geometry::projectOpening(camera(), state.T_camera_window(T), state.opening()).value();
  for (int i = 0; i < 4; ++i) EXPECT_LT((seen[i] - larger[i]).norm(), 1e-9);
}

TEST(WindowState, DerivativesOfTheImageAgainstDifferences) {
  std::mt19937 random(2);
  const auto lens = camera();
  for (int trial = 0; trial < 50; ++trial) {
    const WindowState state = randomState(random);
    const ScaledCamera from = randomCamera(random);
    const auto window =
        bordersSeen(lens, state.T_camera_window(from.T_odom_camera), 1.0, random, state.opening());
    const auto image = ImageMeasurement::make(window, lens, {}).value();
    const auto linear = linearise(image, lens, from, state).value();
    for (int k = 0; k < WindowState::kSize; ++k) {
      WindowState more = state, less = state;
      more.values(k) += kStep;
      less.values(k) -= kStep;
      const Residual numeric = (linearise(image, lens, at(from, state, more), more)->residual -
                                linearise(image, lens, at(from, state, less), less)->residual) /
                               (2 * kStep);
      EXPECT_LT((numeric - linear.by_state.col(k)).norm(), 1e-4 * (1.0 + numeric.norm())) << k;
    }
  }
}

TEST(WindowState, WhereTheHeadingIsOffOrOdometryLateTheCameraWasElsewhere) {
  std::mt19937 random(5);
  const auto lens = camera();
  WindowState state = randomState(random);
  state.values.segment<5>(WindowState::kPitchBias).setZero();
  state.values(WindowState::kInverseHeight) = 1.0;
  state.values(WindowState::kHeadingBias) = 0.08;
  state.values(WindowState::kLate) = 0.1;
  ScaledCamera at = randomCamera(random);
  at.motion.turn_radps = {0.0, 0.0, 0.5};
  Eigen::Isometry3d was = at.T_odom_camera;
  was.linear() = geometry::yawRotation(0.05 - 0.08) * was.linear();
  was.translation() += 0.1 * at.motion.velocity_mps;
  const auto window = bordersSeen(lens, state.T_camera_window(was), 1e-9, random, state.opening());
  const auto image = ImageMeasurement::make(window, lens, {}).value();
  EXPECT_LT(linearise(image, lens, at, state)->residual.norm(), 1e-6);
}

TEST(WindowState, DerivativesOfThePlaceAgainstDifferences) {
  std::mt19937 random(3);
  const WindowState state = randomState(random);
  for (int k = 0; k < WindowState::kSize; ++k) {
    WindowState more = state, less = state;
    more.values(k) += kStep;
    less.values(k) -= kStep;
    const Eigen::Vector3d moved = (more.position() - less.position()) / (2 * kStep);
    EXPECT_LT((moved - state.poseByValues().col(k).head<3>()).norm(), 1e-6) << k;
  }
}

TEST(WindowState, NoImageOfAnOpeningWithoutSizeOrBehindTheCamera) {
  std::mt19937 random(4);
  WindowState state = randomState(random);
  const auto lens = camera();
  const ScaledCamera from = randomCamera(random);
  const auto window =
      bordersSeen(lens, state.T_camera_window(from.T_odom_camera), 1.0, random, state.opening());
  const auto image = ImageMeasurement::make(window, lens, {}).value();
  for (const double inverse_height : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    WindowState bad = state;
    bad.values(WindowState::kInverseHeight) = inverse_height;
    EXPECT_FALSE(linearise(image, lens, from, bad)) << inverse_height;
  }
  state.values(WindowState::kX) = -4.0;
  EXPECT_FALSE(linearise(image, lens, from, state));
}

}  // namespace window_ingress::estimation::window_state_test
