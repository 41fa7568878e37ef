/// M47 to M53: invalid corners, and poses that must be rejected.
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "adapters/conversions/msg_conversion.hpp"
#include "adapters/images/reference_source.hpp"
#include "window_ingress/estimation/window_pose_estimator.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::estimation::corner_faults_test {

using Eigen::Vector2d;
using geometry::Quadrilateral;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kDegree = M_PI / 180.0;
const geometry::OpeningSize kOpening{1.2, 1.0};
const geometry::PinholeCamera kCamera = geometry::PinholeCamera::fromFieldOfView(640, 480, 1.4);
const WindowPoseEstimator kEstimator{PoseParams()};

Eigen::Isometry3d view(double distance_m, double yaw_rad) {
  return geometry::makePose(geometry::R_optical_flu() * geometry::yawRotation(yaw_rad),
                            {0.0, 0.0, distance_m});
}

detection::WindowObservation seen(const Quadrilateral& corners, double sigma_px = 0.3) {
  detection::WindowObservation window;
  window.stamp_sec = 1.0;
  window.corners = corners;
  window.corner_covariance.fill(sigma_px * sigma_px * Eigen::Matrix2d::Identity());
  return window;
}

detection::WindowObservation seen(const Eigen::Isometry3d& T, double sigma_px = 0.3) {
  return seen(*geometry::projectOpening(kCamera, T, kOpening), sigma_px);
}

// Converted by the message, as it arrives on the topic.
PoseResult throughTheMessage(const detection::WindowObservation& window) {
  auto message = adapters::toMsg(window);
  message.header.stamp = ros::Time(window.stamp_sec);
  const auto back = adapters::fromMsg(message);
  return back ? kEstimator.estimate(*back.value, kCamera)
              : PoseResult{std::nullopt, PoseReject::kBadCorners, back.reason};
}

struct BadCorners {
  const char* what;
  Quadrilateral corners;
};

void expectDropped(const std::vector<BadCorners>& all) {
  std::string detail;
  for (const BadCorners& bad : all) {
    const PoseResult result = throughTheMessage(seen(bad.corners));
    EXPECT_FALSE(result.estimate) << bad.what;
    EXPECT_EQ(result.reject, PoseReject::kBadCorners) << bad.what << ": " << toString(result.reject);
    EXPECT_NE(result.detail, "") << bad.what;
    detail = result.detail;
  }
  testing::Test::RecordProperty("seen", std::to_string(all.size()) + " dropped, e.g.: " + detail);
}

const Vector2d a(200, 150), b(400, 150), c(400, 330), d(200, 330);

TEST(Fault, M47_TooFewOrTooManyCorners) {
  for (int visible = 0; visible < 4; ++visible) {  // 0 to 3 of the four corners visible, no borders
    auto window = seen({a, b, c, d});
    for (int i = visible; i < 4; ++i) window.corner_visible[i] = false;
    const PoseResult result = throughTheMessage(window);
    EXPECT_FALSE(result.estimate) << visible;
    EXPECT_NE(result.detail.find("0 of 4 sides in view"), std::string::npos) << result.detail;
  }
  const cv::Mat image(100, 100, CV_8UC3, cv::Scalar::all(90));
  for (const std::size_t numbers : {2u, 6u, 7u, 9u, 10u, 2000000u})
    EXPECT_THROW(adapters::makeReference(image, std::vector<double>(numbers, 1.0), {}), std::invalid_argument)
        << numbers;
  auto flooded = adapters::toMsg(seen({a, b, c, d}));
  flooded.header.stamp = ros::Time(1.0);
  window_ingress::InteriorPoints& interior = flooded.interior;
  interior.id.resize(1000000);
  for (auto* list : {&interior.key_x, &interior.key_y, &interior.x, &interior.y}) list->resize(1000000);
  const std::clock_t begin = std::clock();
  const auto refused = adapters::fromMsg(flooded);
  EXPECT_LT(std::clock() - begin, CLOCKS_PER_SEC / 20);
  EXPECT_FALSE(refused.value);
  RecordProperty("seen", "0 to 3 corners, lists of 1 to 10^6: dropped; " + refused.reason);
}

