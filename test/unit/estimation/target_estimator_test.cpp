#include "window_ingress/estimation/target_estimator.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::estimation::target_estimator_test {

const geometry::PinholeCamera kCamera = geometry::PinholeCamera::fromFieldOfView(640, 480, 1.2);
const Eigen::Isometry3d kMounting =
    geometry::makePose(geometry::R_optical_flu().transpose(), {0.1, 0.0, 0.02});
const Eigen::Isometry3d kWindow = geometry::makePose(geometry::yawRotation(0.3), {4.0, 0.5, 1.4});

Eigen::Isometry3d vehicleAt(double y_m) {
  return geometry::makePose(geometry::yawRotation(0.1), {0.0, y_m, 1.2});
}

/// The window, observed exactly by a vehicle at this place.
detection::WindowObservation sighting(const Eigen::Isometry3d& T_odom_base, double stamp_sec) {
  detection::WindowObservation window;
  const Eigen::Isometry3d T_camera_window = (T_odom_base * kMounting).inverse() * kWindow;
  window.corners = *geometry::projectOpening(kCamera, T_camera_window, {1.2, 1.0});
  for (auto& covariance : window.corner_covariance) covariance = 0.01 * Eigen::Matrix2d::Identity();
  for (auto& edge : window.edges) edge = {true, 0.1, 0.001};
  window.stamp_sec = stamp_sec;
  window.score = 1.0;
  window.target_id = 1;
  return window;
}

TargetEstimator defaultEstimator() {
  return TargetEstimator(estimation::PoseParams(), estimation::FilterParams(), TargetEstimatorParams());
}

TEST(TargetEstimator, FindsTheWindowInOdomAtTheTimeOfTheExposure) {
  auto estimator = defaultEstimator();
  for (int i = 0; i < 30; ++i) {
    const double now = i / 30.0, exposure = now - 0.05;
    estimator.addOdometry(now, vehicleAt(now));  // 1 m/s sideways
    estimator.addAttitude(now, Eigen::Quaterniond(geometry::yawRotation(0.1)));
    if (exposure >= 0.0) estimator.addDetection(sighting(vehicleAt(exposure), exposure), kCamera, kMounting);
  }
  const auto target = estimator.target(1.0);
  ASSERT_TRUE(target) << estimator.lastUpdate().why_not;
  EXPECT_EQ(estimator.lastUpdate().why_not, "");
  EXPECT_LT((target->T_odom_window.translation() - kWindow.translation()).norm(), 0.02);
  EXPECT_NEAR(geometry::yawOf(target->T_odom_window.linear()), 0.3, 0.02);
  EXPECT_NEAR(target->stamp_sec, 29 / 30.0 - 0.05, 1e-9);
  EXPECT_DOUBLE_EQ(target->opening.width_m, 1.2);
  EXPECT_GT(estimator.filtered(1.0)->updates, 10);
}

TEST(TargetEstimator, TheMountingIsUnverifiedUntilItWasWatchedOrIsSaidToBeSure) {
  EXPECT_NE(defaultEstimator().unverified(), "");
  FilterParams sure;
  sure.mounting_yaw_sigma_rad = 0.001;
  EXPECT_EQ(TargetEstimator(PoseParams(), sure, TargetEstimatorParams()).unverified(), "");
}

// Like the odometry of a rehearsal, which lags and is computed from the window: it says nothing about the
// window's size.
TEST(TargetEstimator, WhereTheMountingIsSaidToBeSureTheWayFlownDoesNotJudgeTheSizeEither) {
  FilterParams sure;
  sure.mounting_yaw_sigma_rad = 0.001;
  for (const bool is_sure : {false, true}) {
    TargetEstimator estimator(PoseParams(), is_sure ? sure : FilterParams(), TargetEstimatorParams());
    for (int i = 0; i <= 90; ++i) {
      const double now = i / 30.0, y = 0.6 * now;
      estimator.addOdometry(now, vehicleAt(1.5 * y));
      estimator.addDetection(sighting(vehicleAt(y), now), kCamera, kMounting);
    }
    EXPECT_EQ(estimator.frames().what.find("opening looks like") == std::string::npos, is_sure)
        << estimator.frames().what;
  }
}

