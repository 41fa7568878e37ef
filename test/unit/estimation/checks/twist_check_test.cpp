#include "estimation/checks/twist_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::estimation::twist_check_test {

using Meaning =
    std::function<Eigen::Vector3d(const Eigen::Matrix3d& R, const Eigen::Vector3d& velocity_odom)>;

/// Flies a square at some heading. The reported twist is interpreted in the body frame.
FramesVerdict fly(double heading_rad, unsigned seed, const Meaning& twist, double noise_mps = 0.03,
                  double side_sec = 1.5, const Eigen::Vector3d& bias_base_mps = {0, 0, 0},
                  double slide_mps = 0.0) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, 1.0);
  TwistCheck check;
  Eigen::Vector3d position(3, -2, 1);
  const int side = static_cast<int>(50 * side_sec);
  for (int i = 0; i < 2 * side; ++i) {
    const Eigen::Vector3d velocity =
        i < side ? Eigen::Vector3d(0.6, 0.1, 0.05) : Eigen::Vector3d(-0.1, 0.5, -0.05);
    position += velocity / 50.0;
    if (i < 150) position.x() += slide_mps / 50.0;
    const Eigen::Matrix3d R = geometry::yawRotation(heading_rad);
    const Eigen::Vector3d jitter(noise(random), noise(random), noise(random));
    const Eigen::Vector3d reported = twist(R, velocity + noise_mps * jitter) + bias_base_mps;
    check.add(i / 50.0, geometry::makePose(R, position + 0.005 * jitter), R * reported);
  }
  return check.verdict();
}

const Meaning kBody = [](const Eigen::Matrix3d& R, const Eigen::Vector3d& v) -> Eigen::Vector3d {
  return R.transpose() * v;
};
const Meaning kWorld = [](const Eigen::Matrix3d&, const Eigen::Vector3d& v) { return v; };

TEST(TwistCheck, AVelocityInBodyAxesIsGoodAtAnyHeading) {
  for (int i = 0; i < 200; ++i) EXPECT_EQ(fly(-3.1 + 0.031 * i, i, kBody).state, FramesVerdict::kGood) << i;
}

TEST(TwistCheck, AVelocityInWorldAxesIsNamedWhereTheHeadingShowsIt) {
  for (int i = 0; i < 200; ++i) {
    const double heading = 0.5 + i * (2.0 * M_PI - 1.0) / 200.0;
    const auto verdict = fly(heading, i, kWorld);
    EXPECT_EQ(verdict.state, FramesVerdict::kWrong) << heading;
    EXPECT_FALSE(verdict.what.empty());
  }
  EXPECT_NE(fly(1.0, 1, kWorld).what.find("world frame"), std::string::npos);
  EXPECT_EQ(fly(0.1, 1, kWorld).state, FramesVerdict::kGood) << "both are nearly the same";
}

TEST(TwistCheck, MeasuresHowThePositionWalksBesideABiasedVelocity) {
  double squares = 0.0;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> step(0.0, 0.07 * std::sqrt(1.0 / 50.0));
    TwistCheck walking, steady;
    Eigen::Vector3d way(0, 0, 1), walk(0, 0, 0);
    const Eigen::Vector3d velocity(0.7, 0.0, 0.0), bias(0.1, -0.2, 0.0);
    for (int i = 0; i < 400; ++i) {
      way += velocity / 50.0;
      walk.head<2>() += Eigen::Vector2d(step(random), step(random));
      const Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
      walking.add(i / 50.0, geometry::makePose(R, way + walk), velocity + bias);
      steady.add(i / 50.0, geometry::makePose(R, way), velocity + bias);
    }
    EXPECT_LT(steady.driftMPerSqrtSec(), 0.03);
    squares += walking.driftMPerSqrtSec() * walking.driftMPerSqrtSec() / 100.0;
  }
  EXPECT_NEAR(std::sqrt(squares), 0.07, 0.02);
  EXPECT_GT(TwistCheck().driftMPerSqrtSec(), 0.03) << "nothing seen yet";
}

TEST(TwistCheck, NamesExchangedAndMirroredAxes) {
  const auto exchanged = fly(0.7, 1, [](const Eigen::Matrix3d& R, const Eigen::Vector3d& v) {
    const Eigen::Vector3d body = R.transpose() * v;
    return Eigen::Vector3d(body.y(), body.x(), body.z());
  });
  EXPECT_NE(exchanged.what.find("exchanged"), std::string::npos) << exchanged.what;
  const auto ned = fly(0.7, 1, [](const Eigen::Matrix3d& R, const Eigen::Vector3d& v) {
    const Eigen::Vector3d body = R.transpose() * v;
    return Eigen::Vector3d(body.x(), -body.y(), -body.z());
  });
  EXPECT_NE(ned.what.find("forward-right-down"), std::string::npos) << ned.what;
  const auto none = fly(
      0.7, 1, [](const Eigen::Matrix3d&, const Eigen::Vector3d&) { return Eigen::Vector3d::Zero(); }, 0.0,
      5.0);
  EXPECT_NE(none.what.find("does not fit"), std::string::npos) << none.what;
}

