#include "navigation/motion/continuous_odometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::navigation::continuous_odometry_test {

constexpr double kStep = 1.0 / 30.0;

/// A vehicle on a curve, with erroneous odometry.
struct Curve {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double yaw = 0.2, time = 10.0, speed = 0.8, aside = 0.1, climb = 0.05;
  // Errors: offset of the position, turn of the heading, turn of the axes of the positions, bias of the
  // velocity in the body frame.
  Eigen::Vector3d shift = Eigen::Vector3d::Zero(), bias_base = Eigen::Vector3d::Zero();
  double heading_turn = 0.0, axes_turn = 0.0, noise_m = 0.003, noise_mps = 0.0;
  std::mt19937 random{1};

  Eigen::Vector3d velocity() const {
    return geometry::yawRotation(yaw) * Eigen::Vector3d(speed, aside, climb);
  }
  VehicleState step() {
    time += kStep;
    position += velocity() * kStep;
    yaw += 0.1 * kStep;
    std::normal_distribution<double> noise(0.0, noise_m);
    const Eigen::Vector3d off_m{noise(random), noise(random), noise(random)};  // braces: in this order
    VehicleState odometry;
    odometry.stamp_sec = time;
    odometry.T_odom_base = geometry::makePose(geometry::yawRotation(yaw + heading_turn),
                                              geometry::yawRotation(axes_turn) * position + shift + off_m);
    odometry.velocity_odom_mps =
        geometry::yawRotation(heading_turn) * (velocity() + geometry::yawRotation(yaw) * bias_base);
    if (noise_mps > 0.0) {
      std::normal_distribution<double> wild(0.0, noise_mps);
      odometry.velocity_odom_mps += Eigen::Vector3d{wild(random), wild(random), wild(random)};
    }
    return odometry;
  }
  double errorM(const std::optional<VehicleState>& smooth) const {
    return smooth ? (smooth->T_odom_base.translation() - position).norm() : 1e9;
  }
  double headingError(const std::optional<VehicleState>& smooth) const {
    return smooth ? std::abs(geometry::wrapAngle(geometry::yawOf(smooth->T_odom_base.linear()) - yaw)) : 1e9;
  }
};

TEST(ContinuousOdometry, IsTheSameToTheBitWhereNothingIsWrong) {
  Curve curve;
  ContinuousOdometry continuous;
  for (int i = 0; i < 600; ++i) {
    const VehicleState odometry = curve.step();
    const auto smooth = continuous.add(odometry);
    ASSERT_TRUE(smooth);
    ASSERT_EQ(smooth->T_odom_base.matrix(), odometry.T_odom_base.matrix());
    ASSERT_EQ(smooth->velocity_odom_mps, odometry.velocity_odom_mps);
    ASSERT_TRUE(continuous.T_smooth_odom(curve.time).matrix().isIdentity(0.0));
  }
  EXPECT_LT(continuous.disagreementMps(), 0.02);
}

TEST(ContinuousOdometry, JumpsAndSlidesDoNotMoveTheVehicle) {
  for (const double slide_sec : {0.0, 0.3, 2.0}) {
    for (const double slide_m : {0.06, 0.3, 1.0, 4.0}) {
      if (slide_sec > 0.0 && slide_m / slide_sec < 0.15) continue;  // so slow that it counts as drift
      for (unsigned seed = 1; seed <= 20; ++seed) {
        Curve curve;
        curve.random.seed(seed);
        ContinuousOdometry continuous;
        double worst_m = 0.0;
        for (int i = 0; i < 300; ++i) {
          const double part = slide_sec > 0.0 ? std::min(1.0, std::max(0.0, curve.time - 14.0) / slide_sec)
                                              : (curve.time > 14.0 ? 1.0 : 0.0);
          curve.shift = part * slide_m * Eigen::Vector3d(0.6, -0.8, 0.0);
          worst_m = std::max(worst_m, curve.errorM(continuous.add(curve.step())));
        }
        EXPECT_LT(worst_m, ContinuousOdometry::kUnexplainedM + 0.03)
            << slide_m << " m in " << slide_sec << " s, seed " << seed;
      }
    }
  }
}

