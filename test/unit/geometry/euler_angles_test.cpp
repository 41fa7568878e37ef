#include "window_ingress/geometry/euler_angles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace window_ingress::geometry::euler_angles_test {

TEST(EulerAngles, RoundTripOfRandomAngles) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> full(-M_PI, M_PI), half(-M_PI_2 + 1e-3, M_PI_2 - 1e-3);
  for (int i = 0; i < 10000; ++i) {
    const EulerAngles in{full(random), half(random), full(random)};
    const EulerAngles out = eulerFromRotation(rotationFromEuler(in));
    EXPECT_NEAR(out.roll_rad, in.roll_rad, 1e-9);
    EXPECT_NEAR(out.pitch_rad, in.pitch_rad, 1e-9);
    EXPECT_NEAR(out.yaw_rad, in.yaw_rad, 1e-9);
  }
}

TEST(EulerAngles, RotationSurvivesTheRoundTripAtGimbalLock) {
  const Eigen::Matrix3d R = rotationFromEuler({0.3, M_PI_2, -0.4});
  EXPECT_TRUE(rotationFromEuler(eulerFromRotation(R)).isApprox(R, 1e-7));
}

TEST(EulerAngles, SignsAreThoseOfTheAxes) {
  EXPECT_TRUE(
      (rotationFromEuler({0, 0, M_PI_2}) * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d::UnitY()));
  EXPECT_TRUE(
      (rotationFromEuler({0, M_PI_2, 0}) * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitX()));
  EXPECT_TRUE(
      (rotationFromEuler({M_PI_2, 0, 0}) * Eigen::Vector3d::UnitY()).isApprox(Eigen::Vector3d::UnitZ()));
}

}  // namespace window_ingress::geometry::euler_angles_test