TEST(Fault, M48_CornersOutOfThisWorld) {
  std::vector<BadCorners> all;
  for (int i = 0; i < 4; ++i)
    for (int axis = 0; axis < 2; ++axis)
      for (const double bad : {kNan, kInf, -kInf, 1e30, -1e30, 1e308, 5000.0, -3000.0}) {
        all.push_back({"out of this world", {a, b, c, d}});
        all.back().corners[i](axis) = bad;
      }
  expectDropped(all);
}

TEST(Fault, M49_CornersThatSpanNothing) {
  const Vector2d x(1, 0), y(0, 1);
  std::vector<BadCorners> all{
      {"all the same", {a, a, a, a}},
      {"1e-6 px", {a, a + 1e-6 * x, a + 1e-6 * (x + y), a + 1e-6 * y}},
      {"collinear", {a, a + 50 * x, a + 100 * x, b}},
      {"collinear, aslant", {a, a + 50 * (x + y), a + 100 * (x + y), a + 150 * (x + y)}},
      {"collinear but for 0.1 px", {a, a + 100 * x - 0.1 * y, b, a + 100 * x + 0.1 * y}},
      {"three on a line", {a, a + 100 * x, b, c}},
      {"three on a line but for 0.1 px", {a, a + 100 * x - 0.1 * y, b, c}}};
  for (int i = 0; i < 4; ++i) {
    all.push_back({"a duplicate", {a, b, c, d}});
    all.back().corners[(i + 1) % 4] = all.back().corners[i];
  }
  expectDropped(all);
}

TEST(Fault, M50_OrderOfTheCorners) {
  const Eigen::Isometry3d T = view(3.0, 0.35);
  const Quadrilateral right = *geometry::projectOpening(kCamera, T, kOpening);
  double worst = 0.0;
  for (const bool reversed : {false, true})
    for (int start = 0; start < 4; ++start) {
      Quadrilateral corners;
      for (int i = 0; i < 4; ++i) corners[i] = right[(start + (reversed ? 4 - i : i)) % 4];
      const PoseResult result = throughTheMessage(seen(corners));
      ASSERT_TRUE(result.estimate) << result.detail;
      worst = std::max(worst,
                       (result.estimate->best.T_camera_window.matrix() - T.matrix()).cwiseAbs().maxCoeff());
    }
  EXPECT_LT(worst, 1e-6);
  expectDropped({{"crossed", {a, c, b, d}},
                 {"crossed the other way", {a, b, d, c}},
                 {"concave", {a, b, Vector2d(250, 200), d}}});
  RecordProperty("seen", "4 start corners, both windings: one pose; crossed and concave dropped");
}

TEST(Fault, M51_SquareAndLevel) {
  double worst_rad = 0.0, worst_m = 0.0;
  for (int degrees = -60; degrees <= 60; ++degrees)
    for (const double distance_m : {1.0, 2.0, 3.0, 5.0}) {
      const Eigen::Isometry3d T = view(distance_m, degrees * kDegree);
      const PoseResult result = throughTheMessage(seen(T, 0.1));
      ASSERT_TRUE(result.estimate) << degrees << " deg, " << distance_m << " m: " << result.detail;
      const Eigen::Isometry3d& found = result.estimate->best.T_camera_window;
      worst_rad = std::max(
          worst_rad, Eigen::Quaterniond(found.linear()).angularDistance(Eigen::Quaterniond(T.linear())));
      worst_m = std::max(worst_m, (found.translation() - T.translation()).norm());
    }
  EXPECT_LT(worst_rad, 0.01 * kDegree);
  EXPECT_LT(worst_m, 1e-4);
  char text[120];
  std::snprintf(text, sizeof text, "484 level views of -60 to 60 deg: worst %.1e deg, %.1e m",
                worst_rad / kDegree, worst_m);
  RecordProperty("seen", text);
}

