#include "window_ingress/estimation/window_pose_estimator.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "pose_fixtures.hpp"

namespace window_ingress::estimation::window_pose_estimator_test {

using namespace fixtures;

const double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(WindowPoseEstimator, IsExactWithoutNoiseForPureYaw) {
  const WindowPoseEstimator estimator{PoseParams{}};
  for (int degrees = -60; degrees <= 60; ++degrees)
    for (const double distance : {1.5, 4.0, 8.0}) {
      const auto T = view(distance, degrees * kDegree);
      const auto result = estimator.estimate(cornersSeen(camera(), T, 0.3), camera());
      ASSERT_TRUE(result.estimate) << degrees << " deg at " << distance << " m: " << result.detail;
      const auto& best = result.estimate->best;
      EXPECT_LT(angleBetween(best.T_camera_window.linear(), T.linear()), 0.01 * kDegree) << degrees;
      EXPECT_LT((best.T_camera_window.translation() - T.translation()).norm(), 1e-5);
      EXPECT_NEAR(result.estimate->yaw_rad, degrees * kDegree, 1e-5);
      EXPECT_LT(best.reprojection_rms_px, 1e-5);
    }
}

TEST(WindowPoseEstimator, IsExactWithoutNoiseForRandomPosesThroughALens) {
  const WindowPoseEstimator estimator{PoseParams{}};
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1, 1), distance(1.5, 8.0);
  int seen = 0;
  for (int i = 0; i < 2000; ++i) {
    const double d = distance(random);
    auto T = view(d, unit(random), 0.4 * d * unit(random), 0.3 * d * unit(random));
    T.linear() = T.linear() * geometry::rotationFromEuler({0.2 * unit(random), 0.2 * unit(random), 0.0});
    const auto image = geometry::projectOpening(distortedCamera(), T, kOpening);
    if (!image || T.linear().col(0).dot(T.translation().normalized()) < 0.3) continue;
    ++seen;
    const auto result = estimator.estimate(cornersSeen(distortedCamera(), T, 0.3), distortedCamera());
    ASSERT_TRUE(result.estimate) << i << ": " << result.detail;
    EXPECT_LT(angleBetween(result.estimate->best.T_camera_window.linear(), T.linear()), 0.01 * kDegree) << i;
    EXPECT_LT((result.estimate->best.T_camera_window.translation() - T.translation()).norm(), 1e-4) << i;
  }
  EXPECT_GT(seen, 1000);
}

TEST(WindowPoseEstimator, EveryStartCornerAndWindingGivesTheSamePose) {
  const WindowPoseEstimator estimator{PoseParams{}};
  const auto T = view(3.0, 0.5, 0.3, -0.2);
  std::mt19937 random(3);
  const auto window = bordersSeen(camera(), T, 0.5, random);
  const auto expected = estimator.estimate(window, camera()).estimate.value();
  for (int first = 0; first < 4; ++first)
    for (const int step : {1, 3}) {
      auto turned = window;
      for (int i = 0; i < 4; ++i) {
        turned.corners[i] = window.corners[(first + step * i) % 4];
        turned.corner_covariance[i] = window.corner_covariance[(first + step * i) % 4];
        turned.edges[i] = window.edges[(first + step * i + (step == 3 ? 3 : 0)) % 4];
      }
      const auto result = estimator.estimate(turned, camera());
      ASSERT_TRUE(result.estimate) << result.detail;
      EXPECT_TRUE(result.estimate->best.T_camera_window.isApprox(expected.best.T_camera_window, 1e-9));
      EXPECT_NEAR(result.estimate->yaw_sigma_rad, expected.yaw_sigma_rad, 1e-9);
    }
}

TEST(WindowPoseEstimator, DescribesTheViewAsThePaperDoes) {
  const WindowPoseEstimator estimator{PoseParams{}};
  const auto turned_left =
      estimator.estimate(cornersSeen(camera(), view(3.0, 0.5), 0.1), camera()).estimate.value();
  EXPECT_NEAR(turned_left.yaw_rad, 0.5, 1e-6);
  EXPECT_NEAR(turned_left.euler.yaw_rad, 0.5, 1e-6);
  EXPECT_NEAR(turned_left.euler.roll_rad, 0.0, 1e-6);
  EXPECT_NEAR(turned_left.euler.pitch_rad, 0.0, 1e-6);
  EXPECT_GT(turned_left.left_side_px, turned_left.right_side_px);
  EXPECT_TRUE(turned_left.sign_trusted);
  const auto square =
      estimator.estimate(cornersSeen(camera(), view(3.0, 0.0), 0.1), camera()).estimate.value();
  EXPECT_NEAR(square.opening_width_m, 1.2, 1e-6);
  EXPECT_LT(turned_left.opening_width_m, 1.15);
  EXPECT_FALSE(square.sign_trusted);
  EXPECT_DOUBLE_EQ(square.opening.width_m, 1.2);
}