TEST(TwistCheck, ABiasFixedInTheBodyIsNoFault) {
  for (int i = 0; i < 100; ++i) {
    const double heading = -3.1 + 0.062 * i;
    const Eigen::Vector3d bias = geometry::yawRotation(0.1 * i) * Eigen::Vector3d(0.29, 0.0, 0.0);
    EXPECT_NE(fly(heading, i, kBody, 0.03, 8.0, bias).state, FramesVerdict::kWrong) << heading;
    const auto world = fly(heading, i, kWorld, 0.03, 8.0, bias);
    if (std::abs(heading) > 0.6) {
      EXPECT_EQ(world.state, FramesVerdict::kWrong) << heading;
    }
  }
}

TEST(TwistCheck, ABiasIsHardlyEverTakenForOtherAxesOnASlowFirstMetre) {
  int alarms = 0;
  for (int i = 0; i < 400; ++i) {
    const Eigen::Matrix3d R = geometry::yawRotation(-3.1 + 0.0155 * i);
    const Eigen::Vector3d velocity = geometry::yawRotation(0.7 * i) * Eigen::Vector3d(0.3, 0.0, 0.0);
    const Eigen::Vector3d bias = geometry::yawRotation(1.1 * i) * Eigen::Vector3d(0.19, 0.0, 0.0);
    TwistCheck check;
    bool is_accused = false;
    for (int k = 0; k < 300; ++k) {
      check.add(k / 50.0, geometry::makePose(R, velocity * k / 50.0), velocity + R * bias);
      is_accused = is_accused || check.verdict().state == FramesVerdict::kWrong;
    }
    alarms += is_accused;
  }
  EXPECT_LE(alarms, 16);
}

// Climbs or aligns slowly, then flies on at a heading near that of the frame, its velocity off to the side
// for some seconds as a satellite receiver's is.
TEST(TwistCheck, AWanderingVelocityIsNotTakenForAxesTurnedByASmallHeading) {
  for (unsigned seed = 1; seed <= 1000; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(0.0, 1.0);
    std::normal_distribution<double> step(0.0, 0.01 * std::sqrt(1.0 / 30.0));
    const Eigen::Matrix3d R = geometry::yawRotation(0.15 + 0.2 * any(random));
    const double slow_sec = 8.0 * any(random), wander_sec = 6.0 * any(random);
    const double bias_mps = (any(random) < 0.5 ? -1.0 : 1.0) * (0.1 + 0.08 * any(random));
    const Eigen::Vector3d slow(0.1 * any(random), 0.5 * any(random) - 0.25, 0.1 * any(random) - 0.05);
    const Eigen::Vector3d on =
        geometry::yawRotation(0.6 * any(random) - 0.3) * Eigen::Vector3d(0.3 + 0.5 * any(random), 0.0, 0.0);
    TwistCheck check;
    Eigen::Vector3d position(0, 0, 1);
    for (int k = 0; k < 30 * 20; ++k) {
      const double now_sec = k / 30.0;
      const Eigen::Vector3d velocity = R * (now_sec < slow_sec ? slow : on);
      const double part = std::clamp(std::min(now_sec - wander_sec, wander_sec + 8.0 - now_sec), 0.0, 1.0);
      position += velocity / 30.0 + Eigen::Vector3d(step(random), step(random), 0.0);
      check.add(now_sec, geometry::makePose(R, position),
                velocity + R * Eigen::Vector3d(0.0, part * bias_mps, 0.0));
      ASSERT_EQ(check.verdict().what.find("frame"), std::string::npos)
          << seed << ": " << check.verdict().what;
    }
  }
}

TEST(TwistCheck, HoveringWithABiasIsNoFault) {
  TwistCheck check;
  for (int i = 0; i < 50 * 60; ++i) {
    const Eigen::Matrix3d R = geometry::yawRotation(0.01 * i);  // during the search
    check.add(i / 50.0, geometry::makePose(R, {0, 0, 1}), R * Eigen::Vector3d(0.2, 0.15, 0.0));
    ASSERT_NE(check.verdict().state, FramesVerdict::kWrong) << i / 50.0 << ": " << check.verdict().what;
  }
}

TEST(TwistCheck, ASlideOfThePositionIsNoFault) {
  for (const double slide_mps : {-2.0, -0.5, 0.3, 1.0, 2.0})
    for (int i = 0; i < 20; ++i)
      EXPECT_NE(fly(0.3 * i, i, kBody, 0.03, 8.0, {0, 0, 0}, slide_mps).state, FramesVerdict::kWrong)
          << slide_mps;
}