TEST(TargetEstimator, AnImageWaitsForItsOdometry) {
  auto estimator = defaultEstimator();
  estimator.addOdometry(0.0, vehicleAt(0.0));
  estimator.addDetection(sighting(vehicleAt(0.03), 0.03), kCamera, kMounting);
  EXPECT_FALSE(estimator.target(0.03));
  estimator.addOdometry(0.06, vehicleAt(0.06));
  EXPECT_TRUE(estimator.target(0.06));
}

TEST(TargetEstimator, WithoutOdometryNearTheExposureThereIsNoTarget) {
  auto estimator = defaultEstimator();
  estimator.addDetection(sighting(vehicleAt(0.0), 1.0), kCamera, kMounting);
  estimator.addOdometry(0.0, vehicleAt(0.0));
  estimator.addDetection(sighting(vehicleAt(0.0), 1.03), kCamera, kMounting);
  EXPECT_FALSE(estimator.target(1.03));
  EXPECT_EQ(estimator.lastUpdate().why_not, "no odometry near the exposure");
}

TEST(TargetEstimator, AJumpOfTheOdometryStartsAnew) {
  auto estimator = defaultEstimator();
  for (int i = 0; i < 10; ++i) {
    estimator.addOdometry(0.03 * i, vehicleAt(0.0));
    estimator.addDetection(sighting(vehicleAt(0.0), 0.03 * i), kCamera, kMounting);
  }
  ASSERT_TRUE(estimator.target(0.3));
  estimator.addOdometry(0.3, vehicleAt(5.0));
  EXPECT_FALSE(estimator.target(0.3));
}

/// Flies 2 m sideways past the window with exact images; the stated mounting may be wrong.
TargetEstimator flownSideways(const estimation::PoseParams& pose, const TargetEstimatorParams& params,
                              const Eigen::Isometry3d& mounting_told, double velocity_factor = 1.0) {
  TargetEstimator estimator(pose, estimation::FilterParams(), params);
  for (int i = 0; i <= 90; ++i) {
    const double now = i / 30.0, y = 0.7 * now;
    estimator.addOdometry(now, vehicleAt(y), Eigen::Vector3d(0.0, 0.7 * velocity_factor, 0.0));
    estimator.addDetection(sighting(vehicleAt(y), now), kCamera, mounting_told);
  }
  return estimator;
}

estimation::PoseParams unknownSize() {
  estimation::PoseParams params;
  params.opening_width_m = params.opening_height_m = 0.9;
  params.scale_sigma = 0.5;
  params.aspect_sigma = 0.3;
  return params;
}

TEST(TargetEstimator, FindsOutASizeThatIsNotKnown) {
  const auto estimator = flownSideways(unknownSize(), TargetEstimatorParams(), kMounting);
  const auto target = estimator.target(3.0);
  ASSERT_TRUE(target) << estimator.lastUpdate().why_not;
  EXPECT_NEAR(target->opening.width_m, 1.2, 0.06);
  EXPECT_NEAR(target->opening.height_m, 1.0, 0.05);
  EXPECT_LT((target->T_odom_window.translation() - kWindow.translation()).norm(), 0.25);
  EXPECT_EQ(target->fit, estimation::Fit::kGo);
  EXPECT_EQ(target->approach_forbidden, "");
}

TEST(TargetEstimator, SaysThatWidthAndHeightDoNotFit) {
  estimation::PoseParams swapped;
  swapped.opening_width_m = 1.0;
  swapped.opening_height_m = 1.2;
  const auto estimator = flownSideways(swapped, TargetEstimatorParams(), kMounting);
  EXPECT_NE(estimator.lastUpdate().why_not.find("an opening of 1.00 x 1.20 m"), std::string::npos)
      << estimator.lastUpdate().why_not;
}

