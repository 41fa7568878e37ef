#include "adapters/guard/setpoint_gate.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace window_ingress::adapters::setpoint_gate_test {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

geometry_msgs::Twist twist(double x, double yaw_rate) {
  geometry_msgs::Twist out;
  out.linear.x = x;
  out.angular.z = yaw_rate;
  return out;
}

TEST(Guard, PassesSaneVelocitiesOnly) {
  const GuardParams params;
  EXPECT_TRUE(whyUnsafe(twist(0.0, 0.0), params).empty());
  EXPECT_TRUE(whyUnsafe(twist(-params.max_speed_mps, params.max_yaw_rate_radps), params).empty());
  EXPECT_FALSE(whyUnsafe(twist(params.max_speed_mps + 1e-6, 0.0), params).empty());
  EXPECT_FALSE(whyUnsafe(twist(0.0, -params.max_yaw_rate_radps - 1e-6), params).empty());
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300}) {
    EXPECT_FALSE(whyUnsafe(twist(bad, 0.0), params).empty()) << bad;
    EXPECT_FALSE(whyUnsafe(twist(0.0, bad), params).empty()) << bad;
    geometry_msgs::Twist other;
    other.angular.x = bad;
    EXPECT_FALSE(whyUnsafe(other, params).empty()) << bad;
  }
}

bool same(const geometry_msgs::Twist& a, const geometry_msgs::Twist& b) {
  return a.linear.x == b.linear.x && a.linear.y == b.linear.y && a.linear.z == b.linear.z &&
         a.angular.x == b.angular.x && a.angular.y == b.angular.y && a.angular.z == b.angular.z;
}

void expectZero(const std::optional<geometry_msgs::Twist>& output) {
  ASSERT_TRUE(output);
  EXPECT_TRUE(same(*output, geometry_msgs::Twist()));
}

TEST(SetpointGate, SendsZerosForAsLongAsNothingHasCome) {
  const SetpointGate gate{GuardParams()};
  for (const double now : {0.0, 1.0, 1e4, 1e9}) expectZero(gate.output(now));
}

TEST(SetpointGate, PassesRecentInputThenZeroThenNothingThenInputAgain) {
  const GuardParams params;
  SetpointGate gate(params);
  gate.receive(twist(0.5, 0.1), 100.0);
  EXPECT_TRUE(same(gate.output(100.0).value(), twist(0.5, 0.1)));
  EXPECT_TRUE(same(gate.output(100.0 + params.late_sec - 1e-6).value(), twist(0.5, 0.1)));
  expectZero(gate.output(100.0 + params.late_sec + 1e-6));
  const double end = 100.0 + params.late_sec + params.stop_streaming_after_sec;
  expectZero(gate.output(end - 1e-6));
  EXPECT_FALSE(gate.output(end + 1e-6));
  EXPECT_FALSE(gate.output(end + 1e6));
  gate.receive(twist(0.0, 0.0), end + 1e6);
  expectZero(gate.output(end + 1e6));
}

TEST(SetpointGate, ZeroStopsNever) {
  GuardParams params;
  params.stop_streaming_after_sec = 0.0;
  SetpointGate gate(params);
  gate.receive(twist(0.5, 0.1), 100.0);
  for (const double later : {1.0, 1e3, 1e8}) expectZero(gate.output(100.0 + later));
}

TEST(SetpointGate, InputThatIsRefusedForTooLongIsNoInput) {
  const GuardParams params;
  SetpointGate gate(params);
  gate.receive(twist(kNan, 0.0), 0.0);
  expectZero(gate.output(1e3));  // no valid setpoint yet: stand-by
  gate.receive(twist(0.5, 0.0), 2e3);
  for (double now = 2e3; now < 2e3 + params.stop_streaming_after_sec; now += 0.03) {
    gate.receive(twist(50.0, 0.0), now);
    expectZero(gate.output(now));
  }
  gate.receive(twist(50.0, 0.0), 2e3 + params.stop_streaming_after_sec + 1.0);
  EXPECT_FALSE(gate.output(2e3 + params.stop_streaming_after_sec + 1.0));
}

TEST(SetpointGate, ATimeThatIsNoneOrGoesBackIsZeroAtMost) {
  SetpointGate gate{GuardParams()};
  gate.receive(twist(0.5, 0.1), 100.0);
  expectZero(gate.output(kNan));
  EXPECT_FALSE(gate.output(kInf));
  gate.receive(twist(0.5, 0.1), kNan);
  expectZero(gate.output(100.0));
}

class RandomInput {
 public:
  geometry_msgs::Twist next() {
    geometry_msgs::Twist out;
    for (double* number :
         {&out.linear.x, &out.linear.y, &out.linear.z, &out.angular.x, &out.angular.y, &out.angular.z})
      *number = component();
    return out;
  }
  double gap() { return chance(0.001) ? 15.0 * unit() : chance(0.05) ? 0.5 * unit() : 0.05 * unit(); }
  bool chance(double share) { return unit() < share; }

 private:
  double unit() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }
  double component() {
    static const double kOdd[] = {kNan, -kNan, kInf, -kInf, 1e308, -1e308, 5e-324, 1e154, -0.0};
    if (chance(0.02)) return kOdd[std::uniform_int_distribution<int>(0, 8)(random_)];
    return chance(0.3) ? 0.0 : 1.6 * unit() - 0.8;
  }
  std::mt19937 random_{7};
};

// Any input, at any time.
TEST(SetpointGate, PropertiesHoldForRandomInputs) {
  const GuardParams params;
  SetpointGate gate(params);
  RandomInput random;
  geometry_msgs::Twist last;
  double now = 0.0, received = -kInf, sane = -kInf;
  int passed = 0, zeros = 0, silent = 0;
  for (int i = 0; i < 100000; ++i) {
    now += random.gap();
    if (random.chance(0.7)) {
      gate.receive(last = random.next(), received = now);
      if (whyUnsafe(last, params).empty()) sane = now;
    }
    const auto output = gate.output(now);
    if (!output) {
      ++silent;
      ASSERT_GT(now - sane, params.late_sec + params.stop_streaming_after_sec);
      continue;
    }
    ASSERT_EQ(whyUnsafe(*output, params), "");
    const bool is_zero = same(*output, geometry_msgs::Twist());
    ++(is_zero ? zeros : passed);
    if (is_zero) continue;
    ASSERT_TRUE(same(*output, last));
    ASSERT_LE(now - received, params.late_sec);
  }
  EXPECT_GT(passed, 1000);
  EXPECT_GT(zeros, 1000);
  EXPECT_GT(silent, 5);
}

}  // namespace window_ingress::adapters::setpoint_gate_test
