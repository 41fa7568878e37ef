#include "window_ingress/navigation/relative_state.hpp"

#include <gtest/gtest.h>

#include <random>

#include "navigation_samples.hpp"

namespace window_ingress::navigation::relative_state_test {

using test::targetAtOrigin;
using test::vehicleAt;

TEST(RelativeState, LeftOfTheAxisIsPositiveAndInFrontIsNegative) {
  auto vehicle = vehicleAt({-4.0, 1.0, 1.7}, 0.0, 0.3);
  vehicle.velocity_odom_mps = {0.5, -0.1, 0.2};
  const auto relative = relate(vehicle, targetAtOrigin(0.0));
  EXPECT_NEAR(relative.distance(), 4.0, 1e-12);
  EXPECT_NEAR(relative.lateral(), 1.0, 1e-12);
  EXPECT_NEAR(relative.vertical(), 0.2, 1e-12);
  EXPECT_NEAR(relative.heading_error_rad, -0.3, 1e-12);
  EXPECT_NEAR(relative.bearing_rad, std::atan2(-1.0, 4.0) - 0.3, 1e-12);
  EXPECT_TRUE(relative.velocity_window_mps.isApprox(Eigen::Vector3d(0.5, -0.1, 0.2)));
}

TEST(RelativeState, DoesNotDependOnTheOdometryFrame) {
  const auto vehicle = vehicleAt({-4.0, 1.0, 1.7}, 0.0, 0.3);
  const auto target = targetAtOrigin(0.0);
  const auto here = relate(vehicle, target);
  const Eigen::Isometry3d T_other_odom = geometry::makePose(geometry::yawRotation(2.5), {10, -20, 3});
  auto moved_vehicle = vehicle;
  moved_vehicle.T_odom_base = T_other_odom * vehicle.T_odom_base;
  auto moved_target = target;
  moved_target.T_odom_window = T_other_odom * target.T_odom_window;
  const auto there = relate(moved_vehicle, moved_target);
  EXPECT_TRUE(there.position_window_m.isApprox(here.position_window_m));
  EXPECT_NEAR(there.bearing_rad, here.bearing_rad, 1e-12);
  EXPECT_NEAR(there.heading_error_rad, here.heading_error_rad, 1e-12);
}

TEST(RelativeState, LateralSigmaIsThatOfAMonteCarlo) {
  std::mt19937 random(3);
  std::normal_distribution<double> gauss;
  const auto vehicle = vehicleAt({-3.0, 1.2, 1.5}, 0.0);
  auto target = targetAtOrigin(0.0);
  target.T_odom_window.linear() = geometry::yawRotation(0.4);
  Eigen::Matrix<double, 6, 6> root = Eigen::Matrix<double, 6, 6>::Zero();  // correlated position and heading
  root.diagonal() << 0.02, 0.03, 0.01, 0.001, 0.001, 0.02;
  root(0, 5) = 0.02;
  root(1, 5) = -0.01;
  target.covariance = root * root.transpose();
  double sum = 0.0, squares = 0.0;
  constexpr int kSamples = 20000;
  for (int i = 0; i < kSamples; ++i) {
    Eigen::Matrix<double, 6, 1> unit;
    for (int k = 0; k < 6; ++k) unit(k) = gauss(random);
    const Eigen::Matrix<double, 6, 1> error = root * unit;
    auto wrong = target;
    wrong.T_odom_window.translation() += error.head<3>();
    wrong.T_odom_window.linear() = geometry::yawRotation(0.4 + error(5));
    const double lateral = relate(vehicle, wrong).lateral();
    sum += lateral;
    squares += lateral * lateral;
  }
  const double sigma = std::sqrt(squares / kSamples - std::pow(sum / kSamples, 2));
  EXPECT_NEAR(relate(vehicle, target).sigma_m.x() / sigma, 1.0, 0.03);
}

TEST(RelativeState, AHeadingThatIsOffLeadsPastTheOpening) {
  const auto vehicle = vehicleAt({-3.0, 0.0, 1.5}, 0.0);
  auto target = targetAtOrigin(0.0);
  Eigen::Matrix<double, 6, 1> turn = Eigen::Matrix<double, 6, 1>::Zero();  // of the window, about the vehicle
  turn(1) = 3.0, turn(5) = 1.0;
  target.covariance = 0.03 * 0.03 * turn * turn.transpose();
  EXPECT_NEAR(relate(vehicle, target).sigma_m.x(), 0.09, 1e-9);
}

}  // namespace window_ingress::navigation::relative_state_test