TEST(ContinuousOdometry, PlacesBesideTheVehicleStayBesideIt) {
  Curve curve;
  ContinuousOdometry continuous;
  for (int i = 0; i < 300; ++i) {
    if (i == 100) curve.shift = {2.0, 1.0, 0.5};
    if (i == 200) curve.heading_turn = curve.axes_turn = 0.4;
    const VehicleState odometry = curve.step();
    const auto smooth = continuous.add(odometry);
    const Eigen::Vector3d seen_base(3.0, 0.5, -0.2);
    const Eigen::Vector3d place = continuous.T_smooth_odom(curve.time) * (odometry.T_odom_base * seen_base);
    ASSERT_TRUE(place.isApprox(smooth->T_odom_base * seen_base, 1e-9));
  }
}

/// \return whether the vehicle stayed within centimetres.
bool staysWhenHeadingJumps(double turn_rad, bool axes_turn, unsigned seed) {
  Curve curve;
  curve.random.seed(seed);
  ContinuousOdometry continuous;
  double worst_m = 0.0, worst_rad = 0.0;
  for (int i = 0; i < 240; ++i) {
    if (i == 120) {
      curve.heading_turn = turn_rad;
      if (axes_turn) {
        curve.axes_turn = turn_rad;
        curve.shift = curve.position - geometry::yawRotation(turn_rad) * curve.position;
      }
    }
    const auto smooth = continuous.add(curve.step());
    worst_m = std::max(worst_m, curve.errorM(smooth));
    worst_rad = std::max(worst_rad, curve.headingError(smooth));
  }
  EXPECT_LT(worst_m, 0.15) << turn_rad << axes_turn;
  EXPECT_LT(worst_rad, 0.03) << turn_rad << axes_turn;
  const Eigen::Vector3d forward = continuous.inOdomAxes(Eigen::Vector3d::UnitX());
  EXPECT_NEAR(std::atan2(forward.y(), forward.x()), axes_turn ? turn_rad : 0.0, 0.01) << turn_rad;
  EXPECT_NEAR(continuous.headingErrorRad(), axes_turn ? 0.0 : turn_rad, 0.01) << turn_rad;
  return worst_m < ContinuousOdometry::kUnexplainedM + 0.035;
}

TEST(ContinuousOdometry, AHeadingThatJumpsIsCorrectedWhetherOrNotTheAxesTurnAlong) {
  int stayed = 0;
  for (const bool axes_turn : {false, true})
    for (const double turn_rad : {-0.5, 0.15, 0.5, 1.57, 3.0})
      for (unsigned seed = 1; seed <= 20; ++seed) stayed += staysWhenHeadingJumps(turn_rad, axes_turn, seed);
  EXPECT_GE(stayed, 180);  // of 200
}

TEST(ContinuousOdometry, AHeadingThatJumpsAndComesBackBeforeTheVehicleHasMovedTurnsNothing) {
  for (int seed = 1; seed <= 20; ++seed) {
    Curve curve;
    ContinuousOdometry continuous;
    curve.random.seed(seed);
    curve.speed = curve.aside = 0.0;
    curve.climb = 0.3;
    double worst_m = 0.0;
    for (int i = 0; i < 240; ++i) {
      if (i == 30) curve.heading_turn = 0.52;
      if (i == 36) curve.heading_turn = 0.04;
      if (i == 60) curve.speed = 0.8;
      worst_m = std::max(worst_m, curve.errorM(continuous.add(curve.step())));
    }
    EXPECT_LT(worst_m, ContinuousOdometry::kUnexplainedM + 0.03);
    EXPECT_LT(continuous.disagreementMps(), 0.05);
  }
}

