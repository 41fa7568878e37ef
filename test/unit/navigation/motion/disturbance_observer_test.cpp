#include "navigation/motion/disturbance_observer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::navigation::disturbance_observer_test {

DisturbanceObserver observer() { return {VehicleParams(), ApproachParams()}; }

/// A first-order vehicle flies straight ahead in wind; the observer's estimate is subtracted from its
/// command.
struct Windy {
  double lag_sec;
  Eigen::Vector3d wind{0.0, 0.2, -0.1};
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  double worst_mps = 0.0;

  void fly(DisturbanceObserver& observer, double seconds) {
    constexpr double kStep = 1.0 / 30.0;
    for (double t = 0.0; t < seconds; t += kStep) {
      const Eigen::Vector3d command = Eigen::Vector3d(0.8, 0.0, 0.0) - observer.disturbance();
      velocity += kStep / lag_sec * (command + wind - velocity);
      observer.update(velocity, command, kStep);
      worst_mps = std::max(worst_mps, velocity.norm());
    }
  }
};

TEST(DisturbanceObserver, TakesSteadyWindAwayFromFastAndSlowVehicles) {
  for (const double lag_sec : {0.05, 0.2, 0.4, 0.9, 1.5}) {
    auto observe = observer();
    Windy vehicle{lag_sec};
    vehicle.fly(observe, 15.0);
    EXPECT_LT((vehicle.velocity - Eigen::Vector3d(0.8, 0, 0)).norm(), 0.01) << lag_sec;
    EXPECT_LT((observe.disturbance() - vehicle.wind).norm(), 0.01) << lag_sec;
    EXPECT_LT(vehicle.worst_mps, 1.2) << lag_sec;
  }
}

// A correction that comes later than the vehicle's response pushes it along with a gust that has turned
// round.
TEST(DisturbanceObserver, KnowsTheWindOfNowWhereTheVehicleGainsSpeedSlowly) {
  constexpr double kStep = 1.0 / 30.0, kGainMps2 = 0.5, kWindMps = 0.2, kShownSec = 30.0;
  auto observe = observer();
  double speed_mps = 0.0;
  for (double t = 0.0; t < kShownSec + 2.0 * DisturbanceObserver::kWindSec; t += kStep) {
    const double told_mps = std::fmod(t, 6.0) < 3.0 ? 0.75 : 0.0;
    speed_mps += std::clamp(told_mps - speed_mps, -kGainMps2 * kStep, kGainMps2 * kStep);
    observe.update({0.0, speed_mps + (t < kShownSec ? kWindMps : -kWindMps), 0.0}, {0.0, told_mps, 0.0},
                   kStep);
  }
  ASSERT_LT(observe.response().accelerationMps2(), 1.0);
  EXPECT_LT(observe.disturbance().y(), -0.5 * kWindMps);
}

TEST(DisturbanceObserver, IsBounded) {
  auto observe = observer();
  for (int i = 0; i < 1000; ++i) observe.update({9, 9, 9}, {0, 0, 0}, 0.03);
  EXPECT_NEAR(observe.disturbance().norm(), ApproachParams().max_wind_mps, 1e-12);
  observe.reset();
  EXPECT_EQ(observe.disturbance().norm(), 0.0);
}

TEST(DisturbanceObserver, OneWildSampleIsForgottenAtOnce) {
  auto observe = observer();
  observe.update({0, 50, 0}, {0, 0, 0}, 0.033);
  const ApproachParams params;
  EXPECT_LE(observe.disturbance().norm(), params.max_wind_mps * 0.033 / DisturbanceObserver::kWindSec);
}

