// Which of the two errs where position and velocity differ: the window tells, as long as it is seen.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "navigation/motion/continuous_odometry.hpp"
#include "navigation/motion/input_monitor.hpp"
#include "navigation_samples.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::navigation::odometry_beside_window_test {

constexpr double kStep = 1.0 / 30.0;
const Eigen::Vector3d kWindow(6.0, 1.0, 1.5);

/// A vehicle that flies ahead at 0.8 m/s; what its odometry's position and velocity are off by along y.
struct Flight {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double time = 10.0, shift_m = 0.0, bias_mps = 0.0;

  VehicleState step() {
    time += kStep;
    position.x() += 0.8 * kStep;
    VehicleState odometry;
    odometry.stamp_sec = time;
    odometry.T_odom_base = geometry::makePose(Eigen::Matrix3d::Identity(), position + shift());
    odometry.velocity_odom_mps = Eigen::Vector3d(0.8, bias_mps, 0.0);
    return odometry;
  }
  Eigen::Vector3d shift() const { return {0.0, shift_m, 0.0}; }
};

// PX4 by satellites: its velocity wanders by 0.2 m/s within seconds, its position by centimetres. Where no
// window has told, so much might be a slide.
TEST(OdometryBesideWindow, WhereTheWindowStaysThePositionIsBelieved) {
  for (const bool seen : {true, false}) {
    Flight flight;
    ContinuousOdometry continuous;
    double left_y_m = 0.0, worst_m = 0.0, early_m = 0.0;
    for (int i = 0; i < 900; ++i) {  // blind for longer than eight seconds
      const bool blind = i >= 300;
      if (i == 60 || i == 120) early_m = left_y_m - early_m;  // within two seconds
      flight.bias_mps = (seen ? 0.2 : 0.1) * std::sin(0.7 * flight.time);
      const VehicleState odometry = flight.step();
      if (seen && !blind) continuous.see(flight.time - 0.05, kWindow);
      const auto smooth = continuous.add(odometry);
      ASSERT_TRUE(smooth);
      const double y_m = smooth->T_odom_base.translation().y();
      if (!blind) left_y_m = y_m;
      worst_m = std::max(worst_m, std::abs(y_m - left_y_m));
    }
    EXPECT_TRUE(continuous.isVelocityWorse());
    EXPECT_LT(worst_m, 0.01);
    EXPECT_EQ(std::abs(early_m) > 0.05,
              !seen);  // as if the position had slid, until that has lasted too long
  }
}

// As long as only a bias speaks against the velocity, what goes beyond it is the position's.
TEST(OdometryBesideWindow, UntilAWindowHasToldASlowSlideBesideABiasIsTakenOff) {
  Flight flight;
  ContinuousOdometry continuous;
  flight.bias_mps = 0.12;
  std::optional<VehicleState> smooth;
  for (int i = 0; i < 300; ++i) smooth = continuous.add(flight.step());
  const double before_m = smooth->T_odom_base.translation().y();
  for (int i = 0; i < 60; ++i) {
    flight.shift_m += 0.2 * kStep;
    smooth = continuous.add(flight.step());
  }
  EXPECT_NEAR(smooth->T_odom_base.translation().y(), before_m, 0.05) << "of 0.4 m";
}

TEST(OdometryBesideWindow, WhereTheWindowSlidesAlongThePositionErrs) {
  Flight flight;
  ContinuousOdometry continuous;
  for (int i = 0; i < 300; ++i) {
    flight.shift_m = 0.3 * std::sin(0.7 * flight.time);
    const VehicleState odometry = flight.step();
    continuous.see(flight.time - 0.05, kWindow + flight.shift());
    const auto smooth = continuous.add(odometry);
    ASSERT_TRUE(smooth);
    EXPECT_FALSE(continuous.isVelocityWorse());
  }
}

