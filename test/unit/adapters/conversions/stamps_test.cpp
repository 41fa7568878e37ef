#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "adapters/conversions/msg_conversion.hpp"

namespace window_ingress::adapters::stamps_test {

TEST(Stamps, ZeroAndUnnormalisedAreNoStamps) {
  EXPECT_FALSE(stampSec(ros::Time()));
  ros::Time odd(5, 0);
  odd.nsec = 4000000000u;
  EXPECT_FALSE(stampSec(odd));
  EXPECT_DOUBLE_EQ(*stampSec(ros::Time(5, 250000000)), 5.25);
}

TEST(Stamps, SecondsGoThereAndBack) {
  for (const double sec : {0.0, 1e-9, 0.9999999999, 1700000000.123456, 4294967294.5})
    EXPECT_NEAR(toStamp(sec).toSec(), sec, 1e-6) << sec;
  for (const double sec : {-1.0, 1e10, std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_TRUE(toStamp(sec).isZero()) << sec;
}

}  // namespace window_ingress::adapters::stamps_test
