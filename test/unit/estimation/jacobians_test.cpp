/// Analytic derivatives against central differences.
#include <gtest/gtest.h>

#include "estimation/planar/image_measurement.hpp"
#include "estimation/planar/refinement.hpp"
#include "estimation/planar/relative_yaw.hpp"
#include "pose_fixtures.hpp"

namespace window_ingress::estimation::jacobians_test {

using namespace fixtures;
using Vector6d = Eigen::Matrix<double, 6, 1>;

constexpr double kStep = 1e-6;

Eigen::Isometry3d randomPose(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  auto T = view(4.0 + unit(random), unit(random), unit(random), unit(random));
  T.linear() = T.linear() * geometry::rotationFromEuler({0.3 * unit(random), 0.3 * unit(random), 0.0});
  return T;
}

TEST(Jacobians, PredictedCornersByPoseAndSize) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const auto T = randomPose(random);
    const auto predicted = predictOpening(camera(), T, kOpening).value();
    for (int k = 0; k < 6; ++k) {
      const Vector6d h = kStep * Vector6d::Unit(k);
      const CornerVector numeric = (predictOpening(camera(), moved(T, h), kOpening)->corners_px -
                                    predictOpening(camera(), moved(T, -h), kOpening)->corners_px) /
                                   (2 * kStep);
      EXPECT_LT((numeric - predicted.by_pose.col(k)).norm(), 1e-4) << k;
    }
    for (int k = 0; k < 2; ++k) {
      auto larger = kOpening, smaller = kOpening;
      (k == 0 ? larger.width_m : larger.height_m) *= std::exp(kStep);
      (k == 0 ? smaller.width_m : smaller.height_m) *= std::exp(-kStep);
      const CornerVector numeric = (predictOpening(camera(), T, larger)->corners_px -
                                    predictOpening(camera(), T, smaller)->corners_px) /
                                   (2 * kStep);
      EXPECT_LT((numeric - predicted.by_log_size.col(k)).norm(), 1e-4) << k;
    }
  }
}

TEST(Jacobians, PredictedCornersAreProjectedOnes) {
  std::mt19937 random(2);
  const auto T = randomPose(random);
  const auto image = geometry::projectOpening(camera(), T, kOpening).value();
  const auto predicted = predictOpening(camera(), T, kOpening).value();
  for (int i = 0; i < 4; ++i) EXPECT_LT((predicted.corners_px.segment<2>(2 * i) - image[i]).norm(), 1e-9);
  EXPECT_FALSE(predictOpening(camera(), view(-1.0, 0.0), kOpening));
}

void expectResidualSlope(const ImageMeasurement& image, const CornerVector& at) {
  const auto linear = image.evaluate(at);
  for (int k = 0; k < 8; ++k) {
    const CornerVector h = kStep * CornerVector::Unit(k);
    const Residual numeric =
        (image.evaluate(at + h).residual - image.evaluate(at - h).residual) / (2 * kStep);
    EXPECT_LT((numeric - linear.by_corners.col(k)).norm(), 1e-4 * (1.0 + numeric.norm())) << k;
  }
}

TEST(Jacobians, ResidualsByCorners) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 3.0);
  for (int trial = 0; trial < 50; ++trial) {
    const auto T = randomPose(random);
    auto borders = bordersSeen(distortedCamera(), T, 1.0, random);
    CornerVector at = predictOpening(distortedCamera(), T, kOpening)->corners_px;
    for (int k = 0; k < 8; ++k) at(k) += noise(random);
    expectResidualSlope(ImageMeasurement::make(borders, distortedCamera(), {}).value(), at);
    auto corners = borders;
    for (auto& edge : corners.edges) edge = {};
    corners.corner_covariance.fill((Eigen::Matrix2d() << 0.5, 0.2, 0.2, 0.3).finished());
    expectResidualSlope(ImageMeasurement::make(corners, distortedCamera(), {}).value(), at);
    borders.edges[trial % 4].visible = false;
    const auto partial = ImageMeasurement::make(borders, distortedCamera(), {}).value();
    EXPECT_EQ(partial.size(), 6);
    expectResidualSlope(partial, at);
  }
}

TEST(Jacobians, CostByPose) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 50; ++trial) {
    const auto T = randomPose(random);
    const auto image = ImageMeasurement::make(bordersSeen(camera(), T, 1.0, random), camera(), {}).value();
    const auto lens = camera();
    const RefinementProblem problem{image, lens, kOpening, GravityPrior{{0.1, -0.9, 0.2}, 0.02}};
    const auto off = moved(T, 0.01 * Vector6d::Random());
    const FitPoint at{off, Eigen::Vector2d::Zero()};
    const auto equations = linearise(problem, at).value();
    for (int k = 0; k < 6; ++k) {
      const Vector6d h = kStep * Vector6d::Unit(k);
      const double numeric = (linearise(problem, {moved(off, h), at.size_deviation})->cost -
                              linearise(problem, {moved(off, -h), at.size_deviation})->cost) /
                             (2 * kStep);
      EXPECT_NEAR(numeric, equations.gradient(k), 1e-4 * (1.0 + std::abs(numeric))) << k;
    }
  }
}

TEST(Jacobians, YawByRotation) {
  std::mt19937 random(6);
  for (int trial = 0; trial < 50; ++trial) {
    const auto T = randomPose(random);
    const Eigen::Vector3d up(0.1, -0.9, 0.2);
    const auto yaw = relativeYaw(T.linear(), up);
    for (int k = 0; k < 3; ++k) {
      const Vector6d h = kStep * Vector6d::Unit(3 + k);
      const double numeric =
          (relativeYaw(moved(T, h).linear(), up).yaw_rad - relativeYaw(moved(T, -h).linear(), up).yaw_rad) /
          (2 * kStep);
      EXPECT_NEAR(numeric, yaw.by_rotation(k), 1e-6);
    }
  }
}

}  // namespace window_ingress::estimation::jacobians_test
