#include "window_ingress/openness/plane_parallax.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/geometry/opening.hpp"

namespace window_ingress::openness::plane_parallax_test {

using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

const geometry::OpeningSize kOpening{1.2, 1.0};
const auto kCamera = geometry::PinholeCamera::fromFieldOfView(640, 480, 1.2);

Isometry3d anyCamera(std::mt19937& random, double distance_m) {
  std::uniform_real_distribution<double> aside(-0.4, 0.4), turn(-0.15, 0.15);
  const Eigen::Matrix3d look = (Eigen::AngleAxisd(turn(random), Vector3d::UnitZ()) *
                                Eigen::AngleAxisd(turn(random), Vector3d::UnitY()) *
                                Eigen::AngleAxisd(turn(random), Vector3d::UnitX()))
                                   .toRotationMatrix();
  return geometry::makePose(look * geometry::R_optical_flu().transpose(),
                            {-distance_m, aside(random), aside(random)});
}

SeenBorder borderFrom(const Isometry3d& T_window_camera) {
  SeenBorder border;
  border.corners = *geometry::projectOpening(kCamera, T_window_camera.inverse(), kOpening);
  border.covariance.fill(0.01 * Eigen::Matrix2d::Identity());
  return border;
}

std::optional<PlaneParallax> pairOf(const Isometry3d& key, const Isometry3d& now) {
  return PlaneParallax::between(kCamera, borderFrom(key), borderFrom(now), key.inverse(), now.inverse(), {});
}

Vector2d pixel(const Isometry3d& T_window_camera, const Vector3d& point) {
  return *kCamera.project(T_window_camera.inverse() * point);
}

TEST(PlaneParallax, recoversTheDepthOfAnyPointExactly) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> near(1.5, 3.0), more(0.2, 2.0), across(-0.4, 0.4), deep(0.0, 12.0);
  for (int i = 0; i < 20000; ++i) {
    const double now_m = near(random), key_m = now_m + more(random),
                 depth_m = i % 4 == 0 ? 0.0 : deep(random);
    const Isometry3d key = anyCamera(random, key_m), now = anyCamera(random, now_m);
    const Vector3d front(0.0, across(random), across(random));
    const Vector3d way = (front - key.translation()) / key_m;
    const Vector3d point = front + depth_m * way;
    const auto pair = pairOf(key, now);
    ASSERT_TRUE(pair);
    EXPECT_NEAR(pair->distanceM(), key_m, 1e-9);
    const auto parallax = pair->of(pixel(key, point), pixel(now, point));
    if (!parallax) continue;  // no depth would move this point
    EXPECT_NEAR(parallax->part, depth_m / (key_m + depth_m), 1e-6);
    EXPECT_NEAR(parallax->across_px, 0.0, 1e-6);
    EXPECT_GT(parallax->part_sigma, 0.0);
  }
}

TEST(PlaneParallax, isNotMovedByErrorsOfAttitude) {
  std::mt19937 random(2);
  const Isometry3d key = anyCamera(random, 4.0), now = anyCamera(random, 2.5);
  const Isometry3d turned = now * Isometry3d(Eigen::AngleAxisd(0.02, Vector3d::UnitY()));
  const auto pair =
      PlaneParallax::between(kCamera, borderFrom(key), borderFrom(now), key.inverse(), turned.inverse(), {});
  ASSERT_TRUE(pair);
  const Vector3d in_plane(0.0, 0.3, 0.2), behind(3.0, 0.3, 0.2);
  EXPECT_NEAR(pair->of(pixel(key, in_plane), pixel(now, in_plane))->part, 0.0, 1e-9);
  EXPECT_NEAR(pair->of(pixel(key, behind), pixel(now, behind))->part, 3.0 / 7.0, 0.05);
}

TEST(PlaneParallax, statesItsErrors) {
  std::mt19937 random(3);
  std::normal_distribution<double> unit;
  const double flow_px = 0.35, corner_px = 0.3;
  double squares = 0.0;
  const int kTrials = 4000;
  for (int i = 0; i < kTrials; ++i) {
    const Isometry3d key = anyCamera(random, 4.0), now = anyCamera(random, 2.8);
    SeenBorder seen_key = borderFrom(key), seen_now = borderFrom(now);
    for (SeenBorder* border : {&seen_key, &seen_now})
      for (int k = 0; k < 4; ++k) {
        border->corners[k] += corner_px * Vector2d(unit(random), unit(random));
        border->covariance[k] = corner_px * corner_px * Eigen::Matrix2d::Identity();
      }
    const auto pair = PlaneParallax::between(kCamera, seen_key, seen_now, key.inverse(), now.inverse(),
                                             {0.0, 0.0, flow_px});
    ASSERT_TRUE(pair);
    const Vector3d point(2.0, 0.25, -0.2);
    const auto parallax =
        pair->of(pixel(key, point), pixel(now, point) + flow_px * Vector2d(unit(random), unit(random)));
    ASSERT_TRUE(parallax);
    squares += std::pow((parallax->part - 2.0 / 6.0) / parallax->part_sigma, 2) / kTrials;
  }
  EXPECT_GT(squares, 0.7);
  EXPECT_LT(squares, 1.3);
}

TEST(PlaneParallax, refusesWhatCannotBeUsed) {
  std::mt19937 random(4);
  const Isometry3d key = anyCamera(random, 4.0), now = anyCamera(random, 2.5);
  EXPECT_FALSE(pairOf(key, key)->of({300, 200}, {300, 200})) << "no way flown";
  const auto pair = pairOf(key, now);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(pair->of({nan, 200}, {300, 200}));
  EXPECT_FALSE(pair->of({300, 200}, {300, std::numeric_limits<double>::infinity()}));
  SeenBorder flat = borderFrom(key);
  flat.corners[2] = flat.corners[0];
  EXPECT_FALSE(PlaneParallax::between(kCamera, flat, borderFrom(now), key.inverse(), now.inverse(), {}));
  flat.corners[2] = {nan, nan};
  EXPECT_FALSE(PlaneParallax::between(kCamera, flat, borderFrom(now), key.inverse(), now.inverse(), {}));
  Isometry3d broken = now.inverse();
  broken.translation().x() = nan;
  EXPECT_FALSE(PlaneParallax::between(kCamera, borderFrom(key), borderFrom(now), key.inverse(), broken, {}));
  Isometry3d behind(geometry::R_optical_flu());
  behind.translation() = Vector3d(0.0, 0.0, -1.0);
  EXPECT_FALSE(PlaneParallax::between(kCamera, borderFrom(key), borderFrom(now), behind, now.inverse(), {}));
}

}  // namespace window_ingress::openness::plane_parallax_test
