#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "window_ingress/geometry/euler_angles.hpp"

namespace window_ingress::geometry::yaw_text_test {

TEST(YawText, IsInDegreesWithSpreadAndDoubt) {
  const double degree = M_PI / 180.0;
  EXPECT_EQ(yawText(12.34 * degree, 0.4 * degree, true), "yaw +12.3 +-0.4 deg");
  EXPECT_EQ(yawText(-3.0 * degree, 2.5 * degree, false), "yaw -3.0 +-2.5 deg, sign unknown");
  EXPECT_EQ(yawText(-0.123 * degree, 0.03 * degree, true), "yaw -0.12 +-0.03 deg");
}

TEST(YawText, SurvivesBadNumbers) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = INFINITY;
  EXPECT_EQ(yawText(nan, 0.1, true), "yaw not finite");
  EXPECT_EQ(yawText(0.1, infinite, true), "yaw not finite");
  EXPECT_EQ(yawText(0.0, 1e9, false), "yaw +0.0 +-180.0 deg, sign unknown");
}

}  // namespace window_ingress::geometry::yaw_text_test
