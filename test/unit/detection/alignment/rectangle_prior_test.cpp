#include "detection/alignment/rectangle_prior.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "detection/alignment/ring_view.hpp"

namespace window_ingress::detection::rectangle_prior_test {

constexpr double kAspect = 1.3;

geometry::PinholeCamera camera() { return geometry::PinholeCamera::fromFieldOfView(640, 480, 1.2); }

// Map of a rectangle of that aspect, seen from the side.
Eigen::Matrix3d mapOf(double aspect, double skew) {
  const Eigen::Matrix3d R =
      (Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitY()) * Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitX()) *
       Eigen::AngleAxisd(-0.1, Eigen::Vector3d::UnitZ()))
          .toRotationMatrix();
  Eigen::Matrix3d view;
  view << aspect * R.col(0), R.col(1) + skew * R.col(0), Eigen::Vector3d(0.3, -0.2, 4.0);
  return camera().K() * view;
}

struct Shape {
  double log_aspect, skew;
};
Shape shapeOf(const Eigen::Matrix3d& map) {
  const Eigen::Matrix3d view = camera().K().inverse() * map;
  return {std::log(view.col(0).norm() / view.col(1).norm()),
          view.col(0).normalized().dot(view.col(1).normalized())};
}

// One step of the prior, with almost no other information.
Eigen::Matrix3d stepped(const Eigen::Matrix3d& map) {
  Matrix8f normal = 1e-3F * Matrix8f::Identity();
  Vector8f right = Vector8f::Zero();
  RectanglePrior(camera(), {kAspect, 0.01}).addTo(map, 1.0, normal, right);
  return map * homographyOf(normal.ldlt().solve(right))->inverse();
}

TEST(RectanglePrior, AViewOfTheRectangleStaysAsItIs) {
  const Eigen::Matrix3d map = mapOf(kAspect, 0.0);
  EXPECT_LT((stepped(map) - map).cwiseAbs().maxCoeff(), 1e-3 * map.cwiseAbs().maxCoeff());
}

TEST(RectanglePrior, AspectAndSkewGoBack) {
  for (double aspect : {kAspect * 0.95, kAspect * 1.05})
    for (double skew : {-0.05, 0.05}) {
      const Shape before = shapeOf(mapOf(aspect, skew)),
                  after = shapeOf(stepped(stepped(stepped(mapOf(aspect, skew)))));
      EXPECT_LT(std::abs(after.log_aspect - std::log(kAspect)),
                0.1 * std::abs(before.log_aspect - std::log(kAspect)));
      EXPECT_LT(std::abs(after.skew), 0.1 * std::abs(before.skew));
    }
}

TEST(RectanglePrior, WhatAPoseMayChangeCostsNothing) {
  Matrix8f normal = Matrix8f::Zero();
  Vector8f right = Vector8f::Zero();
  RectanglePrior(camera(), {kAspect, 0.01}).addTo(mapOf(kAspect, 0.0), 1.0, normal, right);
  const Eigen::SelfAdjointEigenSolver<Matrix8f> eigen(normal);
  EXPECT_LT(eigen.eigenvalues()[5], 1e-4F * eigen.eigenvalues()[6]) << "six of eight are free";
}

TEST(RectanglePrior, TellsHowFarAViewIsFromThoseOfTheRectangle) {
  const RectanglePrior prior(camera(), {kAspect, 0.01});
  EXPECT_LT(prior.misfit(mapOf(kAspect, 0.0)), 1e-6);
  EXPECT_NEAR(prior.misfit(mapOf(1.05 * kAspect, 0.0)), std::log(1.05) / 0.01, 1e-3);
  EXPECT_GT(prior.misfit(mapOf(kAspect, 0.03)), 9.0);
}

// The left side was placed on something within the opening.
TEST(RectanglePrior, ASideIsPlacedByTheThreeOthers) {
  const RectanglePrior prior(camera(), {kAspect, 0.01});
  const geometry::Quadrilateral truth = *cornersOf(mapOf(kAspect, 0.0));
  geometry::Quadrilateral seen = truth;
  seen[0] += 0.1 * (truth[1] - truth[0]), seen[3] += 0.1 * (truth[2] - truth[3]);
  const auto view = prior.completed(mapFromCentre(seen), 3);
  ASSERT_TRUE(view);
  const geometry::Quadrilateral whole = *cornersOf(view->map);
  for (int i = 0; i < 4; ++i) EXPECT_LT((whole[i] - truth[i]).norm(), 0.2) << i;
  EXPECT_LT(view->sigma_px, 0.02 * (truth[3] - truth[0]).norm());
  EXPECT_FALSE(prior.completed(mapFromCentre(truth), 2))
      << "how far it is turned shows in the heights of two sides, which end at the one that is hidden";
}

// Seen from the front, a rectangle is consistent with every focal length. Foreshortened, its perspective
// depends on it.
TEST(RectanglePrior, WithoutACalibrationAForeshortenedViewSaysLess) {
  const auto told = [](const RectanglePrior& prior, const Eigen::Matrix3d& map) {
    Matrix8f normal = Matrix8f::Zero();
    Vector8f right = Vector8f::Zero();
    prior.addTo(map, 1.0, normal, right);
    return Eigen::SelfAdjointEigenSolver<Matrix8f>(normal).eigenvalues()[6];  // the less certain of the two
  };
  Eigen::Matrix3d frontal = Eigen::Matrix3d::Identity();
  frontal(0, 0) = kAspect, frontal(2, 2) = 4.0;
  const RectanglePrior calibrated(camera(), {kAspect, 0.01}), guessed(cv::Size(640, 480), {kAspect, 0.01});
  const Eigen::Matrix3d from_the_front = camera().K() * frontal, from_the_side = mapOf(kAspect, 0.0);
  EXPECT_GT(told(guessed, from_the_front), 0.9F * told(calibrated, from_the_front));
  EXPECT_LT(told(guessed, from_the_side), 0.1F * told(calibrated, from_the_side));
}

// Seen from in front of its right side, a little above its top.
TEST(RectanglePrior, TellsFromWhereEachSideIsSeen) {
  Eigen::Matrix3d view;
  view << kAspect, 0, -0.5 * kAspect, 0, 1, 0.6, 0, 0, 2.0;
  const auto sides = RectanglePrior(camera(), {kAspect, 0.01}).viewsOfSides(camera().K() * view);
  const double tangents[] = {0.05, 0.0, 0.55, 0.5 * kAspect};
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(sides[i].tangent, tangents[i], 1e-9) << i;
  EXPECT_TRUE(sides[0].from_beyond);
  for (int i = 1; i < 4; ++i) EXPECT_FALSE(sides[i].from_beyond) << i;
}

}  // namespace window_ingress::detection::rectangle_prior_test