TEST(ContinuousOdometry, AHeadingThatJumpsWhileTheVehicleHoversInADriftIsMappedRightly) {
  for (int seed = 1; seed <= 20; ++seed) {
    for (const bool axes_turn : {false, true}) {
      Curve curve;
      ContinuousOdometry continuous;
      curve.random.seed(seed);
      for (int i = 0; i < 900; ++i) {
        curve.speed = i < 600 ? 0.05 * std::sin(2.0 * i * kStep) : 0.8;  // to and fro, then on
        curve.aside = i < 600 ? 0.05 * std::cos(2.0 * i * kStep) : 0.1;
        curve.bias_base.x() = 0.012;
        if (i == 60) curve.heading_turn = 0.5;
        if (i == 60 && axes_turn) {
          curve.axes_turn = 0.5;
          curve.shift += curve.position - geometry::yawRotation(0.5) * curve.position;
        }
        continuous.add(curve.step());
      }
      const Eigen::Vector3d forward = continuous.inOdomAxes(Eigen::Vector3d::UnitX());
      EXPECT_NEAR(std::atan2(forward.y(), forward.x()), axes_turn ? 0.5 : 0.0, 0.02) << seed;
    }
  }
}

TEST(ContinuousOdometry, AHeadingThatComesBackInFlightTurnsNoAxesWhateverTheNoise) {
  int wrong = 0;
  for (unsigned seed = 1; seed <= 400; ++seed) {
    Curve curve;
    curve.random.seed(seed);
    curve.speed = 0.9, curve.noise_m = 0.008, curve.noise_mps = 0.05;
    ContinuousOdometry continuous;
    for (int i = 0; i < 300; ++i) {
      if (i == 30) curve.heading_turn = -0.285;
      if (i == 150) curve.heading_turn = 0.0;
      continuous.add(curve.step());
    }
    const Eigen::Vector3d forward = continuous.inOdomAxes(Eigen::Vector3d::UnitX());
    wrong += std::abs(std::atan2(forward.y(), forward.x())) > 0.05;
  }
  EXPECT_EQ(wrong, 0);
}

// If the vehicle turns meanwhile, two equal jumps appear different, for example as 0.155 and 0.111 rad.
TEST(ContinuousOdometry, AHeadingThatComesBackIsTakenBackThoughTheVehicleTurns) {
  for (const double turn_rad : {-0.15, 0.1, 0.11, 0.12, 0.13}) {
    Curve curve;
    ContinuousOdometry continuous;
    for (int i = 0; i < 400; ++i) {
      curve.heading_turn = i >= 60 && i < 110 ? turn_rad : 0.0;
      if (i < 200) curve.yaw += 0.4 * kStep;
      continuous.add(curve.step());
    }
    EXPECT_NEAR(continuous.headingErrorRad(), 0.0, 0.05) << turn_rad;
    const Eigen::Vector3d forward = continuous.inOdomAxes(Eigen::Vector3d::UnitX());
    EXPECT_NEAR(std::atan2(forward.y(), forward.x()), 0.0, 0.02) << turn_rad;
  }
}

// The motion has shown that only the attitude was wrong. When the attitude is right again, nothing has to be
// decided, although the vehicle hovers and its odometry drifts.
TEST(ContinuousOdometry, AHeadingThatComesBackWhileTheVehicleHoversTurnsNoAxes) {
  int wrong = 0;
  for (unsigned seed = 1; seed <= 400; ++seed) {
    Curve curve;
    curve.random.seed(seed);
    curve.noise_m = 0.02;
    ContinuousOdometry continuous;
    for (int i = 0; i < 600; ++i) {
      curve.heading_turn = i >= 30 && i < 150 ? -0.3 : 0.0;
      if (i >= 140 && i < 500) curve.speed = curve.aside = curve.climb = 0.0;
      if (i >= 500) curve.speed = 0.8;
      continuous.add(curve.step());
    }
    const Eigen::Vector3d forward = continuous.inOdomAxes(Eigen::Vector3d::UnitX());
    wrong += std::abs(std::atan2(forward.y(), forward.x())) > 0.05;
  }
  EXPECT_EQ(wrong, 0);
}

