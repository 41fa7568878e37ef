#include "window_ingress/estimation/clock_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace window_ingress::estimation::clock_check_test {

/// A vehicle turns towards a window 4 m ahead, stands, and turns a little further; 20 images a second.
struct Turning {
  double late_sec = 0.0, sideways_mps = 0.0, believed_off_m = 0.0;
  bool learns = false;  // the window's place, from what is seen
  std::mt19937 random{5};
  ClockCheck check;

  static double rate(double t) {  // yaw rate; it takes 0.3 s to change
    const double phase = std::fmod(t, 3.0);
    return 0.5 * std::clamp((1.5 - phase) / 0.3, 0.0, 1.0);
  }
  void fly(double seconds) {
    std::normal_distribution<double> noise(0.0, 0.002);
    for (double t = 0.0; t < seconds; t += 0.05) {
      const Eigen::Vector2d position(0.0, sideways_mps * t);
      const double true_azimuth = std::atan2(-position.y(), 4.0);
      const double turned_late = 0.5 * late_sec * (rate(t) + rate(t - late_sec));
      check.see({t, position, {0.0, sideways_mps}, true_azimuth + turned_late + noise(random), rate(t)},
                {4.0, believed_off_m + (learns ? 4.0 * std::tan(turned_late) : 0.0)});
    }
  }
};

TEST(ClockCheck, FindsHowLateImagesAreStamped) {
  for (const double late_sec : {-0.2, -0.1, 0.0, 0.05, 0.1, 0.2}) {
    Turning turning;
    turning.late_sec = late_sec;
    turning.fly(6.0);
    ASSERT_TRUE(turning.check.offset()) << late_sec;
    EXPECT_NEAR(turning.check.offset()->late_sec, late_sec, 0.03 + 0.2 * std::abs(late_sec));
    EXPECT_LT(turning.check.offset()->sigma_sec, 0.03);
  }
}

TEST(ClockCheck, IsNotLedAstrayByTheWayFlownOrAPlaceSlightlyWrong) {
  for (const double sideways_mps : {-0.5, 0.5})
    for (const double believed_off_m : {-0.2, 0.2}) {
      Turning turning;
      turning.sideways_mps = sideways_mps;
      turning.believed_off_m = believed_off_m;
      turning.fly(6.0);
      ASSERT_TRUE(turning.check.offset());
      EXPECT_NEAR(turning.check.offset()->late_sec, 0.0, 0.045);
    }
}

// A vehicle that flies aside turns with the window: only its turn relative to the window tells how late
// stamps are. Its position slides by 0.1 m/s meanwhile.
TEST(ClockCheck, TellsAFlightAsideFromLateStamps) {
  for (const double late_sec : {0.0, 0.1}) {
    ClockCheck check;
    for (double t = 0.0; t < 8.0; t += 0.05) {
      const double speed_mps = std::sin(1.5 * t), y_m = (1.0 - std::cos(1.5 * t)) / 1.5;
      const double facing_radps = -4.0 * speed_mps / (16.0 + y_m * y_m);
      const double aside_radps = 0.15 * std::sin(4.0 * t);
      check.see({t,
                 {0.0, y_m + 0.1 * t},
                 {0.0, speed_mps},
                 std::atan2(-y_m, 4.0) + late_sec * aside_radps,
                 facing_radps + aside_radps},
                {4.0, 0.0});
    }
    ASSERT_TRUE(check.offset());
    EXPECT_NEAR(check.offset()->late_sec, late_sec, 0.02);
    EXPECT_EQ(check.offset()->isTooLarge(), late_sec > 0.0);
  }
}

// While a turn goes on, the estimate of the window follows what late stamps show of it.
TEST(ClockCheck, FindsLateStampsWhileTheWindowIsLearnt) {
  Turning turning;
  turning.late_sec = 0.1;
  turning.learns = true;
  turning.fly(6.0);
  ASSERT_TRUE(turning.check.offset());
  EXPECT_NEAR(turning.check.offset()->late_sec, 0.1, 0.03);
  EXPECT_TRUE(turning.check.offset()->isTooLarge());
}

TEST(ClockCheck, KnowsNothingBeforeATurnBeginsOrEnds) {
  ClockCheck check;
  for (double t = 0.0; t < 20.0; t += 0.05) check.see({t, {0.0, 0.0}, {0.0, 0.0}, 0.1, 0.5}, {4.0, 0.0});
  EXPECT_FALSE(check.offset());
}

TEST(ClockCheck, KeepsWhatItFoundWhenTheWindowIsAnotherOneAndForgetsItWhenCleared) {
  Turning turning;
  turning.late_sec = 0.15;
  turning.fly(6.0);
  turning.check.forgetPlaces();
  EXPECT_TRUE(turning.check.offset());
  turning.check.clear();
  EXPECT_FALSE(turning.check.offset());
}

TEST(ClockCheck, IgnoresWhatIsNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, inf, -inf}) {
    Turning turning;
    const Eigen::Vector2d zero(0.0, 0.0);
    turning.check.see({bad, zero, zero, 0.0, 0.0}, {4.0, 0.0});
    turning.check.see({0.0, {bad, 0.0}, zero, 0.0, 0.0}, {4.0, 0.0});
    turning.check.see({0.0, zero, {0.0, bad}, 0.0, 0.0}, {4.0, 0.0});
    turning.check.see({0.0, zero, zero, bad, 0.0}, {4.0, 0.0});
    turning.check.see({0.0, zero, zero, 0.0, bad}, {4.0, 0.0});
    turning.check.see({0.0, zero, zero, 0.0, 0.0}, {bad, 0.0});
    turning.fly(6.0);
    ASSERT_TRUE(turning.check.offset());
    EXPECT_NEAR(turning.check.offset()->late_sec, 0.0, 0.03);
  }
}

}  // namespace window_ingress::estimation::clock_check_test
