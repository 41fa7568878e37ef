#include "window_ingress/estimation/target_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "pose_fixtures.hpp"
#include "window_ingress/estimation/window_filter.hpp"

namespace window_ingress::estimation::target_motion_test {

using namespace fixtures;

TEST(MotionModel, NothingHappensToWhatStandsOrWithoutTime) {
  for (const double elapsed_sec : {-1.0, 0.0, std::numeric_limits<double>::quiet_NaN()}) {
    const auto passed = MotionModel{0.2, 1.0}.over(elapsed_sec);
    EXPECT_EQ(passed.kept, 1.0);
    EXPECT_EQ(passed.way_sec, 0.0);
    EXPECT_EQ(passed.place_variance, 0.0);
  }
  EXPECT_EQ((MotionModel{0.0, 1.0}.over(3.0).place_variance), 0.0);
  EXPECT_TRUE(MotionModel{}.stands());
}

// Two steps in a row equal one step of their total length.
TEST(MotionModel, IsAMarkovProcess) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> span(0.0001, 3.0), speed(0.01, 0.3), lasts(0.3, 5.0);
  for (int i = 0; i < 500; ++i) {
    const MotionModel model{speed(random), lasts(random)};
    const double a_sec = span(random), b_sec = span(random);
    const auto a = model.over(a_sec), b = model.over(b_sec), both = model.over(a_sec + b_sec);
    EXPECT_NEAR(both.kept, a.kept * b.kept, 1e-12);
    EXPECT_NEAR(both.way_sec, a.way_sec + a.kept * b.way_sec, 1e-12);
    const double place = a.place_variance + 2.0 * b.way_sec * a.cross_covariance +
                         b.way_sec * b.way_sec * a.velocity_variance + b.place_variance;
    EXPECT_NEAR(both.place_variance, place, 1e-4 * both.place_variance);
    EXPECT_NEAR(both.cross_covariance,
                b.kept * (a.cross_covariance + b.way_sec * a.velocity_variance) + b.cross_covariance, 1e-9);
    EXPECT_NEAR(both.velocity_variance, b.kept * b.kept * a.velocity_variance + b.velocity_variance, 1e-12);
  }
}

TEST(MotionModel, ForgetsInTheLongRunAndGoesOnInTheShort) {
  const MotionModel model{0.2, 2.0};
  EXPECT_NEAR(model.over(100.0).kept, 0.0, 1e-12);
  EXPECT_NEAR(model.over(100.0).velocity_variance, 0.04, 1e-12);
  EXPECT_NEAR(model.over(1e-4).way_sec, 1e-4, 1e-8);
  EXPECT_NEAR(model.over(1e-4).place_variance, 2.0 / 3.0 * 0.04 / 2.0 * 1e-12, 1e-16);
}

/// A camera approaches at 0.5 m/s with 30 images a second, and a window swings along its wall.
struct Approach {
  double amplitude_m = 0.1, period_sec = 4.0;
  std::mt19937 random{3};
  WindowPoseEstimator estimator{PoseParams{}};
  WindowFilter filter;

  Approach(double target_speed_mps, unsigned seed) : random(seed), filter(params(target_speed_mps)) {}

  static FilterParams params(double target_speed_mps) {
    FilterParams params;
    params.target_speed_mps = target_speed_mps;
    params.mounting_yaw_sigma_rad = 0.005;  // an unknown heading would hide the rest
    return params;
  }

  double phase(double time_sec) const { return 2.0 * M_PI * time_sec / period_sec; }
  Eigen::Vector3d window(double t) const { return {0.0, amplitude_m * std::sin(phase(t)), 1.5}; }
  double speed(double t) const { return amplitude_m * 2.0 * M_PI / period_sec * std::cos(phase(t)); }