// ArduCopter 4.0 overshoots to make up for its lag, and returns slowly after a stop.
TEST(DisturbanceObserver, WhatAnAutopilotMakesUpForIsNoWind) {
  auto observe = observer();
  double speed_mps = 0.0, behind_m = 0.0, squares_m2ps = 0.0;
  constexpr double kStep = 1.0 / 30.0, kPullHz = 0.36, kLagSec = 0.64, kSettledSec = 8.0, kSec = 40.0;
  for (double t = 0.0; t < kSec; t += kStep) {
    const double told_mps = std::fmod(t, 12.0) < 6.0 ? 0.75 : 0.0;
    speed_mps += kStep / kLagSec * (told_mps + kPullHz * behind_m - speed_mps);
    behind_m += kStep * (told_mps - speed_mps);
    observe.update({0.0, speed_mps, 0.0}, {0.0, told_mps, 0.0}, kStep);
    if (t > kSettledSec) squares_m2ps += kStep * observe.disturbance().squaredNorm();
  }
  EXPECT_LT(std::sqrt(squares_m2ps / (kSec - kSettledSec)), 0.025);
}

// With the assumed response the vertical axis would be the fastest, and its lag would count as wind.
TEST(DisturbanceObserver, UpAndDownIsAnsweredAsTheRestIsAsLongAsGustsHideIt) {
  constexpr double kStep = 1.0 / 30.0, kGainMps2 = 0.6, kCalmSec = 10.0, kGustMps = 0.3;
  auto observe = observer();
  Eigen::Vector3d velocity_mps(0, 0, 0);
  for (double t = 0.0; t < 20.0; t += kStep) {
    const bool is_calm = t < kCalmSec;
    const double climb_mps = std::fmod(t, 2.0) < 1.0 ? 0.15 : -0.15;
    const Eigen::Vector3d told_mps(std::fmod(t, 6.0) < 3.0 ? 0.75 : 0.0, 0.0, is_calm ? 0.0 : climb_mps);
    const Eigen::Vector3d change_mps = told_mps - velocity_mps;
    velocity_mps += std::min(1.0, kGainMps2 * kStep / std::max(1e-9, change_mps.norm())) * change_mps;
    const double gust_mps = is_calm ? 0.0 : kGustMps * std::sin(1.7 * t);
    observe.update(velocity_mps + Eigen::Vector3d(0.0, 0.0, gust_mps), told_mps, kStep);
  }
  ASSERT_LT(observe.response().accelerationMps2(), 1.0);
  EXPECT_EQ(observe.climbResponse().accelerationMps2(), observe.response().accelerationMps2());
  EXPECT_EQ(observe.climbResponse().responseSec(), observe.response().responseSec());
}

TEST(DisturbanceObserver, TellsGustsFromWind) {
  auto steady = observer(), gusty = observer();
  for (int i = 0; i < 600; ++i) {
    const double t = 0.033 * i;
    steady.update({0, 0.3, 0}, {0, 0, 0}, 0.033);
    gusty.update({0, 0.4 * std::sin(2.0 * t), 0}, {0, 0, 0}, 0.033);
  }
  const double usual_mps = std::sqrt(observer().gusts()(1, 1));  // decays with time
  EXPECT_LT(std::sqrt(steady.gusts()(1, 1)), 0.4 * usual_mps);
  EXPECT_NEAR(std::sqrt(gusty.gusts()(1, 1)), 0.2, 0.08);
  EXPECT_LT(std::sqrt(gusty.gusts()(0, 0)), 0.3 * usual_mps);
  steady.reset();
  EXPECT_EQ(std::sqrt(steady.gusts()(1, 1)), usual_mps);
}

TEST(DisturbanceObserver, IgnoresWhatIsNoNumber) {
  auto observe = observer();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  observe.update({nan, 0, 0}, {0, 0, 0}, 0.03);
  observe.update({1, 0, 0}, {nan, 0, 0}, 0.03);
  observe.update({1, 0, 0}, {0, 0, 0}, nan);
  observe.update({1, 0, 0}, {0, 0, 0}, -1.0);
  EXPECT_EQ(observe.disturbance().norm(), 0.0);
}

