#include "window_ingress/estimation/sender_clock.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace window_ingress::estimation::sender_clock_test {

constexpr double kPeriodSec = 1.0 / 30.0;

TEST(SenderClock, LeavesStampsThatAreNotAheadAsTheyAre) {
  SenderClock clock;
  for (const double late_sec : {0.0, 0.05, 0.2, -0.5 * SenderClock::kUsualSec}) {
    EXPECT_EQ(clock.atReceiver(100.0, 100.0 + late_sec), 100.0) << late_sec;
  }
  EXPECT_EQ(clock.aheadSec(), 0.0);
}

// Like the stamps of PX4 behind MAVROS: 84 to 164 ms ahead of their arrival.
TEST(SenderClock, TakesBackWhatIsAheadWithoutTheJitterOfTheWay) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> way_sec(0.01, 0.09);
  SenderClock clock;
  double worst_sec = 0.0;
  for (int i = 0; i < 900; ++i) {
    const double measured_sec = 100.0 + i * kPeriodSec, arrival_sec = measured_sec + way_sec(random);
    const double stamp_sec = clock.atReceiver(measured_sec + 0.174, arrival_sec);
    EXPECT_LE(stamp_sec, arrival_sec);
    if (i > 60) worst_sec = std::max(worst_sec, std::abs(stamp_sec - measured_sec));
  }
  EXPECT_LT(worst_sec, 0.02);
  EXPECT_NEAR(clock.aheadSec(), 0.164, 0.01);
}

TEST(SenderClock, ForgetsSlowlyAndIgnoresWhatIsNoNumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  SenderClock clock;
  clock.atReceiver(100.1, 100.0);
  EXPECT_TRUE(std::isnan(clock.atReceiver(nan, 101.0)));
  EXPECT_EQ(clock.atReceiver(101.0, nan), 101.0);
  EXPECT_EQ(clock.atReceiver(1e6, 100.0), 1e6);
  EXPECT_NEAR(clock.aheadSec(), 0.1, 1e-9);
  for (double t = 101.0; t < 201.0; t += kPeriodSec) clock.atReceiver(t, t);
  EXPECT_NEAR(clock.aheadSec(), 0.08, 0.005);
}

}  // namespace window_ingress::estimation::sender_clock_test
