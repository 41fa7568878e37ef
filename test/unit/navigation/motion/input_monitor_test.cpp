#include "navigation/motion/input_monitor.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "navigation_samples.hpp"

namespace window_ingress::navigation::input_monitor_test {

using test::inputAt;
using test::targetAtOrigin;
using test::vehicleAt;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
const Eigen::Vector3d kThere(-4, 0, 1.5);

InputMonitor monitor() { return InputMonitor(InputParams()); }

TEST(InputMonitor, TakesGoodSamplesAndPredictsTheVehicleToNow) {
  auto judge = monitor();
  auto input = inputAt(kThere, 10.0);
  input.vehicle->velocity_odom_mps.x() = 1.0;
  const auto situation = judge.judge(input, 10.1);
  ASSERT_TRUE(situation.vehicle && situation.target);
  EXPECT_NEAR(situation.vehicle->T_odom_base.translation().x(), -3.9, 1e-12);
  EXPECT_TRUE(situation.target_is_new);
  EXPECT_FALSE(judge.judge(input, 10.15).target_is_new);
}

TEST(InputMonitor, SaysWhatIsMissing) {
  auto judge = monitor();
  const auto situation = judge.judge({}, 10.0);
  EXPECT_EQ(situation.vehicle_fault, "no odometry");
  EXPECT_EQ(situation.target_fault, "no window seen");
  EXPECT_EQ(situation.image_fault, "no image searched so far");
}

TEST(InputMonitor, AgeCountsInBothDirections) {
  for (const double now : {10.36, 9.79, kNan, kInf}) {
    auto judge = monitor();
    EXPECT_FALSE(judge.judge(inputAt(kThere, 10.0), now).vehicle) << now;
  }
  for (const double now : {10.34, 9.81}) {
    auto judge = monitor();
    EXPECT_TRUE(judge.judge(inputAt(kThere, 10.0), now).vehicle) << now;
  }
  auto judge = monitor();
  auto input = inputAt(kThere, 10.0);
  input.vehicle->stamp_sec = 10.4;
  EXPECT_EQ(judge.judge(input, 10.41).target_fault, "window 0.41 s old");
  input.image_stamp_sec = 8.0;
  EXPECT_EQ(judge.judge(input, 10.41).image_fault, "last image in window_pose 2.41 s old");
}

TEST(InputMonitor, OdometryThatIsStuckIsSoBetweenItsMessagesToo) {
  auto judge = monitor();
  auto input = inputAt(kThere, 10.0);
  input.vehicle->velocity_odom_mps.x() = 0.5;  // claims motion
  for (int i = 0; i < 20; ++i) {
    input.vehicle->stamp_sec = 10.0 + 0.033 * i;
    for (const double later_sec : {0.0, 0.016}) {
      const auto situation = judge.judge(input, input.vehicle->stamp_sec + later_sec);
      EXPECT_EQ(situation.vehicle.has_value(), i < 8) << i << " " << later_sec;
    }
  }
}

TEST(InputMonitor, APositionThatMovesWithoutAVelocityIsNoOdometryToFlyBy) {
  auto judge = monitor();
  std::string fault;
  for (int i = 0; i < 50; ++i) {
    auto input = inputAt(kThere + Eigen::Vector3d(0.02 * i, 0, 0), 10.0 + 0.02 * i);
    input.vehicle->velocity_odom_mps.setZero();
    const auto situation = judge.judge(input, 10.0 + 0.02 * i);
    EXPECT_EQ(situation.vehicle.has_value(), situation.vehicle_fault.empty());
    fault = situation.vehicle_fault;
  }
  EXPECT_EQ(fault, "odometry: its twist is zero while the position moves");
}

// Late odometry still describes the motion since its stamp, so it is used. Missing odometry says nothing.
TEST(InputMonitor, OdometryThatComesLateIsFlownByOneThatStaysAwayIsNot) {
  constexpr double kStep = 0.03;
  auto judge = monitor();
  double now = 10.0;
  for (; now < 12.0; now += kStep) {
    const double late_sec = std::min(0.03 + 0.5 * (now - 10.0), 0.3);
    EXPECT_TRUE(judge.judge(inputAt(kThere, now - late_sec), now).vehicle) << now;
  }
  const auto last = inputAt(kThere, now - 0.03);
  EXPECT_TRUE(judge.judge(last, now).vehicle);
  EXPECT_TRUE(judge.judge(last, now + 0.19).vehicle);
  EXPECT_EQ(judge.judge(last, now + 0.21).vehicle_fault, "odometry: none for 0.21 s");
  EXPECT_TRUE(judge.judge(inputAt(kThere, now + 0.2), now + 0.24).vehicle) << "it is back";
}

TEST(InputMonitor, ABadVehicleIsNeverUsedAndNamed) {
  const auto spoilt = [](auto spoil) {
    auto judge = monitor();
    auto input = inputAt(kThere, 10.0);
    judge.judge(input, 10.0);
    input.vehicle->stamp_sec = 10.02;
    spoil(*input.vehicle);
    const auto situation = judge.judge(input, 10.02);
    EXPECT_EQ(situation.vehicle.has_value(), situation.vehicle_fault.empty());
    return situation.vehicle_fault;
  };
  for (const double bad : {kNan, kInf}) {
    EXPECT_NE(spoilt([&](VehicleState& v) { v.T_odom_base.translation().y() = bad; }), "");
    EXPECT_NE(spoilt([&](VehicleState& v) { v.T_odom_base.linear()(1, 1) = bad; }), "");
    EXPECT_NE(spoilt([&](VehicleState& v) { v.velocity_odom_mps.z() = bad; }), "");
    EXPECT_NE(spoilt([&](VehicleState& v) { v.stamp_sec = bad; }), "");
  }
  EXPECT_NE(spoilt([](VehicleState& v) { v.T_odom_base.linear().setZero(); }), "");
  EXPECT_NE(spoilt([](VehicleState& v) { v.T_odom_base.translation().x() = 1e300; }), "");
  EXPECT_NE(spoilt([](VehicleState& v) { v.velocity_odom_mps.x() = 1e10; }), "");
}

TEST(InputMonitor, AnOlderVehicleSampleCountsAsNoneCame) {
  auto judge = monitor();
  judge.judge(inputAt(kThere, 10.0), 10.0);
  auto input = inputAt(Eigen::Vector3d(-4.2, 0, 1.5), 9.9);
  const auto situation = judge.judge(input, 10.02);
  ASSERT_TRUE(situation.vehicle);
  EXPECT_NEAR(situation.vehicle->T_odom_base.translation().x(), -4.0, 1e-12);
}

TEST(InputMonitor, AJumpMovesNeitherTheVehicleNorTheWindow) {
  auto judge = monitor();
  judge.judge(inputAt(kThere, 10.0), 10.0);
  const Eigen::Vector3d jump(4.0, 1.0, 0.0);
  auto jumped = inputAt(kThere + jump, 10.03);
  jumped.target = targetAtOrigin(10.0);  // of an image before the jump
  auto situation = judge.judge(jumped, 10.03);
  const auto isWhereItWas = [&] {
    return situation.vehicle && situation.target &&
           situation.vehicle->T_odom_base.translation().isApprox(kThere, 1e-3) &&
           situation.target->T_odom_window.translation().isApprox(Eigen::Vector3d(0, 0, 1.5), 1e-3);
  };
  EXPECT_FALSE(situation.vehicle_jumped);
  EXPECT_TRUE(isWhereItWas());
  jumped.target = targetAtOrigin(10.05);
  jumped.target->T_odom_window.translation() += jump;
  jumped.vehicle->stamp_sec = 10.06;
  situation = judge.judge(jumped, 10.06);
  EXPECT_TRUE(isWhereItWas());
}

TEST(InputMonitor, ABadTargetIsNeverUsedAndNamed) {
  const auto spoilt = [](auto spoil) {
    auto judge = monitor();
    auto input = inputAt(kThere, 10.0);
    spoil(*input.target);
    const auto situation = judge.judge(input, 10.0);
    EXPECT_EQ(situation.target.has_value(), situation.target_fault.empty());
    return situation.target_fault;
  };
  for (const double bad : {kNan, kInf}) {
    EXPECT_NE(spoilt([&](TargetEstimate& t) { t.T_odom_window.translation().x() = bad; }), "");
    EXPECT_NE(spoilt([&](TargetEstimate& t) { t.covariance(3, 4) = bad; }), "");
    EXPECT_NE(spoilt([&](TargetEstimate& t) { t.opening.width_m = bad; }), "");
    EXPECT_NE(spoilt([&](TargetEstimate& t) { t.stamp_sec = bad; }), "");
  }
  EXPECT_EQ(spoilt([](TargetEstimate& t) { t.covariance.setZero(); }), "window: covariance unknown");
  EXPECT_EQ(spoilt([](TargetEstimate& t) { t.covariance(0, 0) = -1; }), "window: covariance unknown");
  EXPECT_EQ(spoilt([](TargetEstimate& t) { t.covariance(1, 5) = t.covariance(5, 1) = 100.0; }),  // indefinite
            "window: covariance unknown");
  EXPECT_EQ(spoilt([](TargetEstimate& t) { t.opening.height_m = 0; }), "window: size of the opening unknown");
  EXPECT_NE(spoilt([](TargetEstimate& t) {
              t.T_odom_window.linear() = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX()).toRotationMatrix();
            }),
            "");
}

