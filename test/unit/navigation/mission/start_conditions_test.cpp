#include "navigation/mission/start_conditions.hpp"

#include <gtest/gtest.h>

#include "window_ingress/text/text.hpp"

namespace window_ingress::navigation::start_conditions_test {

TEST(StartConditions, AMissionThatWouldEndInTheOpeningIsRefused) {
  NavigatorParams params;
  EXPECT_NO_THROW(checked(params));
  params.commit.exit_distance_m = 1.9 * params.vehicle.half_length_m;
  EXPECT_THROW(checked(params), std::invalid_argument);
}

// The time without sight of the window, and what may happen meanwhile, follow from this speed.
TEST(StartConditions, TheWayThroughIsReckonedWithTheSpeedThatIsAllowed) {
  NavigatorParams params;
  params.limits.speed_mps = 0.4;
  EXPECT_EQ(checked(params).commit.speed_mps, 0.4);
}

}  // namespace window_ingress::navigation::start_conditions_test