TEST(TargetEstimator, TellsAnotherWindowByItsSizeAndForgetsItWithItsIdentity) {
  estimation::PoseParams twice;  // expects a window twice as large
  twice.opening_width_m = 2.4;
  twice.opening_height_m = 2.0;
  auto estimator = flownSideways(twice, TargetEstimatorParams(), kMounting);
  auto target = estimator.target(3.0);
  ASSERT_TRUE(target) << estimator.lastUpdate().why_not;
  ASSERT_TRUE(target->other_window);
  EXPECT_NEAR(*target->other_window, 0.5, 0.1);
  EXPECT_NE(target->approach_forbidden, "");

  auto next = sighting(vehicleAt(1.8), 3.03);
  next.target_id = 7;
  estimator.addOdometry(3.03, vehicleAt(1.8));
  estimator.addDetection(next, kCamera, kMounting);
  target = estimator.target(3.03);
  ASSERT_TRUE(target);
  EXPECT_FALSE(target->other_window);
  EXPECT_EQ(target->approach_forbidden, "");

  const auto right = flownSideways(estimation::PoseParams(), TargetEstimatorParams(), kMounting).target(3.0);
  ASSERT_TRUE(right);
  EXPECT_FALSE(right->other_window);
}

TEST(TargetEstimator, ForbidsTheApproachWhileTheSizeIsOpenOrTooSmall) {
  auto estimator = TargetEstimator(unknownSize(), estimation::FilterParams(), TargetEstimatorParams());
  for (int i = 0; i < 30; ++i) {
    estimator.addOdometry(i / 30.0, vehicleAt(0.0));
    estimator.addDetection(sighting(vehicleAt(0.0), i / 30.0), kCamera, kMounting);
  }
  ASSERT_TRUE(estimator.target(1.0));
  EXPECT_EQ(estimator.target(1.0)->fit, estimation::Fit::kUnknown);
  EXPECT_NE(estimator.target(1.0)->approach_forbidden.find("UNKNOWN"), std::string::npos);
  TargetEstimatorParams broad;
  broad.needed.width_m = 1.25;
  const auto narrow = flownSideways(estimation::PoseParams(), broad, kMounting);
  EXPECT_EQ(narrow.target(3.0)->fit, estimation::Fit::kNoGo);
  EXPECT_NE(narrow.target(3.0)->approach_forbidden.find("NO_GO"), std::string::npos);
}

TEST(TargetEstimator, ForbidsTheApproachWhileManyImagesContradictTheWindow) {
  for (const double aside_m : {0.0, 0.5}) {  // every second image shows another place
    auto estimator = defaultEstimator();
    for (int i = 0; i <= 60; ++i) {
      const double now = i / 30.0;
      estimator.addOdometry(now, vehicleAt(0.0), Eigen::Vector3d(0, 0, 0));
      estimator.addDetection(sighting(vehicleAt(i % 2 == 0 ? 0.0 : aside_m), now), kCamera, kMounting);
    }
    const auto target = estimator.target(2.0);
    ASSERT_TRUE(target) << estimator.lastUpdate().why_not;
    EXPECT_EQ(target->approach_forbidden.find("images contradict") != std::string::npos, aside_m > 0.0)
        << target->approach_forbidden;
  }
}

TEST(TargetEstimator, ForbidsTheApproachWithFramesThatAreNotAsTold) {
  Eigen::Isometry3d turned = kMounting;
  turned.linear() = geometry::yawRotation(0.3) * turned.linear();
  const auto mounting = flownSideways(estimation::PoseParams(), TargetEstimatorParams(), turned);
  EXPECT_EQ(mounting.frames().state, estimation::FramesVerdict::kWrong);
  EXPECT_NE(mounting.frames().what.find("in yaw"), std::string::npos) << mounting.frames().what;
  const auto twist = flownSideways(estimation::PoseParams(), TargetEstimatorParams(), kMounting, -1.0);
  ASSERT_TRUE(twist.target(3.0));
  EXPECT_NE(twist.target(3.0)->approach_forbidden.find("twist"), std::string::npos);
  const auto good = flownSideways(estimation::PoseParams(), TargetEstimatorParams(), kMounting);
  EXPECT_EQ(good.frames().state, estimation::FramesVerdict::kGood) << good.frames().what;
  EXPECT_EQ(good.target(3.0)->approach_forbidden, "");
}

TEST(TargetEstimator, ForbidsTheApproachWithAHeadingFurtherOffThanAnyCompass) {
  const auto estimator = flownSideways(estimation::PoseParams(), TargetEstimatorParams(), kMounting);
  auto window = *estimator.filtered(3.0);
  window.camera_turn.covariance = 0.0001 * Eigen::Matrix3d::Identity();
  for (const double turn_rad : {-0.15, -0.08, 0.08, 0.15}) {
    window.camera_turn.turn_rad.y() = turn_rad;
    EXPECT_EQ(estimator.approachForbidden(window),
              std::abs(turn_rad) > 0.1 ? "camera's yaw or odometry's heading off by about 9 deg" : "");
  }
  window.camera_turn.covariance *= 25.0;
  EXPECT_EQ(estimator.approachForbidden(window), "") << "0.05 rad of spread: nothing is certain";
}

