#include "window_ingress/geometry/pinhole_camera.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <random>

namespace window_ingress::geometry::pinhole_camera_test {

PinholeCamera distortedCamera() {
  PinholeCamera camera = PinholeCamera::fromFieldOfView(640, 480, 1.2);
  camera.distortion = {-0.28, 0.09, 0.0007, -0.0004, -0.01};
  return camera;
}

TEST(PinholeCamera, CentredPrincipalPointFollowsIntegerPixelCentres) {
  const PinholeCamera camera = PinholeCamera::fromFieldOfView(640, 480, 1.2);
  EXPECT_DOUBLE_EQ(camera.cx, 319.5);
  EXPECT_DOUBLE_EQ(camera.cy, 239.5);
  // The image's left border lies half a pixel left of the first pixel's centre, at half the field of view.
  EXPECT_NEAR(camera.project({-std::tan(0.6), 0, 1})->x(), -0.5, 1e-9);
}

TEST(PinholeCamera, ProjectsAsOpenCvDoes) {
  const PinholeCamera camera = distortedCamera();
  const cv::Matx33d K(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  const std::vector<double> D(camera.distortion.begin(), camera.distortion.end());
  std::mt19937 random(2);
  std::uniform_real_distribution<double> side(-2, 2), depth(3, 9);
  for (int i = 0; i < 200; ++i) {
    const cv::Point3d p(side(random), side(random), depth(random));
    std::vector<cv::Point2d> expected;
    cv::projectPoints(std::vector<cv::Point3d>{p}, cv::Vec3d(), cv::Vec3d(), K, D, expected);
    const auto pixel = camera.project({p.x, p.y, p.z});
    ASSERT_TRUE(pixel);
    EXPECT_NEAR(pixel->x(), expected[0].x, 1e-9);
    EXPECT_NEAR(pixel->y(), expected[0].y, 1e-9);
  }
}

TEST(PinholeCamera, UndistortInvertsDistortAllOverTheImage) {
  const PinholeCamera camera = distortedCamera();
  for (int v = 0; v < 480; v += 20)
    for (int u = 0; u < 640; u += 20)
      EXPECT_LT((camera.distort(camera.undistort({u, v})) - Eigen::Vector2d(u, v)).norm(), 1e-6);
}

PinholeCamera fisheye() {
  PinholeCamera camera = PinholeCamera::fromFieldOfView(640, 480, 1.6);
  camera.model = LensModel::kEquidistant;
  camera.distortion = {-0.02, 0.01, -0.004, 0.0007, 0.0};
  return camera;
}

TEST(PinholeCamera, AFisheyeIsUndoneAllOverTheImage) {
  const PinholeCamera camera = fisheye();
  for (int v = 0; v < 480; v += 20)
    for (int u = 0; u < 640; u += 20) {
      EXPECT_LT((camera.distort(camera.undistort({u, v})) - Eigen::Vector2d(u, v)).norm(), 1e-6);
      EXPECT_LT((*camera.project(3.0 * camera.ray({u, v})) - Eigen::Vector2d(u, v)).norm(), 1e-6);
    }
  EXPECT_TRUE(camera.hasDistortion());
  EXPECT_FALSE(camera.withoutDistortion().hasDistortion());
  const Eigen::Vector2d centre(camera.cx, camera.cy);
  EXPECT_EQ(camera.undistort(centre), centre);
  EXPECT_EQ(camera.distort(centre), centre);
}

TEST(PinholeCamera, TellsHowWideAPixelIsAcrossALine) {
  PinholeCamera camera = PinholeCamera::fromFieldOfView(640, 480, 1.6);
  EXPECT_EQ(camera.pixelAcross({700, 100}, {3, 4}), 1.0);
  camera.model = LensModel::kEquidistant;
  const double angle = M_PI / 3.0;
  const Eigen::Vector2d off(camera.cx + camera.fx * std::tan(angle), camera.cy);
  EXPECT_NEAR(camera.pixelAcross(off, {0, 2}), 4.0, 1e-3) << "about the axis";
  EXPECT_NEAR(camera.pixelAcross(off, {5, 0}), std::tan(angle) / angle, 1e-3) << "away from it";
  // A line and a parallel one, one image pixel beside it, at any slant.
  for (const Eigen::Vector2d& along : {Eigen::Vector2d(1, 2), Eigen::Vector2d(-3, 1)}) {
    const Eigen::Vector2d unit = along.normalized(), across(-unit.y(), unit.x());
    const double pixel = camera.pixelAcross(off, along);
    const Eigen::Vector2d way = camera.distort(off + 5 * unit) - camera.distort(off - 5 * unit);
    const Eigen::Vector2d moved = camera.distort(off + pixel * across) - camera.distort(off);
    EXPECT_NEAR(std::abs(way.x() * moved.y() - way.y() * moved.x()) / way.norm(), 1.0, 0.02);
  }
}

TEST(PinholeCamera, AFisheyeSeesNothingSidewaysAndStaysFinite) {
  PinholeCamera camera = fisheye();
  EXPECT_TRUE(camera.undistort({1e5, 240.0}).allFinite());
  EXPECT_LT(std::acos(camera.ray({1e5, 240.0}).z()), 1.5 + 1e-9);
  for (const double odd : {-0.9, 5.0, 1e300}) {  // not monotonic
    camera.distortion = {odd, -odd, odd, -odd, 0.0};
    EXPECT_TRUE(camera.undistort({10.0, 10.0}).allFinite()) << odd;
  }
}

TEST(PinholeCamera, RayGoesThroughItsPixel) {
  const PinholeCamera camera = distortedCamera();
  const Eigen::Vector3d ray = camera.ray({100, 60});
  EXPECT_NEAR(ray.norm(), 1.0, 1e-12);
  EXPECT_LT((*camera.project(7.0 * ray) - Eigen::Vector2d(100, 60)).norm(), 1e-6);
}

TEST(PinholeCamera, NothingBehindTheCameraIsProjected) {
  const PinholeCamera camera = PinholeCamera::fromFieldOfView(640, 480, 1.2);
  EXPECT_FALSE(camera.project({0, 0, -1}));
  EXPECT_FALSE(camera.project({1, 0, 0}));
  EXPECT_FALSE(camera.project({0, 0, std::numeric_limits<double>::quiet_NaN()}));
}

TEST(PinholeCamera, ValidateNamesEveryFault) {
  EXPECT_TRUE(distortedCamera().validate().empty());
  EXPECT_EQ(PinholeCamera{}.validate().size(), 2u);  // no size, no K
  EXPECT_NE(PinholeCamera{}.validate()[1].find("uncalibrated"), std::string::npos);
  PinholeCamera camera = distortedCamera();
  camera.fx = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(camera.validate().size(), 1u);
  camera = distortedCamera();
  camera.fy = -camera.fy;
  EXPECT_EQ(camera.validate().size(), 1u);
  camera = distortedCamera();
  camera.distortion[1] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(camera.validate().size(), 1u);
  for (const double odd : {1e-3, 1e-300, 1e7, 1e300}) {
    camera = distortedCamera();
    camera.fx = odd;
    EXPECT_EQ(camera.validate().size(), 1u) << odd;
  }
  camera = distortedCamera();
  camera.cy = -1e9;
  EXPECT_EQ(camera.validate().size(), 1u);
}

TEST(PinholeCamera, ARayHasLengthOneHoweverFarAside) {
  PinholeCamera camera = distortedCamera();
  camera.distortion = {};
  for (const double aside : {1e5, 1e100, 1e200, 1e300})
    EXPECT_NEAR(camera.ray({aside, -aside}).norm(), 1.0, 1e-12) << aside;
}

}  // namespace window_ingress::geometry::pinhole_camera_test