TEST(InputMonitor, ATargetThatJumpsIsBelievedOnlyIfItStays) {
  auto judge = monitor();
  double now = 10.0;
  const auto see = [&](double shift) {
    now += 0.033;
    auto input = inputAt(kThere, now);
    input.target->T_odom_window.translation().y() += shift;
    return judge.judge(input, now);
  };
  for (int i = 0; i < 10; ++i) see(0.0);
  EXPECT_DOUBLE_EQ(see(1.0).target->T_odom_window.translation().y(), 0.0);
  EXPECT_DOUBLE_EQ(see(0.0).target->T_odom_window.translation().y(), 0.0);
  bool was_withheld = false;
  for (int i = 0; i < 20; ++i) was_withheld = !see(1.0).target || was_withheld;
  EXPECT_TRUE(was_withheld);
  EXPECT_DOUBLE_EQ(see(1.0).target->T_odom_window.translation().y(), 1.0);
}

TEST(InputMonitor, TargetsThatJumpEachTimeAreNeverBelieved) {
  auto judge = monitor();
  judge.judge(inputAt(kThere, 10.0), 10.0);
  for (int i = 1; i < 40; ++i) {
    auto input = inputAt(kThere, 10.0 + 0.1 * i);
    input.target->T_odom_window.translation().y() = i % 2 ? 2.0 : -2.0;
    EXPECT_FALSE(judge.judge(input, 10.0 + 0.1 * i).target_is_new);
  }
  for (int i = 0; i < 5; ++i) {  // seen rarely, each time in another place
    auto input = inputAt(kThere, 20.0 + i);
    input.target->T_odom_window.translation().y() = 3.0 * (i + 1);
    EXPECT_FALSE(judge.judge(input, 20.0 + i).target);
  }
}

