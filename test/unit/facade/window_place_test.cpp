#include "window_ingress/facade/window_place.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "window_row.hpp"

namespace window_ingress::facade::window_place_test {

Wall wallOfRow() { return {{0.0, 0.0, 1.5}, 0.0, 0.02, 0.01}; }

TEST(WindowPlace, LiesWhereTheSightsMeetTheWallWithinWhatItsCovarianceSays) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> at(-2.0, 2.0);
  const test::WindowRow row;
  double squares = 0.0;
  int seen = 0;
  for (int n = 0; n < 300; ++n) {
    const auto view = row.from({-5.0 + at(random), at(random), 1.5}, 0.2 * at(random));
    for (int i = 0; i < row.count; ++i) {
      const auto window = row.seen(i, view, random);
      if (!window) continue;
      const auto place = placeOf(window->corners, view, wallOfRow(), {0.5, 0.5});
      ASSERT_TRUE(place);
      ASSERT_TRUE(place->on_wall);
      const Eigen::Vector3d error = place->position_m - row.centre(i);
      squares += error.dot(place->covariance.ldlt().solve(error));
      EXPECT_NEAR(place->size.width_m, 1.2, 0.08);
      EXPECT_NEAR(place->size.height_m, 1.0, 0.08);
      ++seen;
    }
  }
  ASSERT_GT(seen, 300);
  EXPECT_LT(squares / seen, 3.0) << "three degrees of freedom: errors are not larger than stated";
}

TEST(WindowPlace, WithoutAWallIsAsFarAwayAsTheSizeLookedForSaysAndItsDistanceIsLittleKnown) {
  std::mt19937 random(2);
  const test::WindowRow row;
  const auto view = row.from({-5.0, -1.0, 1.5});
  const auto window = row.seen(1, view, random);
  ASSERT_TRUE(window);
  const auto right = placeOf(window->corners, view, std::nullopt, row.size);
  const auto half = placeOf(window->corners, view, std::nullopt, {0.6, 0.5});
  ASSERT_TRUE(right && half);
  EXPECT_FALSE(right->on_wall);
  EXPECT_LT((right->position_m - row.centre(1)).norm(), 0.3);
  EXPECT_NEAR((half->position_m - view.T_odom_camera.translation()).norm(), 2.55, 0.2);
  const Eigen::Vector3d sight = (row.centre(1) - view.T_odom_camera.translation()).normalized();
  EXPECT_GT(std::sqrt(sight.dot(right->covariance * sight)), 1.0);
  const Eigen::Vector3d aside(-sight.y(), sight.x(), 0.0);
  EXPECT_LT(std::sqrt(aside.dot(right->covariance * aside)), 0.1);
}

TEST(WindowPlace, OfAWallBehindOrSeenEdgeOnIsJudgedBySize) {
  std::mt19937 random(3);
  const test::WindowRow row;
  const auto view = row.from({-5.0, 0.0, 1.5});
  const auto window = row.seen(0, view, random);
  Wall behind = wallOfRow();
  behind.position_m.x() = -9.0;
  Wall edge_on = wallOfRow();
  edge_on.heading_rad = 1.57;
  for (const Wall& wall : {behind, edge_on}) {
    const auto place = placeOf(window->corners, view, wall, row.size);
    ASSERT_TRUE(place);
    EXPECT_FALSE(place->on_wall);
  }
}

TEST(WindowPlace, OfWhatIsNotFiniteOrHasNoHeightIsNone) {
  const auto view = test::WindowRow::from({-5.0, 0.0, 1.5});
  const Eigen::Vector2d point(300, 200);
  EXPECT_FALSE(placeOf({point, point, point, point}, view, std::nullopt, {1, 1}));
  const Eigen::Vector2d nan(std::numeric_limits<double>::quiet_NaN(), 0.0);
  EXPECT_FALSE(placeOf({nan, point, point, point}, view, wallOfRow(), {1, 1}));
}

TEST(WindowPlace, FusedIsNeverSurerThanItsBetterPartAndNeverWorse) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> sigma(0.01, 1.0);
  for (int n = 0; n < 200; ++n) {
    WindowPlace a, b;
    a.covariance = Eigen::Vector3d(sigma(random), sigma(random), sigma(random)).asDiagonal();
    b.covariance = Eigen::Vector3d(sigma(random), sigma(random), sigma(random)).asDiagonal();
    b.position_m = {0.1, 0.0, 0.0};
    const WindowPlace both = fused(a, b);
    EXPECT_LE(both.covariance.trace(), std::min(a.covariance.trace(), b.covariance.trace()) + 1e-12);
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_GE(both.covariance(axis, axis),
                std::min(a.covariance(axis, axis), b.covariance(axis, axis)) - 1e-12);
    EXPECT_GE(both.position_m.x(), -1e-12);
    EXPECT_LE(both.position_m.x(), 0.1 + 1e-12);
  }
}

}  // namespace window_ingress::facade::window_place_test
