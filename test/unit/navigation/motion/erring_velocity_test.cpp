// A velocity with more error than a steady bias: its observed errors decide whether a difference is a slide.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "navigation/motion/continuous_odometry.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::navigation::erring_velocity_test {

constexpr double kStep = 1.0 / 30.0;

/// A vehicle that flies ahead at 0.8 m/s; position and velocity of its odometry are off along y.
struct Flight {
  double time = 10.0, shift_m = 0.0, bias_mps = 0.0;

  VehicleState step() {
    time += kStep;
    VehicleState odometry;
    odometry.stamp_sec = time;
    odometry.T_odom_base =
        geometry::makePose(Eigen::Matrix3d::Identity(), Eigen::Vector3d(0.8 * (time - 10.0), shift_m, 0.0));
    odometry.velocity_odom_mps = Eigen::Vector3d(0.8, bias_mps, 0.0);
    return odometry;
  }
};

/// Apparent sideways motion within `for_sec` after ten seconds [m].
template <typename SetErrors>
double carriedM(ContinuousOdometry& continuous, double for_sec, SetErrors setErrors) {
  Flight flight;
  double y_m = 0.0, before_y_m = 0.0;
  while (flight.time < 20.0 + for_sec) {
    const bool late = flight.time >= 20.0;
    setErrors(flight, late);
    const auto smooth = continuous.add(flight.step());
    EXPECT_TRUE(smooth);
    if (!smooth) return NAN;
    y_m = smooth->T_odom_base.translation().y();
    if (!late) before_y_m = y_m;
  }
  return y_m - before_y_m;
}

// PX4 with satellite positioning: its velocity wanders by 0.2 m/s within seconds, its position by
// centimetres.
TEST(ErringVelocity, ThatWandersMovesNoFrame) {
  ContinuousOdometry continuous;
  const double carried_m = carriedM(
      continuous, 20.0, [](Flight& flight, bool) { flight.bias_mps = 0.2 * std::sin(0.7 * flight.time); });
  EXPECT_TRUE(continuous.isBiasKnown());
  EXPECT_NEAR(carried_m, 0.0, 0.01);
}

TEST(ErringVelocity, IsCorrectedByWhatThePositionDidInTheLastSecond) {
  Flight flight;
  ContinuousOdometry continuous;
  double worst_mps = 0.0;
  while (flight.time < 40.0) {
    flight.bias_mps = 0.2 * std::sin(0.7 * flight.time);
    const auto smooth = continuous.add(flight.step());
    ASSERT_TRUE(smooth);
    if (flight.time > 20.0) worst_mps = std::max(worst_mps, std::abs(continuous.unbiased(*smooth).y()));
  }
  EXPECT_LT(worst_mps, 0.1);
}

// The median over some seconds is small, but the error of the next second is not. Two of 800 flights of PX4
// with satellite positioning committed with such a velocity, and touched.
TEST(ErringVelocity, ThatWandersIsUnexplainedUntilItsBiasIsKnown) {
  ContinuousOdometry continuous;
  Flight flight;
  double least_mps = 1.0;
  while (!continuous.isBiasKnown()) {
    if (flight.time > 13.0) least_mps = std::min(least_mps, continuous.unexplainedMps());
    flight.bias_mps = 0.2 * std::sin(1.5 * flight.time);
    ASSERT_TRUE(continuous.add(flight.step()));
  }
  EXPECT_GT(flight.time, 16.0);
  EXPECT_GT(least_mps, 0.08);
}

// In front of the opening the velocity was off by 0.2 m/s to one side, within the opening by 0.45 to the
// other. A velocity with large observed errors is not believed.
TEST(ErringVelocity, IsNotBelievedWhenItErrsByMore) {
  ContinuousOdometry continuous;
  const double carried_m = carriedM(continuous, 2.7, [](Flight& flight, bool late) {
    flight.bias_mps = late ? -0.45 : 0.2 * std::sin(1.5 * flight.time);
  });
  EXPECT_NEAR(carried_m, 0.0, 0.02);  // its velocity says 1.2 m
}

// A velocity with small observed errors does not suddenly err that much: the difference is a slide.
TEST(ErringVelocity, ASlideBesideASteadyBiasIsTakenOff) {
  for (const auto& [wander_mps, slide_mps] : {std::pair{0.0, 0.2}, {0.0, 0.45}, {0.03, 0.45}}) {
    ContinuousOdometry continuous;
    const double wander = wander_mps, slide = slide_mps;
    const double carried_m = carriedM(continuous, 2.7, [&](Flight& flight, bool late) {
      flight.bias_mps = 0.17 + wander * std::sin(0.7 * flight.time);
      if (late) flight.shift_m += slide * kStep;
    });
    EXPECT_TRUE(continuous.isBiasKnown());
    EXPECT_NEAR(carried_m, 0.0, wander > 0.0 ? 0.15 : 0.05) << "of " << 2.7 * slide << " m";
  }
}

TEST(ErringVelocity, AJumpIsTakenOffAllTheSame) {
  ContinuousOdometry continuous;
  const double carried_m = carriedM(continuous, 0.5, [](Flight& flight, bool late) {
    flight.bias_mps = 0.2 * std::sin(0.7 * flight.time);
    if (late) flight.shift_m = 0.3;
  });
  EXPECT_NEAR(carried_m, 0.0, 0.02);
}

}  // namespace window_ingress::navigation::erring_velocity_test