TEST(TargetEstimator, AJumpOfTheOdometryKeepsTheSizeAndWhatWasFoundOfTheFrames) {
  auto estimator = flownSideways(unknownSize(), TargetEstimatorParams(), kMounting);
  const auto frames = estimator.frames();
  estimator.addOdometry(3.03, vehicleAt(7.0));
  EXPECT_FALSE(estimator.target(3.03));
  EXPECT_EQ(estimator.frames(), frames);
  for (int i = 0; i < 3; ++i) {
    estimator.addOdometry(3.1 + i / 30.0, vehicleAt(1.8));
    if (i > 0) estimator.addDetection(sighting(vehicleAt(1.8), 3.1 + i / 30.0), kCamera, kMounting);
  }
  ASSERT_TRUE(estimator.target(3.2)) << estimator.lastUpdate().why_not;
  EXPECT_NEAR(estimator.target(3.2)->opening.width_m, 1.2, 0.1);
}

TargetEstimator hovering(double until_sec) {
  auto estimator = defaultEstimator();
  for (int i = 0; i <= 30.0 * until_sec; ++i) {
    estimator.addOdometry(i / 30.0, vehicleAt(0.0));
    estimator.addDetection(sighting(vehicleAt(0.0), i / 30.0), kCamera, kMounting);
  }
  return estimator;
}

TEST(TargetEstimator, AnOdometrySampleThatComesLateChangesNothing) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double stamp : {0.98, 0.6, -infinity}) {
    auto estimator = hovering(1.0);
    const int updates = estimator.filtered(1.0)->updates;
    estimator.addOdometry(stamp, vehicleAt(0.0));
    estimator.addOdometry(1.03, vehicleAt(0.0));
    estimator.addDetection(sighting(vehicleAt(0.0), 1.03), kCamera, kMounting);
    ASSERT_TRUE(estimator.target(1.03)) << stamp;
    EXPECT_EQ(estimator.filtered(1.03)->updates, updates + 1) << stamp;
  }
  auto estimator = hovering(3.0);
  estimator.addOdometry(1.0, vehicleAt(0.0));
  EXPECT_FALSE(estimator.target(3.0)) << "two seconds back are another time";
}

TEST(TargetEstimator, AHeadingThatJumpsStartsAnew) {
  auto estimator = hovering(1.0);
  Eigen::Isometry3d turned = vehicleAt(0.0);
  turned.linear() = geometry::yawRotation(0.15) * turned.linear();
  estimator.addOdometry(1.03, turned);
  EXPECT_TRUE(estimator.target(1.03)) << "a vehicle can turn as fast";
  turned.linear() = geometry::yawRotation(0.9) * turned.linear();
  estimator.addOdometry(1.06, turned);
  EXPECT_FALSE(estimator.target(1.06));
}

/// Pitch down by this angle.
Eigen::Isometry3d pitched(double rad) {
  Eigen::Isometry3d T = vehicleAt(0.0);
  T.rotate(Eigen::AngleAxisd(rad, Eigen::Vector3d::UnitY()));
  return T;
}

TEST(TargetEstimator, WithoutRecentAttitudeThatOfTheOdometryCounts) {
  auto with_imu = defaultEstimator(), without = defaultEstimator();
  with_imu.addAttitude(0.0, Eigen::Quaterniond(pitched(0.0).linear()));
  for (auto* estimator : {&with_imu, &without}) {
    estimator->addOdometry(1.0, pitched(0.25));
    estimator->addDetection(sighting(pitched(0.25), 1.0), kCamera, kMounting);
    ASSERT_TRUE(estimator->lastUpdate().pose.estimate) << estimator->lastUpdate().pose.detail;
  }
  EXPECT_NEAR(without.lastUpdate().pose.estimate->yaw_rad, 0.2, 0.002);
  EXPECT_EQ(with_imu.lastUpdate().pose.estimate->yaw_rad, without.lastUpdate().pose.estimate->yaw_rad);
}