TEST(WindowPoseEstimator, GravityTurnsYawIntoAHeadingOnATiltedCamera) {
  const WindowPoseEstimator estimator{PoseParams{}};
  // The camera is rolled, pitched and panned; the window stays upright.
  using Eigen::AngleAxisd;
  const Eigen::Matrix3d tilt =
      (AngleAxisd(10 * kDegree, Eigen::Vector3d::UnitZ()) *
       AngleAxisd(8 * kDegree, Eigen::Vector3d::UnitX()) * AngleAxisd(5 * kDegree, Eigen::Vector3d::UnitY()))
          .toRotationMatrix();
  const auto T = geometry::makePose(tilt, Eigen::Vector3d::Zero()) * view(3.0, 30 * kDegree);
  const GravityPrior gravity{tilt * Eigen::Vector3d(0, -1, 0), 0.01};
  const auto result = estimator.estimate(cornersSeen(camera(), T, 0.1), camera(), {gravity});
  ASSERT_TRUE(result.estimate) << result.detail;
  EXPECT_NEAR(result.estimate->yaw_rad, 30 * kDegree + std::atan2(tilt(2, 0), tilt(2, 2)), 1e-3);
  const auto plain = estimator.estimate(cornersSeen(camera(), T, 0.1), camera()).estimate.value();
  EXPECT_GT(std::abs(plain.yaw_rad - result.estimate->yaw_rad), 0.01);
}

TEST(WindowPoseEstimator, UnusableGravityIsNoGravity) {
  const WindowPoseEstimator estimator{PoseParams{}};
  const auto window = cornersSeen(camera(), view(3.0, 0.4), 0.1);
  const auto expected = estimator.estimate(window, camera()).estimate.value();
  for (const GravityPrior& gravity : {GravityPrior{{kNaN, 0, 0}, 0.02}, GravityPrior{{0, 0, 0}, 0.02},
                                      GravityPrior{{0, -1, 0}, 0.0}, GravityPrior{{0, -1, 0}, kNaN}}) {
    const auto result = estimator.estimate(window, camera(), {gravity});
    ASSERT_TRUE(result.estimate);
    EXPECT_EQ(result.estimate->yaw_rad, expected.yaw_rad);
  }
}

TEST(WindowPoseEstimator, UnusableCovariancesAreUnknown) {
  const WindowPoseEstimator estimator{PoseParams{}};
  const auto good = cornersSeen(camera(), view(3.0, 0.4), 1.0);
  const auto expected = estimator.estimate(good, camera()).estimate.value();
  for (const double value : {0.0, -1.0, kNaN}) {
    auto window = good;
    window.corner_covariance.fill(Eigen::Matrix2d::Constant(value));
    for (auto& edge : window.edges) edge = {true, value, value};
    const auto result = estimator.estimate(window, camera());
    ASSERT_TRUE(result.estimate) << result.detail;
    EXPECT_NEAR(result.estimate->yaw_sigma_rad, expected.yaw_sigma_rad, 1e-9) << value;
  }
}

struct BadCorners {
  const char* what;
  geometry::Quadrilateral corners;
};

TEST(WindowPoseEstimator, BadCornersAreRejectedWithAReason) {
  const double inf = std::numeric_limits<double>::infinity();
  const Eigen::Vector2d a(200, 150), b(400, 150), c(400, 330), d(200, 330);
  const std::vector<BadCorners> cases{
      {"NaN", {Eigen::Vector2d(kNaN, 1), b, c, d}},
      {"infinite", {Eigen::Vector2d(inf, 1), b, c, d}},
      {"huge", {Eigen::Vector2d(1e30, 1), b, c, d}},
      {"far outside", {a, Eigen::Vector2d(2000, 150), c, d}},
      {"crossed", {a, c, b, d}},
      {"duplicate", {a, a, c, d}},
      {"all the same", {a, a, a, a}},
      {"tiny",
       {a, a + Eigen::Vector2d(1e-6, 0), a + Eigen::Vector2d(1e-6, 1e-6), a + Eigen::Vector2d(0, 1e-6)}},
      {"collinear", {a, Eigen::Vector2d(250, 150), Eigen::Vector2d(300, 150), b}},
      {"almost collinear", {a, Eigen::Vector2d(300, 149.9), b, Eigen::Vector2d(300, 150.1)}},
      {"three on a line", {a, Eigen::Vector2d(300, 150), b, Eigen::Vector2d(300, 300)}},
      {"concave", {a, b, Eigen::Vector2d(250, 200), d}}};
  const WindowPoseEstimator estimator{PoseParams{}};
  for (const auto& bad : cases) {
    auto window = cornersSeen(camera(), view(3.0, 0.0), 0.5);
    window.corners = bad.corners;
    const auto result = estimator.estimate(window, camera());
    EXPECT_FALSE(result.estimate) << bad.what;
    EXPECT_EQ(result.reject, PoseReject::kBadCorners) << bad.what << ": " << toString(result.reject);
    EXPECT_FALSE(result.detail.empty()) << bad.what;
  }
}