// A displacement in a gap is no error of the velocity.
TEST(ContinuousOdometry, AGapChangesNoVelocityAfterIt) {
  Curve curve;
  ContinuousOdometry continuous;
  for (int i = 0; i < 600; ++i) continuous.add(curve.step());
  for (int i = 0; i < 9; ++i) curve.step();  // lost
  curve.shift.x() = 0.3;
  for (int i = 0; i < 30; ++i) {
    const auto smooth = continuous.add(curve.step());
    ASSERT_TRUE(smooth);
    EXPECT_LT((continuous.unbiased(*smooth) - curve.velocity()).norm(), 0.1) << i;
  }
}

// Then neither the motion of the position nor the turned motion agrees with the velocity.
TEST(ContinuousOdometry, AHeadingThatJumpsBesideAVelocityThatWandersTurnsNoAxes) {
  int wrong = 0;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    Curve curve;
    curve.random.seed(seed);
    ContinuousOdometry continuous;
    for (int i = 0; i < 600; ++i) {
      const double phase = 0.5 * curve.time + seed;
      curve.bias_base = {0.17 * std::sin(phase), 0.17 * std::cos(phase), 0.0};
      curve.heading_turn = i >= 200 && i < 320 ? -0.3 : 0.0;
      curve.speed = i < 300 ? 0.1 : 0.6;
      continuous.add(curve.step());
    }
    const Eigen::Vector3d forward = continuous.inOdomAxes(Eigen::Vector3d::UnitX());
    wrong += std::abs(std::atan2(forward.y(), forward.x())) > 0.05;
  }
  EXPECT_EQ(wrong, 0);
}

TEST(ContinuousOdometry, ASlideAtTheStartIsNoBias) {
  Curve curve;
  ContinuousOdometry continuous;
  double worst_m = 0.0;
  for (int i = 0; i < 600; ++i) {
    if (i < 90) curve.shift.y() += 0.2 * kStep;
    worst_m = std::max(worst_m, curve.errorM(continuous.add(curve.step())));
  }
  EXPECT_LT(worst_m, ContinuousOdometry::kUnexplainedM + 0.03);
  EXPECT_TRUE(continuous.isBiasKnown());
  EXPECT_LT(continuous.carriedM().norm(), 0.05);
}

// Half of the first pieces of the path are good and half slide. They scatter so widely that the slide could
// be chance.
TEST(ContinuousOdometry, ASlideSoonAfterTheStartIsNoChance) {
  for (const double slide_mps : {0.6, 0.95, 1.5})
    for (int begins = 6; begins < 120; begins += 6) {
      Curve curve;
      ContinuousOdometry continuous;
      double worst_m = 0.0;
      for (int i = 0; i < begins + 120; ++i) {
        if (i >= begins && i < begins + 90) curve.shift.y() += slide_mps * kStep;
        worst_m = std::max(worst_m, curve.errorM(continuous.add(curve.step())));
      }
      EXPECT_LT(worst_m, 0.7) << slide_mps << " m/s from " << begins * kStep << " s on";
    }
}

TEST(ContinuousOdometry, WhatLastsLongerThanASlideIsABiasAndWhatItCarriedTheVehicleOffByIsKnown) {
  Curve curve;
  curve.bias_base = {0.15, -0.2, 0.0};
  ContinuousOdometry continuous;
  VehicleState smooth;
  while (!continuous.isBiasKnown() && curve.time < 20.0) {
    EXPECT_EQ(continuous.carriedM().norm(), 0.0);
    smooth = *continuous.add(curve.step());
  }
  EXPECT_NEAR(curve.time, 14.2, 0.3);
  const Eigen::Vector3d astray_m = smooth.T_odom_base.translation() - curve.position;
  EXPECT_GT(astray_m.norm(), 0.9);
  EXPECT_LT((continuous.carriedM() - astray_m).norm(), 0.1);
}