TEST(TargetEstimator, AnAttitudeInOtherAxesThanTheOdometryIsNamedAndNotUsed) {
  const Eigen::Quaterniond down(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()));  // north-east-down
  auto estimator = defaultEstimator();
  for (int i = 0; i < 60; ++i) {
    estimator.addOdometry(i / 30.0, vehicleAt(0.0));
    estimator.addAttitude(i / 30.0, down);
    estimator.addDetection(sighting(vehicleAt(0.0), i / 30.0), kCamera, kMounting);
  }
  ASSERT_TRUE(estimator.target(2.0)) << estimator.lastUpdate().why_not;
  ASSERT_TRUE(estimator.lastUpdate().pose.estimate);
  EXPECT_NEAR(estimator.lastUpdate().pose.estimate->yaw_rad, 0.2, 0.01);
  EXPECT_EQ(estimator.frames().state, estimation::FramesVerdict::kWrong);
  EXPECT_NE(estimator.target(2.0)->approach_forbidden.find("attitude"), std::string::npos);
  for (int i = 60; i < 120; ++i) {
    estimator.addOdometry(i / 30.0, vehicleAt(0.0));
    estimator.addAttitude(i / 30.0, Eigen::Quaterniond(vehicleAt(0.0).linear()));
    estimator.addDetection(sighting(vehicleAt(0.0), i / 30.0), kCamera, kMounting);
  }
  EXPECT_NE(estimator.frames().state, estimation::FramesVerdict::kWrong) << estimator.frames().what;
}

TEST(TargetEstimator, AnObservationWithoutBordersThatGivesNoPoseIsNotUsed) {
  auto estimator = hovering(1.0);
  auto skewed = sighting(vehicleAt(0.0), 1.03);
  estimator.addOdometry(1.03, vehicleAt(0.0));
  for (int i = 0; i < 4; ++i) {
    skewed.edges[i] = detection::Edge();
    skewed.corner_covariance[i] = 50.0 * Eigen::Matrix2d::Identity();
    skewed.corners[i].x() += i < 2 ? 6.0 : -6.0;
  }
  estimator.addDetection(skewed, kCamera, kMounting);
  EXPECT_FALSE(estimator.lastUpdate().pose.estimate);
  EXPECT_FALSE(estimator.lastUpdate().why_not.empty());
  EXPECT_EQ(estimator.lastUpdate().why_not, estimator.lastUpdate().pose.detail);
}

TEST(TargetEstimator, AnotherTargetHasNoMeasuredSizeYet) {
  auto estimator = flownSideways(estimation::PoseParams(), TargetEstimatorParams(), kMounting);
  ASSERT_TRUE(estimator.measuredSize());
  estimator.addOdometry(3.2, vehicleAt(1.8));
  auto other = sighting(vehicleAt(1.8), 3.2);
  other.target_id = 7;
  estimator.addDetection(other, kCamera, kMounting);
  estimator.addOdometry(3.4, vehicleAt(2.0));
  other = sighting(vehicleAt(2.0), 3.4);
  other.target_id = 8;
  estimator.addDetection(other, kCamera, kMounting);
  EXPECT_FALSE(estimator.measuredSize());
}

TEST(TargetEstimator, BadInputIsRefusedWithAReason) {
  auto estimator = defaultEstimator();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  estimator.addOdometry(0.0, vehicleAt(nan));
  estimator.addOdometry(nan, vehicleAt(0.0));
  estimator.addOdometry(0.0, vehicleAt(0.0));
  estimator.addAttitude(0.0, Eigen::Quaterniond(nan, 0, 0, 1));
  auto window = sighting(vehicleAt(0.0), 0.0);
  window.corners[2].x() = nan;
  estimator.addDetection(window, kCamera, kMounting);
  EXPECT_FALSE(estimator.lastUpdate().why_not.empty());
  EXPECT_FALSE(estimator.target(0.0));
  TargetEstimatorParams params;
  params.openness.sure_log_odds = -1.0;
  EXPECT_THROW(TargetEstimator(estimation::PoseParams(), estimation::FilterParams(), params),
               std::invalid_argument);
}

}  // namespace window_ingress::estimation::target_estimator_test
