#include "window_ingress/geometry/image_border.hpp"

#include <gtest/gtest.h>

namespace window_ingress::geometry::image_border_test {

using Eigen::Vector2d;

TEST(ImageBorder, PixelCentresOfTheFirstAndLastRowsLieInside) {
  for (const Vector2d& pixel : {Vector2d(0, 0), Vector2d(639, 0), Vector2d(0, 479), Vector2d(639, 479)}) {
    EXPECT_TRUE(isInside(pixel, 640, 480));
    EXPECT_FALSE(isInside(pixel, 640, 480, 0.5));
    EXPECT_EQ(distanceToBorder(pixel, 640, 480), 0.0);
  }
  EXPECT_FALSE(isInside({639.5, 100}, 640, 480));
  EXPECT_FALSE(isInside({100, -0.5}, 640, 480));
  EXPECT_TRUE(isInside({100, 5}, 640, 480, 5.0));
}

TEST(ImageBorder, TheOutermostCornerCounts) {
  const Quadrilateral quad{Vector2d(100, 50), Vector2d(630, 40), Vector2d(620, 300), Vector2d(90, 310)};
  EXPECT_EQ(distanceToBorder(quad, 640, 480), 9.0);
  Quadrilateral cut = quad;
  cut[3] = {-3, 310};
  EXPECT_EQ(distanceToBorder(cut, 640, 480), -3.0);
}

}  // namespace window_ingress::geometry::image_border_test
