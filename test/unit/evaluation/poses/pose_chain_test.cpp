#include "evaluation/poses/pose_chain.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "evaluation/poses/noisy_borders.hpp"
#include "window_ingress/estimation/window_pose_estimator.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::evaluation::pose_chain_test {

constexpr geometry::OpeningSize kOpening{1.2, 1.0};

SurveyImage sampleOf(const Eigen::Isometry3d& T) {
  SurveyImage sample;
  sample.scenario = "drawn";
  sample.seed = 3;
  sample.distance_m = T.translation().norm();
  sample.camera = geometry::PinholeCamera::fromFieldOfView(640, 480, 1.2);
  sample.truth.inner = geometry::projectOpening(sample.camera, T, kOpening).value();
  sample.truth.far = sample.truth.inner;
  return sample;
}

Eigen::Isometry3d view(double distance_m, double yaw_rad) {
  return geometry::makePose(geometry::R_optical_flu() * geometry::yawRotation(yaw_rad), {0, 0, distance_m});
}

TEST(PoseChain, TrueCornersGiveTheTruePose) {
  const auto T = view(4.0, -0.4);
  const auto sample = sampleOf(T);
  const auto found = poseOfTrueCorners(sample.truth.inner, sample.camera, kOpening);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->isApprox(T, 1e-6));
  geometry::Quadrilateral none = sample.truth.inner;
  none[1] = none[0];
  EXPECT_FALSE(poseOfTrueCorners(none, sample.camera, kOpening));
}

TEST(PoseChain, BordersAreMeasuredOutwardsAndInTheirOwnSpreads) {
  const auto T = view(4.0, 0.2);
  const auto sample = sampleOf(T);
  std::mt19937 random(1);
  auto window = noisyBorders(sample.camera, T, kOpening, 1e-6, random).value();
  for (int i = 0; i < 4; ++i) {
    auto& edge = window.edges[i];
    const Eigen::Vector2d along = (edge.b - edge.a).normalized(), outwards(along.y(), -along.x());
    edge.a += 0.3 * outwards;
    edge.b += 0.5 * outwards;
    edge.sigma_px = 0.2;
    edge.sigma_rad = 0.2 / (edge.b - edge.a).norm();
  }
  window.edges[2].visible = false;
  const auto errors = borderErrors(window, sample.truth.inner, sample.camera);
  EXPECT_FALSE(errors[2]);
  for (const int side : {0, 1, 3}) {
    ASSERT_TRUE(errors[side]) << side;
    EXPECT_NEAR(errors[side]->offset_px, 0.4, 1e-4);
    EXPECT_NEAR(errors[side]->ends_px, 0.1, 1e-4);
    EXPECT_NEAR(errors[side]->offset_sigmas, 2.0, 1e-3);
    EXPECT_NEAR(errors[side]->turn_sigmas, 1.0, 1e-3);
  }
}

TEST(PoseChain, ErrorsAreThoseOfThePose) {
  const auto T = view(3.0, 0.5);
  const auto sample = sampleOf(T);
  std::mt19937 random(2);
  estimation::PoseParams params;
  const estimation::WindowPoseEstimator estimator(params);
  const auto window = noisyBorders(sample.camera, T, kOpening, 1.0, random);
  const auto result = chainResult(sample, window, estimator, std::nullopt);
  ASSERT_TRUE(result.detected && result.estimate) << result.reject;
  EXPECT_NEAR(result.true_yaw_rad, 0.5, 1e-6);
  EXPECT_NEAR(result.estimate->yaw_rad - 0.5, result.yaw_error_rad, 1e-3);
  EXPECT_FALSE(result.wrong_sign);
  const auto commas = [](const std::string& text) { return std::count(text.begin(), text.end(), ','); };
  EXPECT_EQ(commas(poseChainRow(result)), commas(poseChainColumns()));
  const auto nothing = chainResult(sample, std::nullopt, estimator, std::nullopt);
  EXPECT_FALSE(nothing.detected || nothing.estimate);
  EXPECT_EQ(commas(poseChainRow(nothing)), commas(poseChainColumns()));
  const std::string table = poseChainTable({result, nothing});
  EXPECT_NE(table.find("| 3 | 2 | 1 | 1 |"), std::string::npos) << table;
  EXPECT_NE(table.find("| 3 | left | 1 |"), std::string::npos) << table;
}

}  // namespace window_ingress::evaluation::pose_chain_test
