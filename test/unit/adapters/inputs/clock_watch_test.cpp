#include "adapters/inputs/clock_watch.hpp"

#include <gtest/gtest.h>

namespace window_ingress::adapters::clock_watch_test {

TEST(ClockWatch, NoticesEachJumpBackOnce) {
  ClockWatch clock;
  EXPECT_FALSE(clock.jumpedBack(100.0));
  EXPECT_FALSE(clock.jumpedBack(99.95)) << "jitter is no jump";
  EXPECT_FALSE(clock.jumpedBack(1050.0)) << "forward is no jump back";
  EXPECT_TRUE(clock.jumpedBack(999.0));
  EXPECT_FALSE(clock.jumpedBack(999.1));
}

}  // namespace window_ingress::adapters::clock_watch_test
