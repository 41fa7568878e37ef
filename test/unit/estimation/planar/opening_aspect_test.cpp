
#include <gtest/gtest.h>

#include <limits>

#include "../pose_fixtures.hpp"
#include "estimation/planar/homography.hpp"
#include "window_ingress/estimation/size_estimate.hpp"

namespace window_ingress::estimation::opening_aspect_test {

using namespace fixtures;

WindowPoseEstimator assuming(const std::string& known, double width_m, double height_m, double sigma = 0.3) {
  PoseParams params = trustingParams();
  params.opening_width_m = width_m;
  params.opening_height_m = height_m;
  params.scale_sigma = known == "size" ? 0.0 : sigma;
  params.aspect_sigma = known == "nothing" ? sigma : 0.0;
  return WindowPoseEstimator{params};
}

TEST(OpeningAspect, TheHomographyOfARectangleShowsItsAspect) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int trial = 0; trial < 200; ++trial) {
    const geometry::OpeningSize opening{1.0 + 0.5 * unit(random), 1.0 + 0.4 * unit(random)};
    auto T = view(3.0 + unit(random), unit(random), unit(random), unit(random));
    T.linear() = T.linear() * geometry::rotationFromEuler({0.2 * unit(random), 0.2 * unit(random), 0.0});
    const auto corners = geometry::projectOpening(camera(), T, opening).value();
    geometry::Quadrilateral normalised;
    for (int i = 0; i < 4; ++i)
      normalised[i] = (corners[i] - Eigen::Vector2d(camera().cx, camera().cy)) / camera().fx;
    const auto homography = windowHomography(normalised, kOpening).value();
    const double assumed = kOpening.width_m / kOpening.height_m;
    const double correction = homography.col(0).norm() / homography.col(1).norm();
    EXPECT_NEAR(assumed * correction, opening.width_m / opening.height_m, 1e-9);
  }
}

TEST(OpeningAspect, IsMeasuredWhateverIsKnownAndItsSpreadIsHonest) {
  for (const std::string known : {"size", "aspect", "nothing"}) {
    std::mt19937 random(2);
    const auto estimator = assuming(known, 1.2, 1.0);
    const auto T = view(3.0, 0.5, 0.3, 0.2);
    double squares = 0.0, mean = 0.0;
    const int draws = 1000;
    for (int i = 0; i < draws; ++i) {
      const auto result = estimator.estimate(bordersSeen(camera(), T, 0.5, random), camera());
      ASSERT_TRUE(result.estimate && result.estimate->aspect) << result.detail;
      const auto& aspect = *result.estimate->aspect;
      squares += std::pow((aspect.ratio - 1.2) / aspect.sigma, 2) / draws;
      mean += aspect.ratio / draws;
    }
    EXPECT_NEAR(squares, 1.0, 0.15) << known;
    EXPECT_NEAR(mean, 1.2, 0.01) << known;
  }
}

TEST(OpeningAspect, AWrongSizeShowsInIt) {
  std::mt19937 random(3);
  const auto estimator = assuming("size", 1.0, 1.0);
  const auto result = estimator.estimate(bordersSeen(camera(), view(2.5, 0.4), 0.3, random), camera());
  ASSERT_TRUE(result.estimate && result.estimate->aspect) << result.detail;
  EXPECT_NEAR(result.estimate->aspect->ratio, 1.2, 0.05);
  EXPECT_GT(result.estimate->aspect->ratio - 1.0, 5.0 * result.estimate->aspect->sigma);
}

TEST(OpeningAspect, OfUnknownSizeTheYawIsKnownAsWellAsKeystoneAllows) {
  std::mt19937 random(4);
  const auto estimator = assuming("nothing", 0.8, 0.9);
  const auto T = view(4.0, 0.5);
  double squares = 0.0, ratio_to_u = 0.0;
  const int draws = 1000;
  for (int i = 0; i < draws; ++i) {
    const auto result = estimator.estimate(bordersSeen(camera(), T, 0.5, random), camera());
    ASSERT_TRUE(result.estimate) << result.detail;
    const auto& estimate = *result.estimate;
    squares += std::pow((estimate.yaw_rad - 0.5) / estimate.yaw_sigma_rad, 2) / draws;
    ratio_to_u += estimate.yaw_sigma_rad / estimate.sigma_u_rad / draws;
    const double aspect = estimate.opening.width_m / estimate.opening.height_m;
    EXPECT_NEAR(aspect, estimate.aspect->ratio, 0.1);
  }
  EXPECT_NEAR(squares, 1.0, 0.15);
  EXPECT_NEAR(ratio_to_u, 1.0, 0.05);
}