TEST(DisturbanceObserver, TellsAVehicleThatGoesBesideWhatItIsToldFromOneInWind) {
  const NavigatorParams params;
  const auto turnedBy = [&](double turn_rad, const Eigen::Vector3d& wind_mps, int flown_steps) {
    DisturbanceObserver observer(params.vehicle, params.approach);
    for (int i = 0; i < 100; ++i) observer.update(wind_mps, Eigen::Vector3d::Zero(), 0.03);
    for (int i = 0; i < flown_steps; ++i) {
      const Eigen::Vector3d told(0.8, 0.0, 0.0);
      observer.update(geometry::yawRotation(turn_rad) * told + wind_mps, told, 0.03);
    }
    return observer.turnedRad();
  };
  const Eigen::Vector3d calm(0.0, 0.0, 0.0), wind_mps(0.0, params.approach.max_wind_mps, 0.0);
  EXPECT_NEAR(turnedBy(1.2, calm, 100), 1.2, 0.05);
  EXPECT_NEAR(turnedBy(-2.5, wind_mps, 100), -2.5, 0.2);
  EXPECT_NEAR(turnedBy(0.0, wind_mps, 100), 0.0, 0.3);
  constexpr int kOneAndAHalfSec = 50;
  for (const double turn_rad : {0.5 * M_PI, -0.5 * M_PI, 3.0})
    EXPECT_GT(std::abs(turnedBy(turn_rad, wind_mps, kOneAndAHalfSec)), params.input.max_turned_rad)
        << turn_rad;
  EXPECT_EQ(DisturbanceObserver(params.vehicle, params.approach).turnedRad(), 0.0);
}

// A gust that begins together with a slow vehicle's motion is no turn of its axes.
TEST(DisturbanceObserver, OneGustTurnsNothing) {
  const NavigatorParams params;
  constexpr double kGustMps = 0.55, kStep = 0.03;
  for (double begins_sec = 0.0; begins_sec < 6.0; begins_sec += 0.5) {
    DisturbanceObserver observer(params.vehicle, params.approach);
    double speed_mps = 0.0, most_rad = 0.0;
    for (double t = 0.0; t < 8.0; t += kStep) {
      const double told_mps = t < 3.0 ? 0.0 : 0.9;
      speed_mps += std::clamp(told_mps - speed_mps, -0.6 * kStep, 0.6 * kStep);  // 0.6 m/s^2
      const double gust_mps = t > begins_sec ? kGustMps * std::sin(1.5 * (t - begins_sec)) : 0.0;
      observer.update({speed_mps, gust_mps, 0.0}, {told_mps, 0.0, 0.0}, kStep);
      most_rad = std::max(most_rad, std::abs(observer.turnedRad()));
    }
    EXPECT_LT(most_rad, params.input.max_turned_rad) << begins_sec;
  }
}

TEST(DisturbanceObserver, AVehicleThatStandsAgainstTheWindGoesBesideNothing) {
  const NavigatorParams params;
  for (const double blown_aside_mps : {-0.1, 0.1}) {
    DisturbanceObserver observer(params.vehicle, params.approach);
    for (int i = 0; i < 300; ++i) observer.update({-0.05, blown_aside_mps, 0.0}, {0.5, 0.0, 0.0}, 0.03);
    EXPECT_EQ(observer.turnedRad(), 0.0);
  }
}

// The slowest climbs that the navigator commands; the height by which it may go wrong is small.
TEST(DisturbanceObserver, TellsADownwardZAxisWithinOneAndAHalfMetres) {
  const NavigatorParams params;
  constexpr double kStep = 0.03, kDowndraughtMps = 0.25, kMostM = 1.5;
  const auto climbedM = [&](double told_mps, double sign, double wind_mps) {
    DisturbanceObserver observer(params.vehicle, params.approach);
    double velocity_mps = 0.0, climbed_m = 0.0;
    for (double t = 0.0; t < 30.0 && !observer.isUpsideDown(); t += kStep) {
      velocity_mps += kStep / params.vehicle.response_sec * (told_mps + wind_mps - velocity_mps);
      climbed_m += kStep * velocity_mps;
      observer.update({0.0, 0.0, sign * velocity_mps}, {0.0, 0.0, told_mps}, kStep);
    }
    return observer.isUpsideDown() ? std::abs(climbed_m) : std::numeric_limits<double>::infinity();
  };
  for (const double told_mps :
       {params.search.climb_speed_mps, -params.search.climb_speed_mps, params.align.vertical_speed_mps}) {
    EXPECT_LT(climbedM(told_mps, -1.0, 0.0), kMostM) << told_mps;
    EXPECT_TRUE(std::isinf(climbedM(told_mps, 1.0, 0.0))) << told_mps;
    EXPECT_TRUE(std::isinf(climbedM(told_mps, 1.0, std::copysign(kDowndraughtMps, -told_mps)))) << told_mps;
  }
}