TEST(Fault, M52_PosesBeyondTheLimits) {
  const PoseParams params;
  const auto rejectOf = [&](const detection::WindowObservation& window) { return throughTheMessage(window); };
  Eigen::Isometry3d tilted = view(3.0, 0.0);
  tilted.linear() = tilted.linear() * Eigen::AngleAxisd(params.max_tilt_rad + 0.05, Eigen::Vector3d::UnitX());
  auto skewed = seen(view(3.0, 0.0), 0.1);
  for (int i = 0; i < 4; i += 2) skewed.corners[i] += Vector2d(-40.0, 25.0);
  const std::vector<std::pair<PoseResult, PoseReject>> all{
      {rejectOf(seen(view(params.max_range_m + 0.5, 0.0))), PoseReject::kRange},
      {rejectOf(seen(tilted)), PoseReject::kTilt},
      {rejectOf(skewed), PoseReject::kReprojection}};
  std::string said;
  for (const auto& [result, reject] : all) {
    EXPECT_FALSE(result.estimate);
    EXPECT_EQ(result.reject, reject) << result.detail;
    EXPECT_NE(result.detail.find('>'), std::string::npos) << "with numbers: " << result.detail;
    said += (said.empty() ? "" : "; ") + result.detail;
  }
  // No observation, with any corners, gives a window behind the camera.
  std::mt19937 random(3);
  std::uniform_real_distribution<double> x(-300, 940), y(-300, 780);
  int posed = 0;
  for (int i = 0; i < 20000; ++i) {
    const PoseResult result =
        throughTheMessage(seen({Vector2d(x(random), y(random)), Vector2d(x(random), y(random)),
                                Vector2d(x(random), y(random)), Vector2d(x(random), y(random))}));
    if (!result.estimate) continue;
    ++posed;
    for (const Eigen::Vector3d& corner : geometry::openingCorners(kOpening))
      ASSERT_GT((result.estimate->best.T_camera_window * corner).z(), 0.0);
  }
  RecordProperty("seen",
                 said + "; 20000 random quadrilaterals: " + std::to_string(posed) + " poses, none behind");
}

TEST(Fault, M53_TwoPosesThatExplainTheSameImage) {
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, 0.7);
  int wrong_sign = 0, wrong_and_trusted = 0, alternatives = 0, trusted_near = 0;
  double sigma_rad = 0.0;
  const int images = 400;
  for (int i = 0; i < images; ++i) {
    const double yaw = (i % 2 ? 1 : -1) * 15.0 * kDegree;
    auto far = seen(view(8.0, yaw), 0.7), near = seen(view(1.5, 3.0 * yaw), 0.7);
    for (auto* window : {&far, &near})
      for (Vector2d& corner : window->corners) corner += Vector2d(noise(random), noise(random));
    const PoseResult ambiguous = throughTheMessage(far), clear = throughTheMessage(near);
    ASSERT_TRUE(ambiguous.estimate && clear.estimate) << ambiguous.detail << clear.detail;
    const bool wrong = ambiguous.estimate->yaw_rad * yaw < 0.0;
    wrong_sign += wrong;
    wrong_and_trusted += wrong && ambiguous.estimate->sign_trusted;
    alternatives += ambiguous.estimate->alternative.has_value();
    sigma_rad += ambiguous.estimate->sigma_u_rad / images;
    trusted_near += clear.estimate->sign_trusted && clear.estimate->yaw_rad * yaw > 0.0;
  }
  EXPECT_GT(wrong_sign, images / 20) << "otherwise this was no ambiguity";
  EXPECT_EQ(wrong_and_trusted, 0);
  EXPECT_GT(alternatives, images / 4) << "the other pose is told, too";
  EXPECT_GT(sigma_rad, 5.0 * kDegree) << "the spread says what is not known";
  EXPECT_GT(trusted_near, 9 * images / 10) << "near, the sign is known";
  RecordProperty("seen", std::to_string(wrong_sign) + " of 400 far views have the wrong sign, " +
                             std::to_string(wrong_and_trusted) + " of them trusted; spread " +
                             std::to_string(static_cast<int>(sigma_rad / kDegree)) + " deg");
}

}  // namespace window_ingress::estimation::corner_faults_test