TEST(OpeningAspect, OfUnknownScaleTheDistanceIsAsUncertainAsTheScale) {
  std::mt19937 random(5);
  const auto window = bordersSeen(camera(), view(4.0, 0.4), 0.1, random);
  const auto known = assuming("size", 1.2, 1.0).estimate(window, camera()).estimate.value();
  const auto aspect = assuming("aspect", 1.2, 1.0, 0.2).estimate(window, camera()).estimate.value();
  EXPECT_NEAR(aspect.yaw_rad, known.yaw_rad, 1e-6);
  EXPECT_NEAR(aspect.yaw_sigma_rad, known.yaw_sigma_rad, 1e-5);
  EXPECT_NEAR(std::sqrt(aspect.best.covariance(2, 2)), 0.2 * 4.0, 0.02);
  EXPECT_NEAR(aspect.opening_log_covariance(0, 1), 0.04, 1e-3);
  EXPECT_TRUE(known.opening_log_covariance.isZero(0.0));
  // An opening twice as large at twice the distance gives the same image.
  const auto twice = assuming("aspect", 2.4, 2.0, 0.2).estimate(window, camera()).estimate.value();
  EXPECT_NEAR(twice.best.T_camera_window.translation().norm(),
              2.0 * known.best.T_camera_window.translation().norm(), 1e-3);
}

TEST(OpeningAspect, ABeliefGivenAlongReplacesTheParameters) {
  std::mt19937 random(6);
  const auto window = bordersSeen(camera(), view(4.0, 0.4), 0.1, random);
  PoseHints hints;
  hints.size = sizeEstimate({1.2, 1.0}, 0.0, 0.0);
  const auto result = assuming("nothing", 0.5, 2.0).estimate(window, camera(), hints);
  ASSERT_TRUE(result.estimate) << result.detail;
  EXPECT_DOUBLE_EQ(result.estimate->opening.width_m, 1.2);
  EXPECT_NEAR(result.estimate->best.T_camera_window.translation().z(), 4.0, 0.05);
}

TEST(SizeEstimate, RootsAndLimits) {
  const geometry::OpeningSize size{1.2, 1.0};
  SizeEstimate general{size, (Eigen::Matrix2d() << 0.04, 0.01, 0.01, 0.09).finished()};
  for (const SizeEstimate& belief :
       {sizeEstimate(size, 0.0, 0.0), sizeEstimate(size, 0.3, 0.0), sizeEstimate(size, 0.3, 0.2), general}) {
    EXPECT_TRUE(isUsable(belief));
    const Eigen::Matrix2d root = rootOf(belief);
    EXPECT_EQ(root.isZero(0.0), belief.log_covariance.isZero(0.0));
    EXPECT_LT((root * root.transpose() - belief.log_covariance).norm(), 1e-12);
  }
  const Eigen::Vector2d aspect(1.0, -1.0);
  EXPECT_NEAR(aspect.dot(sizeEstimate(size, 0.3, 0.2).log_covariance * aspect), 0.04, 1e-12);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  SizeEstimate bad = general;
  bad.log_covariance(0, 1) = 0.5;
  EXPECT_FALSE(isUsable(bad));
  EXPECT_FALSE(isUsable({{nan, 1.0}, Eigen::Matrix2d::Zero()}));
  EXPECT_FALSE(isUsable({{-1.0, 1.0}, Eigen::Matrix2d::Zero()}));
  EXPECT_FALSE(isUsable({size, Eigen::Matrix2d::Constant(nan)}));
  EXPECT_FALSE(isUsable({size, -Eigen::Matrix2d::Identity()}));
}

}  // namespace window_ingress::estimation::opening_aspect_test