// A height that is kept against gusts is told up while the vehicle still goes down.
TEST(DisturbanceObserver, GustsFromAboveTurnNoAxis) {
  const NavigatorParams params;
  constexpr double kStep = 0.03;
  for (const double gust_mps : {0.3, 0.6})
    for (const double gust_hz : {0.05, 0.1, 0.2, 0.4, 0.8}) {
      DisturbanceObserver observer(params.vehicle, params.approach);
      double velocity_mps = 0.0, height_m = 0.0;
      for (double t = 0.0; t < 60.0; t += kStep) {
        const double told_mps = std::clamp(-1.2 * height_m, -0.3, 0.3);
        velocity_mps += kStep / params.vehicle.response_sec * (told_mps - velocity_mps);
        const double all_mps = velocity_mps + gust_mps * std::cos(2.0 * M_PI * gust_hz * t);
        height_m += kStep * all_mps;
        observer.update({0.0, 0.0, all_mps}, {0.0, 0.0, told_mps}, kStep);
        ASSERT_FALSE(observer.isUpsideDown()) << gust_mps << " m/s at " << gust_hz << " Hz, after " << t;
      }
    }
}

TEST(DisturbanceObserver, FeelsGustsWhileItIsToldToSteerAgainstThem) {
  constexpr double kStep = 0.03, kGustMps = 0.3;
  const NavigatorParams params;
  const auto lateralGustOf = [&](double gust_mps) {
    DisturbanceObserver observer(params.vehicle, params.approach);
    double velocity_mps = 0.0, offset_m = 0.0;
    for (double t = 0.0; t < 6.0; t += kStep) {
      const double told_mps = 0.5 * std::sin(2.0 * t) - 1.75 * offset_m;  // never steady
      const double wind_mps = gust_mps * std::sin(4.0 * t);
      velocity_mps += kStep / params.vehicle.response_sec * (told_mps - velocity_mps);
      offset_m += kStep * wind_mps;
      observer.update({0.8, velocity_mps + wind_mps, 0.0}, {0.8, told_mps, 0.0}, kStep);
    }
    return std::sqrt(observer.gusts()(1, 1));
  };
  EXPECT_LT(lateralGustOf(0.0), 0.06);
  EXPECT_GT(lateralGustOf(kGustMps), 0.25 * kGustMps);
  EXPECT_GT(lateralGustOf(2.0 * kGustMps), 1.5 * lateralGustOf(kGustMps));
}

TEST(DisturbanceObserver, FeelsAGustAsStronglyWhereTheVehicleSeemsToAnswerSlowly) {
  constexpr double kStep = 0.03, kGustMps = 0.3;
  const auto lateralGustWith = [&](double response_sec) {
    VehicleParams vehicle;
    vehicle.response_sec = response_sec;
    DisturbanceObserver observer(vehicle, ApproachParams());
    for (double t = 0.0; t < 6.0; t += kStep)
      observer.update({0.8, kGustMps * std::sin(4.0 * t), 0.0}, {0.8, 0.0, 0.0}, kStep);
    return std::sqrt(observer.gusts()(1, 1));
  };
  EXPECT_GT(lateralGustWith(0.9), 0.9 * lateralGustWith(0.3));
}

}  // namespace window_ingress::navigation::disturbance_observer_test