TEST(WindowPoseEstimator, PartlySeenWindowsHaveNoPoseOfTheirOwn) {
  std::mt19937 random(1);
  auto window = bordersSeen(camera(), view(3.0, 0.2), 0.3, random);
  window.edges[geometry::kBottom].visible = false;
  const auto result = WindowPoseEstimator{PoseParams{}}.estimate(window, camera());
  EXPECT_EQ(result.reject, PoseReject::kBadCorners);
  EXPECT_EQ(result.detail, "only 3 of 4 borders are seen");
}

TEST(WindowPoseEstimator, BadCamerasAreRefused) {
  const auto window = cornersSeen(camera(), view(3.0, 0.2), 0.5);
  const WindowPoseEstimator estimator{PoseParams{}};
  std::vector<geometry::PinholeCamera> bad(5, camera());
  bad[0] = {};
  bad[1].fx = kNaN;
  bad[2].fx = -381;
  bad[3].distortion[0] = std::numeric_limits<double>::infinity();
  bad[4].width = 0;
  for (const auto& camera : bad) {
    const auto result = estimator.estimate(window, camera);
    EXPECT_EQ(result.reject, PoseReject::kBadCamera);
    EXPECT_FALSE(result.detail.empty());
  }
}

TEST(WindowPoseEstimator, LimitsRejectWithNumbers) {
  PoseParams params;
  params.max_range_m = 5.0;
  params.min_range_m = 1.0;
  params.max_reprojection_rms_px = 0.5;
  const WindowPoseEstimator estimator{params};
  const auto rejectOf = [&](const Eigen::Isometry3d& T) {
    return estimator.estimate(cornersSeen(camera(), T, 0.1), camera());
  };
  EXPECT_EQ(rejectOf(view(6.0, 0)).reject, PoseReject::kRange);
  EXPECT_EQ(rejectOf(view(6.0, 0)).detail, "range 6 m > 5 m");
  EXPECT_EQ(rejectOf(view(0.9, 0)).reject, PoseReject::kRange);
  auto rolled = view(3.0, 0);
  rolled.linear() = rolled.linear() * geometry::rotationFromEuler({0, 0.75, 0});
  EXPECT_EQ(rejectOf(rolled).reject, PoseReject::kTilt);
  auto square = cornersSeen(camera(), view(3.0, 0), 0.1);
  square.corners[0].x() -= 15;
  EXPECT_EQ(estimator.estimate(square, camera()).reject, PoseReject::kReprojection);
  square.stamp_sec = kNaN;
  EXPECT_EQ(estimator.estimate(square, camera()).reject, PoseReject::kNotFinite);
}

TEST(WindowPoseEstimator, AnyQuadrilateralGivesAPoseOrAReason) {
  const WindowPoseEstimator estimator{PoseParams{}};
  std::mt19937 random(11);
  std::uniform_real_distribution<double> x(-200, 840), y(-200, 680);
  int posed = 0;
  for (int i = 0; i < 20000; ++i) {
    auto window = cornersSeen(camera(), view(3.0, 0), 0.5);
    for (auto& corner : window.corners) corner = {x(random), y(random)};
    const auto result = estimator.estimate(window, camera());
    ASSERT_NE(result.estimate.has_value(), result.reject != PoseReject::kNone);
    if (!result.estimate) {
      ASSERT_FALSE(result.detail.empty());
      continue;
    }
    ++posed;
    ASSERT_TRUE(geometry::isValidPose(result.estimate->best.T_camera_window));
    ASSERT_TRUE(result.estimate->best.covariance.allFinite());
    ASSERT_TRUE(std::isfinite(result.estimate->yaw_sigma_rad + result.estimate->sigma_u_rad +
                              result.estimate->log_likelihood_ratio + result.estimate->opening_width_m));
  }
  RecordProperty("posed", posed);
}

TEST(WindowPoseEstimator, ParametersOutOfRangeAreAllNamed) {
  PoseParams params;
  params.opening_width_m = -1;
  params.max_range_m = kNaN;
  try {
    WindowPoseEstimator estimator{params};
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("opening_width_m"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("max_range_m"), std::string::npos);
  }
}

TEST(WindowPoseEstimator, APartialViewGivesNoPoseAndSaysWhichSidesAreMissing) {
  const WindowPoseEstimator estimator{PoseParams{}};
  auto window = cornersSeen(camera(), view(3.0, 0.2), 0.1);
  for (auto& edge : window.edges) edge.visible = true;
  window.edges[geometry::kRight].visible = false;
  window.corner_visible = {true, false, false, true};
  window.corners[1] = window.corners[2] = Eigen::Vector2d::Zero();
  const auto result = estimator.estimate(window, camera());
  EXPECT_FALSE(result.estimate);
  EXPECT_EQ(result.reject, PoseReject::kBadCorners);
  EXPECT_NE(result.detail.find("3 of 4 sides in view: right not seen"), std::string::npos) << result.detail;
}

}  // namespace window_ingress::estimation::window_pose_estimator_test
