#include "estimation/planar/homography.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "../pose_fixtures.hpp"

namespace window_ingress::estimation::homography_test {

using namespace fixtures;

const geometry::PinholeCamera kUnit = [] {
  geometry::PinholeCamera camera;
  camera.fx = camera.fy = 1.0;
  return camera;
}();

TEST(Homography, MapsThePlaneOntoTheImage) {
  const auto T = view(4.0, 0.6, 0.5, -0.3);
  const auto image = geometry::projectOpening(kUnit, T, kOpening).value();
  const auto H = windowHomography(image, kOpening);
  ASSERT_TRUE(H);
  const double x[] = {-0.6, 0.6, 0.6, -0.6}, y[] = {-0.5, -0.5, 0.5, 0.5};
  for (int i = 0; i < 4; ++i)
    EXPECT_LT(((*H * Eigen::Vector3d(x[i], y[i], 1.0)).hnormalized() - image[i]).norm(), 1e-12);
}

TEST(Homography, GivesBackExactPoses) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 500; ++i) {
    auto T = view(5.0 + 3.0 * unit(random), unit(random), unit(random), unit(random));
    T.linear() = T.linear() * geometry::rotationFromEuler({unit(random), 0.5 * unit(random), 0.0});
    const auto image = geometry::projectOpening(kUnit, T, kOpening);
    if (!image) continue;
    const auto H = windowHomography(*image, kOpening);
    ASSERT_TRUE(H);
    for (const double sign : {1.0, -1.0}) {
      const auto pose = poseFromHomography(sign * *H);
      ASSERT_TRUE(pose);
      EXPECT_TRUE(pose->isApprox(T, 1e-8)) << "the scale has no sign of its own: t_z > 0 decides";
    }
  }
}

TEST(Homography, RotationIsOneUnderNoise) {
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i) {
    auto window = cornersSeen(kUnit, view(4.0, 0.3), 1.0);
    disturb(window, 0.01, random);
    const auto H = windowHomography(window.corners, kOpening);
    ASSERT_TRUE(H);
    const auto pose = poseFromHomography(*H);
    ASSERT_TRUE(pose);
    EXPECT_TRUE(pose->linear().isUnitary(1e-9));
    EXPECT_NEAR(pose->linear().determinant(), 1.0, 1e-9);
  }
}

TEST(Homography, RefusesDegenerateCorners) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Eigen::Vector2d a(0, 0), b(1, 0), c(1, 1);
  EXPECT_FALSE(windowHomography({Eigen::Vector2d(nan, 0), b, c, a}, kOpening));
  EXPECT_FALSE(windowHomography({a, a, a, a}, kOpening));
  EXPECT_FALSE(windowHomography({a, 0.3 * b, 0.6 * b, b}, kOpening));
  EXPECT_FALSE(windowHomography({a, 0.5 * b, b, c}, kOpening));
  EXPECT_FALSE(windowHomography({a, b, b, c}, kOpening));
  EXPECT_FALSE(poseFromHomography(Eigen::Matrix3d::Zero()));
  EXPECT_FALSE(poseFromHomography(Eigen::Matrix3d::Constant(nan)));
}

}  // namespace window_ingress::estimation::homography_test
