#include "navigation/motion/pending_yaw.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

namespace window_ingress::navigation::pending_yaw_test {

constexpr double kDtSec = 1.0 / 30.0, kGainHz = 3.0, kLimitRadps = 0.5;

/// Follows the heading that the commanded rates add up to, with delay and too little damping.
class Autopilot {
 public:
  Autopilot(double delay_sec, double natural_radps, double gain)
      : told_(static_cast<std::size_t>(delay_sec / kDtSec) + 1, 0.0),
        natural_radps_(natural_radps),
        gain_(gain) {}

  void follow(double rate_radps) {
    told_.push_back(gain_ * rate_radps);
    wanted_rad_ += kDtSec * told_.front();
    for (int i = 0; i < 10; ++i) {
      const double pull = natural_radps_ * natural_radps_ * (wanted_rad_ - heading_rad) +
                          0.8 * natural_radps_ * (told_.front() - rate_radps_);
      rate_radps_ += 0.1 * kDtSec * pull;
      heading_rad += 0.1 * kDtSec * rate_radps_;
    }
    told_.pop_front();
  }
  double heading_rad = 0.0;

 private:
  std::deque<double> told_;
  double natural_radps_, gain_, wanted_rad_ = 0.0, rate_radps_ = 0.0;
};

/// Largest heading error in the last two of eight seconds [rad].
double swing(Autopilot autopilot, bool counts_what_comes) {
  PendingYaw turn;
  double told_radps = 0.0, swing_rad = 0.0;
  for (double t_sec = 0.0; t_sec < 8.0; t_sec += kDtSec) {
    turn.update(autopilot.heading_rad, told_radps, kDtSec);
    const double error_rad = 0.4 - autopilot.heading_rad - (counts_what_comes ? turn.rad() : 0.0);
    told_radps = std::clamp(kGainHz * error_rad, -kLimitRadps, kLimitRadps);
    autopilot.follow(told_radps);
    if (t_sec > 6.0) swing_rad = std::max(swing_rad, std::abs(0.4 - autopilot.heading_rad));
  }
  return swing_rad;
}

TEST(PendingYaw, ALateAutopilotSwingsWithoutItAndStandsWithIt) {
  EXPECT_GT(swing({0.2, 5.0, 1.0}, false), 0.1);
  EXPECT_LT(swing({0.2, 5.0, 1.0}, true), 0.02);
}

TEST(PendingYaw, NeedsToKnowNeitherDelayNorGain) {
  for (const double delay_sec : {0.0, 0.1, 0.2, 0.3, 0.4}) {
    for (const double gain : {0.8, 1.0, 1.2}) {
      EXPECT_LT(swing({delay_sec, 6.0, gain}, true), 0.04) << delay_sec << " s, " << gain;
    }
  }
}

TEST(PendingYaw, IsWhatWasToldLessWhatWasTurned) {
  PendingYaw turn;
  for (int i = 0; i <= 10; ++i) turn.update(0.0, 0.5, 0.02);
  EXPECT_NEAR(turn.rad(), 0.1, 0.01);
  turn.update(0.1, 0.0, 0.02);
  EXPECT_NEAR(turn.rad(), 0.0, 0.01);
}

TEST(PendingYaw, IsForgottenWhenItDoesNotCome) {
  PendingYaw turn;
  for (int i = 0; i < 500; ++i) turn.update(0.0, 0.5, 0.02);
  EXPECT_LE(turn.rad(), 0.5);
  for (int i = 0; i < 500; ++i) turn.update(0.0, 0.0, 0.02);
  EXPECT_NEAR(turn.rad(), 0.0, 0.01);
}

TEST(PendingYaw, CountsAcrossHalfATurn) {
  PendingYaw turn;
  turn.update(3.13, 0.0, 0.02);
  turn.update(-3.13, 0.0, 0.02);
  EXPECT_NEAR(turn.rad(), -0.023, 0.001);
}

TEST(PendingYaw, IgnoresWhatIsNotFinite) {
  PendingYaw turn;
  turn.update(0.0, 0.0, 0.02);
  turn.update(std::numeric_limits<double>::quiet_NaN(), 0.0, 0.02);
  turn.update(0.0, std::numeric_limits<double>::infinity(), 0.02);
  EXPECT_EQ(turn.rad(), 0.0);
}

TEST(PendingYaw, AHeadingThatBeginsAnewIsNoTurn) {
  PendingYaw turn;
  turn.update(0.0, 0.0, 0.02);
  turn.reset();
  turn.update(1.0, 0.0, 0.02);
  EXPECT_EQ(turn.rad(), 0.0);
}

}  // namespace window_ingress::navigation::pending_yaw_test