// A steady bias is taken off: what it explains says nothing of the rest, in which the window slides along.
TEST(OdometryBesideWindow, ASteadyBiasIsNoReasonToBelieveThePosition) {
  Flight flight;
  ContinuousOdometry continuous;
  flight.bias_mps = 0.25;
  for (int i = 0; i < 900; ++i) {
    flight.shift_m = 0.1 * std::sin(1.5 * flight.time);
    const VehicleState odometry = flight.step();
    continuous.see(flight.time - 0.05, kWindow + flight.shift());
    ASSERT_TRUE(continuous.add(odometry));
  }
  EXPECT_TRUE(continuous.isBiasKnown());
  EXPECT_FALSE(continuous.isVelocityWorse());
}

/// How far the vehicle seems to be carried sideways while no window is seen, after ten seconds beside one
/// [m].
template <typename SetErrors>
double carriedBlind(ContinuousOdometry& continuous, SetErrors setErrors) {
  Flight flight;
  double y_m = 0.0, before_y_m = 0.0;
  for (int i = 0; i < 380; ++i) {
    const bool blind = i >= 300;
    setErrors(flight, blind);
    const VehicleState odometry = flight.step();
    if (!blind) continuous.see(flight.time - 0.05, kWindow);
    const auto smooth = continuous.add(odometry);
    EXPECT_TRUE(smooth);
    if (!smooth) return NAN;
    y_m = smooth->T_odom_base.translation().y();
    if (!blind) before_y_m = y_m;
  }
  return y_m - before_y_m;
}

// A velocity that was seen to err by little beside its bias does not begin to err by so much.
TEST(OdometryBesideWindow, ASlideBesideABiasThatIsKnownIsTakenOffAllTheSame) {
  ContinuousOdometry continuous;
  const double carried_m = carriedBlind(continuous, [](Flight& flight, bool blind) {
    flight.bias_mps = 0.17 + 0.03 * std::sin(0.7 * flight.time);
    if (blind) flight.shift_m += 0.45 * kStep;
  });
  EXPECT_TRUE(continuous.isBiasKnown());
  EXPECT_NEAR(carried_m, 0.0, 0.15);  // of 1.2 m
}

// PX4 by satellites: before the opening its velocity erred by 0.2 m/s to one side, in the opening by 0.45 to
// the other. Who was seen to err by much is not believed beside its bias either.
TEST(OdometryBesideWindow, AVelocityThatWasSeenToErrIsNotBelievedWhenNoWindowTells) {
  ContinuousOdometry continuous;
  const double carried_m = carriedBlind(continuous, [](Flight& flight, bool blind) {
    flight.bias_mps = blind ? -0.45 : 0.2 * std::sin(1.5 * flight.time);
  });
  EXPECT_NEAR(carried_m, 0.0, 0.02);  // by its velocity 1.2 m
}

TEST(OdometryBesideWindow, AJumpIsTakenOffAllTheSame) {
  Flight flight;
  ContinuousOdometry continuous;
  double before_y_m = 0.0;
  for (int i = 0; i < 315; ++i) {
    flight.bias_mps = 0.2 * std::sin(0.7 * flight.time);
    if (i >= 300) flight.shift_m = 1.0;
    const VehicleState odometry = flight.step();
    if (i < 300) continuous.see(flight.time - 0.05, kWindow);
    const auto smooth = continuous.add(odometry);
    ASSERT_TRUE(smooth);
    const double y_m = smooth->T_odom_base.translation().y();
    if (i < 300)
      before_y_m = y_m;
    else
      EXPECT_NEAR(y_m, before_y_m, 0.02);
  }
  EXPECT_TRUE(continuous.isVelocityWorse());
}

TEST(OdometryBesideWindow, TheMonitorTellsItOfTheWindow) {
  Flight flight;
  InputMonitor monitor{InputParams()};
  for (int i = 0; i < 200; ++i) {
    flight.bias_mps = 0.2 * std::sin(0.7 * flight.time);
    const VehicleState odometry = flight.step();
    NavigatorInput input = test::inputAt(Eigen::Vector3d::Zero(), flight.time);
    input.vehicle = odometry;
    monitor.judge(input, flight.time);
  }
  EXPECT_TRUE(monitor.odometry().isVelocityWorse());
}

}  // namespace window_ingress::navigation::odometry_beside_window_test