TEST(TwistCheck, SaysNothingWithoutAWayAndIgnoresWhatIsNotFinite) {
  TwistCheck check;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto T = geometry::makePose(Eigen::Matrix3d::Identity(), {0, 0, 1});
  for (int i = 0; i < 500; ++i) check.add(i / 50.0, T, {0.01, 0, 0});
  EXPECT_EQ(check.verdict().state, FramesVerdict::kUndecided);
  check.add(nan, T, {0, 0, 0});
  check.add(11.0, T, {nan, 0, 0});
  check.add(11.1, geometry::makePose(Eigen::Matrix3d::Identity(), {nan, 0, 1}), {0, 0, 0});
  EXPECT_EQ(check.verdict().state, FramesVerdict::kUndecided);
}

TEST(TwistCheck, AWayOfDriftAloneIsNoFault) {
  std::mt19937 random(5);
  std::normal_distribution<double> step(0.0, 0.05 * std::sqrt(1.0 / 50.0));
  TwistCheck check;
  Eigen::Vector3d position(0, 0, 1);
  for (int i = 0; i < 50 * 600; ++i) {
    position += Eigen::Vector3d(step(random), step(random), 0.4 * step(random));
    check.add(i / 50.0, geometry::makePose(geometry::yawRotation(1.0), position), Eigen::Vector3d::Zero());
    ASSERT_NE(check.verdict().state, FramesVerdict::kWrong) << i / 50.0 << ": " << check.verdict().what;
  }
}

TEST(TwistCheck, APositionThatStandsStillWhileTheVehicleFliesIsAFault) {
  TwistCheck check;
  for (int i = 0; i < 500; ++i)
    check.add(i / 50.0, geometry::makePose(geometry::yawRotation(1.0), {0, 0, 1}), {0.5, 0.1, 0.0});
  EXPECT_EQ(check.verdict().state, FramesVerdict::kWrong);
}

TEST(TwistCheck, WhatDoesNotFitIsTakenBackWhereMostFitsAgain) {
  TwistCheck check;
  Eigen::Vector3d position(0, 0, 1);
  for (int i = 0; i < 900; ++i) {
    const Eigen::Vector3d velocity(0.5, 0.1, 0.0);
    if (i >= 500) position += velocity / 50.0;  // stands still before
    check.add(i / 50.0, geometry::makePose(geometry::yawRotation(1.0), position), velocity);
    if (i == 499) {
      EXPECT_EQ(check.verdict().state, FramesVerdict::kWrong);
    }
  }
  EXPECT_EQ(check.verdict().state, FramesVerdict::kUndecided) << check.verdict().what;
}

// Velocity in the body frame with a constant `bias`, and a position that drifts like a satellite receiver's.
TEST(TwistCheck, ABiasThatPassedForOtherAxesIsRefutedOnceItIsKnown) {
  int accused = 0, lasting = 0;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> step(0.0, 0.03 * std::sqrt(1.0 / 50.0));
    const Eigen::Matrix3d R = geometry::yawRotation(1.0);
    const Eigen::Vector3d first(0.4, 0.0, 0.0), then(-0.1, 0.25, 0.0);
    const Eigen::Vector3d bias =
        R * (first - R.transpose() * first);  // in odom: `first` in axes of the world
    TwistCheck check;
    Eigen::Vector3d position(0, 0, 1);
    bool is_accused = false;
    for (int i = 0; i < 50 * 25; ++i) {
      const Eigen::Vector3d velocity = i < 50 * 8 ? first : then;
      position += velocity / 50.0 + Eigen::Vector3d(step(random), step(random), 0.0);
      check.add(i / 50.0, geometry::makePose(R, position), velocity + bias);
      is_accused = is_accused || check.verdict().state == FramesVerdict::kWrong;
    }
    accused += is_accused;
    lasting += check.verdict().state == FramesVerdict::kWrong;
  }
  EXPECT_LE(lasting, 5);
  EXPECT_GT(accused, 50) << "or nothing is there to be refuted";
}

TEST(TwistCheck, AGapOrAJumpBackIsNoWay) {
  TwistCheck check;
  for (int i = 0; i < 20; ++i) {
    check.add(i, geometry::makePose(Eigen::Matrix3d::Identity(), {0.3 * i, 0, 1}), {0, 0, 0});
    check.add(-i, geometry::makePose(Eigen::Matrix3d::Identity(), {0.3 * i, 0, 1}), {0, 0, 0});
  }
  EXPECT_EQ(check.verdict().state, FramesVerdict::kUndecided);
}

}  // namespace window_ingress::estimation::twist_check_test