TEST(InputMonitor, MotionWhileOdometryWasGoneIsAJump) {
  auto judge = monitor();
  judge.judge(inputAt(kThere, 10.0), 10.0);
  const auto situation = judge.judge(inputAt(kThere + Eigen::Vector3d(1.0, 0, 0), 12.0), 12.0);
  EXPECT_TRUE(situation.vehicle_jumped);
  EXPECT_FALSE(situation.vehicle);
}

TEST(InputMonitor, AClockThatRunsBackVoidsEverything) {
  auto judge = monitor();
  judge.judge(inputAt(kThere, 100.0), 100.0);
  const auto situation = judge.judge(inputAt(kThere, 50.0), 50.0);
  EXPECT_TRUE(situation.vehicle_jumped);
  EXPECT_FALSE(situation.vehicle);
  EXPECT_TRUE(judge.judge(inputAt(kThere, 50.03), 50.03).vehicle);
}

TEST(InputFaults, ACovarianceWithHalvesThatDifferIsNone) {
  auto target = test::targetAtOrigin(0.0);
  EXPECT_EQ(faultOf(target), "");
  target.covariance(0, 1) = -1e3;  // above the diagonal, where a Cholesky decomposition does not look
  EXPECT_NE(faultOf(target), "");
}

}  // namespace window_ingress::navigation::input_monitor_test