TEST(ContinuousOdometry, WhatIsNotSteadyYetIsUnexplained) {
  Curve curve;
  curve.bias_base = {0.15, -0.2, 0.0};
  ContinuousOdometry continuous;
  for (int i = 0; i < 100; ++i) continuous.add(curve.step());
  EXPECT_FALSE(continuous.isBiasKnown());
  EXPECT_NEAR(continuous.unexplainedMps(), 0.25, 0.02);
  const VehicleState last = *continuous.add(curve.step());
  EXPECT_EQ(continuous.unbiased(last), last.velocity_odom_mps);
}

TEST(ContinuousOdometry, WhatWasOffFromTheBeginningStaysUnexplainedUntilABiasIsKnown) {
  Curve curve;
  curve.bias_base = {0.15, -0.2, 0.0};
  ContinuousOdometry continuous;
  for (int i = 0; i < 120; ++i) continuous.add(curve.step());
  curve.bias_base.setZero();
  for (int i = 0; i < 75; ++i) continuous.add(curve.step());
  EXPECT_FALSE(continuous.isBiasKnown());
  EXPECT_GT(continuous.unexplainedMps(), 0.2);
}

// With a drifting position two seconds are too short to tell whether the velocity is right.
TEST(ContinuousOdometry, WhileThePositionWalksTheVelocityMayBeOffByMoreThanItsMiddleValue) {
  int overlooked = 0;
  for (unsigned seed = 1; seed <= 1000; ++seed) {
    Curve curve;
    curve.random.seed(seed);
    curve.bias_base = {0.0, 0.15, 0.0};
    ContinuousOdometry continuous;
    std::normal_distribution<double> step_m(0.0, 0.067 * std::sqrt(kStep));
    for (int i = 0; i < 75; ++i) {
      curve.shift += Eigen::Vector3d(step_m(curve.random), step_m(curve.random), 0);
      continuous.add(curve.step());
    }
    overlooked += continuous.unexplainedMps() < 0.08;
  }
  EXPECT_LE(overlooked, 15);  // 33 by the median alone
}

TEST(ContinuousOdometry, HowItsPositionWalksBesideItsVelocityIsMeasured) {
  for (const double walk_m_per_sqrt_sec : {0.0, 0.03, 0.07}) {
    double sum = 0.0;
    constexpr int kCurves = 20;
    for (unsigned seed = 1; seed <= kCurves; ++seed) {
      Curve curve;
      curve.random.seed(seed);
      ContinuousOdometry continuous;
      std::normal_distribution<double> step_m(0.0, walk_m_per_sqrt_sec * std::sqrt(kStep));
      for (int i = 0; i < 450; ++i) {
        if (walk_m_per_sqrt_sec > 0.0)
          curve.shift += Eigen::Vector3d(step_m(curve.random), step_m(curve.random), 0);
        continuous.add(curve.step());
      }
      sum += continuous.driftMPerSqrtSec() / kCurves;
    }
    EXPECT_NEAR(sum, walk_m_per_sqrt_sec, 0.01 + 0.15 * walk_m_per_sqrt_sec);
  }
}

TEST(ContinuousOdometry, ASlideBesideAPositionThatWalksIsSeen) {
  double worst_m = 0.0;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    Curve curve;
    curve.random.seed(seed);
    ContinuousOdometry continuous;
    std::normal_distribution<double> step_m(0.0, 0.03 * std::sqrt(kStep));
    Eigen::Vector3d before_m = Eigen::Vector3d::Zero();
    for (int i = 0; i < 450 + 52; ++i) {
      const Eigen::Vector3d walk_m{step_m(curve.random), step_m(curve.random), 0.0};
      curve.shift += walk_m;
      if (i >= 450) curve.shift.y() += 0.42 * kStep;
      const Eigen::Vector3d astray_m =
          continuous.add(curve.step())->T_odom_base.translation() - curve.position;
      if (i < 450) before_m = astray_m;
      worst_m = std::max(worst_m, (astray_m - before_m).norm());
    }
  }
  EXPECT_LT(worst_m, 0.45);  // of the slide's 0.73 m
}

