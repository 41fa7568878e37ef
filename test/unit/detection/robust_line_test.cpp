#include "window_ingress/detection/robust_line.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace window_ingress::detection {
namespace {

using Eigen::Vector2d;

/// Points along a line through (50, 20) at this angle, with noise across it and every n-th one far off.
std::vector<Vector2d> pointsOn(double angle_rad, double sigma_px, int outlier_every, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, sigma_px);
  const Vector2d along(std::cos(angle_rad), std::sin(angle_rad)), normal(-along.y(), along.x());
  std::vector<Vector2d> points;
  for (int i = -40; i <= 40; ++i) {
    const bool is_outlier = outlier_every > 0 && i % outlier_every == 0;
    points.push_back(Vector2d(50, 20) + i * along + (is_outlier ? 6.0 : noise(random)) * normal);
  }
  return points;
}

Line startAt(const Vector2d& point, double angle_rad) {
  Line line;
  line.point = point;
  line.normal = Vector2d(-std::sin(angle_rad), std::cos(angle_rad));
  return line;
}

TEST(RobustLine, IsExactWithoutNoiseAtEveryAngle) {
  for (double angle = -1.5; angle < 1.5; angle += 0.1) {
    Line line = startAt({50.3, 20.5}, angle + 0.02);
    fitRobustLine(pointsOn(angle, 0.0, 0, 1), 1.0, line);
    EXPECT_NEAR(line.distance({50, 20}), 0.0, 1e-9);
    EXPECT_NEAR(line.distance(Vector2d(50, 20) + 30 * Vector2d(std::cos(angle), std::sin(angle))), 0.0, 1e-9);
    EXPECT_NEAR(line.normal.norm(), 1.0, 1e-12);
  }
}

TEST(RobustLine, OutliersOnOneSideDoNotPull) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    Line line = startAt({50, 20.5}, 0.03);
    const auto points = pointsOn(0.0, 0.1, 4, seed);
    fitRobustLine(points, 0.5, line);
    EXPECT_NEAR(line.distance({50, 20}), 0.0, 0.06);
    EXPECT_EQ(spreadAbout(line, points, 0.5).inliers, 60);  // of 81, 21 are outliers
  }
}

TEST(RobustLine, KeepsTheSideOfItsNormal) {
  Line line = startAt({50, 20}, 0.0);
  line.normal = -line.normal;
  fitRobustLine(pointsOn(0.05, 0.0, 0, 1), 1.0, line);
  EXPECT_LT(line.normal.y(), 0.0);
}

TEST(RobustLine, TooFewPointsLeaveTheStart) {
  Line line = startAt({1, 2}, 0.5);
  fitRobustLine({}, 1.0, line);
  fitRobustLine({Vector2d(9, 9)}, 1.0, line);
  EXPECT_EQ(line.point, Vector2d(1, 2));
  EXPECT_EQ(spreadAbout(line, {}, 1.0).inliers, 0);
}

}  // namespace
}  // namespace window_ingress::detection