  bool see(double time_sec) {
    const Eigen::Vector3d position(-5.0 + 0.5 * time_sec, -0.8, 1.5);
    const Eigen::Isometry3d T_odom_camera =
        geometry::makePose(geometry::yawRotation(0.15) * geometry::R_optical_flu().transpose(), position);
    const auto T_odom_window = geometry::makePose(Eigen::Matrix3d::Identity(), window(time_sec));
    auto seen = bordersSeen(camera(), T_odom_camera.inverse() * T_odom_window, 0.5, random);
    seen.stamp_sec = time_sec;
    const auto estimate = estimator.estimate(seen, camera()).estimate;
    return estimate && filter.update(estimate, seen, camera(), T_odom_camera);
  }
};

struct Errors {
  double place_m = 0.0, velocity_mps = 0.0, squares = 0.0, velocity_squares = 0.0;
  int refused = 0;
};

/// RMS errors of lateral position and velocity after the first second; mean squares over the stated
/// variances.
Errors errorsOf(Approach flight) {
  Errors out;
  int count = 0;
  for (int i = 1; i < 180; ++i) {
    const double t = i / 30.0;
    out.refused += !flight.see(t);
    if (t < 1.0) continue;
    const auto state = flight.filter.state(t);
    if (!state) continue;
    ++count;
    const double place = state->T_odom_window.translation().y() - flight.window(t).y();
    const double velocity = state->motion.velocity_odom_mps.y() - flight.speed(t);
    out.place_m += place * place;
    out.velocity_mps += velocity * velocity;
    out.squares += place * place / state->covariance(1, 1);
    out.velocity_squares += velocity * velocity / std::pow(state->motion.velocity_sigma_mps, 2);
  }
  out.place_m = std::sqrt(out.place_m / count);
  out.velocity_mps = std::sqrt(out.velocity_mps / count);
  out.squares /= count;
  out.velocity_squares /= count;
  return out;
}

TEST(MovingTarget, IsFollowedWithItsVelocityAndAnHonestCovariance) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Errors told = errorsOf(Approach(0.12, seed)), untold = errorsOf(Approach(0.0, seed));
    EXPECT_EQ(told.refused, 0);
    EXPECT_LT(told.place_m, 0.02);
    EXPECT_LT(told.velocity_mps, 0.06);
    EXPECT_LT(told.squares, 4.0);
    EXPECT_LT(told.velocity_squares, 4.0);
    EXPECT_GT(untold.place_m, 2.0 * told.place_m);  // lags, with a variance that is too small
    EXPECT_GT(untold.squares, 3.0 * told.squares);
  }
}

TEST(MovingTarget, ThatStandsHasNoVelocityAndIsKnownLessWell) {
  Approach told(0.12, 1), untold(0.0, 1);
  told.amplitude_m = untold.amplitude_m = 0.0;
  for (int i = 1; i < 90; ++i) told.see(i / 30.0), untold.see(i / 30.0);
  const auto moving = told.filter.state(3.0), standing = untold.filter.state(3.0);
  ASSERT_TRUE(moving && standing);
  EXPECT_LT(moving->motion.velocity_odom_mps.norm(), 3.0 * moving->motion.velocity_sigma_mps);
  EXPECT_GT(moving->covariance(1, 1), standing->covariance(1, 1));
  EXPECT_TRUE(standing->motion.model.stands());
  EXPECT_EQ(standing->motion.velocity_odom_mps.norm(), 0.0);
}

TEST(MovingTarget, IsExpectedFurtherOnWhileUnseen) {
  Approach flight(0.12, 2);
  flight.period_sec = 8.0;
  for (int i = 1; i <= 60; ++i) flight.see(i / 30.0 - 1.0);  // ends at 1 s, moving to the left
  const auto seen = flight.filter.state(1.0), unseen = flight.filter.state(1.5);
  ASSERT_TRUE(seen && unseen);
  const double way_m = unseen->T_odom_window.translation().y() - seen->T_odom_window.translation().y();
  EXPECT_GT(way_m, 0.25 * 0.5 * flight.speed(1.0));
  EXPECT_LT(way_m, 1.5 * 0.5 * flight.speed(1.0));
  EXPECT_GT(unseen->covariance(1, 1), 2.0 * seen->covariance(1, 1));
}

}  // namespace window_ingress::estimation::target_motion_test