TEST(ContinuousOdometry, ASteadyBiasOfTheVelocityIsLearntAndASlideBesideItIsSeen) {
  Curve curve;
  curve.bias_base = {0.15, -0.2, 0.0};
  ContinuousOdometry continuous;
  for (int i = 0; i < 450; ++i) continuous.add(curve.step());
  EXPECT_NEAR(continuous.disagreementMps(), 0.25, 0.02);
  EXPECT_NEAR(continuous.unexplainedMps(), 0.0, 0.02);
  EXPECT_TRUE(continuous.isBiasKnown());
  const VehicleState biased = *continuous.add(curve.step());
  EXPECT_NEAR((biased.velocity_odom_mps - curve.velocity()).norm(), 0.25, 0.02);
  EXPECT_LT((continuous.unbiased(biased) - curve.velocity()).norm(), 0.03);
  const Eigen::Vector3d shift_m = continuous.T_smooth_odom(curve.time).translation();
  const VehicleState before = *continuous.add(curve.step());
  const Eigen::Vector3d from = curve.position;
  std::optional<VehicleState> smooth;
  for (int i = 0; i < 90; ++i) smooth = continuous.add(curve.step());
  EXPECT_TRUE(continuous.T_smooth_odom(curve.time).translation().isApprox(shift_m, 1e-9))
      << "a bias that is known moves no frame";
  for (int i = 0; i < 60; ++i) {
    curve.shift.y() += 0.5 * kStep;
    smooth = continuous.add(curve.step());
  }
  const Eigen::Vector3d moved = smooth->T_odom_base.translation() - before.T_odom_base.translation();
  EXPECT_LT((moved - (curve.position - from)).norm(), 0.12) << "of a slide of 1 m";
}

// Gyro drift tilts an estimator. After a turn of the vehicle the velocity error keeps its direction in the
// world for a while.
TEST(ContinuousOdometry, ABiasThatDoesNotTurnWithTheVehicleMovesNoFrame) {
  Curve curve;
  curve.bias_base = {0.13, 0.14, 0.0};
  curve.speed = curve.aside = curve.climb = 0.0;
  ContinuousOdometry continuous;
  for (int i = 0; i < 300; ++i) {
    curve.yaw -= 0.1 * kStep;
    continuous.add(curve.step());
  }
  const Eigen::Vector3d bias_mps = geometry::yawRotation(curve.yaw) * curve.bias_base;
  const Eigen::Vector3d shift_m = continuous.T_smooth_odom(curve.time).translation();
  curve.speed = 0.9;
  std::optional<VehicleState> smooth;
  for (int i = 0; i < 150; ++i) {
    if (i < 45) curve.yaw += 0.4 * kStep;
    curve.bias_base = geometry::yawRotation(-curve.yaw) * bias_mps;
    smooth = continuous.add(curve.step());
  }
  EXPECT_LT((continuous.T_smooth_odom(curve.time).translation() - shift_m).norm(),
            ContinuousOdometry::kUnexplainedM + 0.01);
  EXPECT_LT((continuous.unbiased(*smooth) - curve.velocity()).norm(), 0.03);
  EXPECT_LT((continuous.biasMps() - curve.bias_base).norm(), 0.03);
}

TEST(ContinuousOdometry, AWayFlownWhileItWasGoneIsNotKnown) {
  Curve curve;
  ContinuousOdometry continuous;
  for (int i = 0; i < 60; ++i) continuous.add(curve.step());
  curve.time += 1.0;
  curve.position.x() += 1.5;
  EXPECT_FALSE(continuous.add(curve.step()));
  EXPECT_TRUE(continuous.add(curve.step()));
  EXPECT_TRUE(continuous.T_smooth_odom(curve.time).matrix().isIdentity(0.0));
}

}  // namespace window_ingress::navigation::continuous_odometry_test
