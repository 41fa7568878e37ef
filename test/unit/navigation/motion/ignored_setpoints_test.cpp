#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "navigation/motion/disturbance_observer.hpp"

namespace window_ingress::navigation::ignored_setpoints_test {

DisturbanceObserver observer() { return {VehicleParams(), ApproachParams()}; }

/// Odometry's velocity with noise and a bias; what the vehicle itself does with a command.
using Answer = std::function<Eigen::Vector3d(const Eigen::Vector3d& command, double t)>;
double ignoredAfterSec(const Answer& answer, const Answer& command) {
  DisturbanceObserver observe = observer();
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 0.05);
  constexpr double kStep = 1.0 / 30.0;
  for (double t = 0.0; t < 60.0; t += kStep) {
    const Eigen::Vector3d told = command({}, t);
    observe.update(answer(told, t) + Eigen::Vector3d(0.15 + noise(random), noise(random), noise(random)),
                   told, kStep);
    if (observe.ignoresSetpoints()) return t;
  }
  return INFINITY;
}

TEST(IgnoredSetpoints, TellsAVehicleThatIgnoresItsSetpoints) {
  const Answer ahead = [](const auto&, double) { return Eigen::Vector3d(0.5, 0.4, 0.0); };
  const Answer stands = [](const auto&, double) { return Eigen::Vector3d(0, 0, 0); };
  const double sec = ignoredAfterSec(stands, ahead);
  EXPECT_GT(sec, 3.0);
  EXPECT_LT(sec, 7.0);
  EXPECT_EQ(ignoredAfterSec(stands, stands), INFINITY) << "nothing was said";
}

TEST(IgnoredSetpoints, AVehicleThatKeepsItsPlaceInWindIgnoresNothing) {
  constexpr double kStep = 1.0 / 30.0, kWindMps = 0.6;
  DisturbanceObserver observe = observer();
  double position_m = 0.0, velocity_mps = 0.0;
  for (double t = 0.0; t < 60.0; t += kStep) {
    const double told_mps = -position_m;
    velocity_mps += kStep / 0.3 * (told_mps + kWindMps - velocity_mps);
    position_m += kStep * velocity_mps;
    observe.update({velocity_mps, 0.0, 0.0}, {told_mps, 0.0, 0.0}, kStep);
    EXPECT_FALSE(observe.ignoresSetpoints()) << t;
  }
}

TEST(IgnoredSetpoints, ASlowVehicleIgnoresNothing) {
  const Answer ahead = [](const auto&, double) { return Eigen::Vector3d(0.5, 0.4, 0.0); };
  for (const double acceleration_mps2 : {0.3, 0.6, 3.0}) {
    const Answer slow = [&](const Eigen::Vector3d& told, double t) -> Eigen::Vector3d {
      return told * std::min(1.0, std::max(0.0, t - 0.9) * acceleration_mps2 / told.norm());
    };
    EXPECT_EQ(ignoredAfterSec(slow, ahead), INFINITY) << acceleration_mps2;
  }
}

}  // namespace window_ingress::navigation::ignored_setpoints_test
