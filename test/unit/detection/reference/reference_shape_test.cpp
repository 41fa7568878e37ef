#include "detection/reference/reference_shape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "drawn_window.hpp"
#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/geometry/opening.hpp"

namespace window_ingress::detection::reference_shape_test {

using Covariances = std::array<Eigen::Matrix2d, 4>;
using geometry::Quadrilateral;

geometry::PinholeCamera camera() { return geometry::PinholeCamera::fromFieldOfView(640, 480, 1.2); }
const cv::Size kImage(640, 480);

Covariances spread(double sigma_px) {
  Covariances covariance;
  covariance.fill(sigma_px * sigma_px * Eigen::Matrix2d::Identity());
  return covariance;
}

/// A framed window of 1.2 m x 1.0 m unless given otherwise, seen from an arbitrary place.
struct View {
  double width_m = 1.2, height_m = 1.0, frame_m = 0.07;
  double distance_m = 4.0, yaw_rad = 0.0, pitch_rad = 0.0;
  double blur_px = 0.7;

  Quadrilateral seen(double grown_m) const {
    const Eigen::Matrix3d turn = geometry::yawRotation(yaw_rad) *
                                 Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()).toRotationMatrix();
    const Eigen::Isometry3d T_camera_window =
        geometry::makePose(geometry::R_optical_flu() * turn, {0.1, -0.1, distance_m});
    return *geometry::canonical(*geometry::projectOpening(
        camera(), T_camera_window, {width_m + 2.0 * grown_m, height_m + 2.0 * grown_m}));
  }
  Quadrilateral opening() const { return seen(0.0); }

  cv::Mat draw() const {
    cv::Mat image(480, 640, CV_8UC3, cv::Scalar(136, 152, 161));
    test::fillQuad(image, seen(frame_m), cv::Scalar(16, 78, 185));
    test::fillQuad(image, opening(), cv::Scalar(70, 72, 70));
    cv::GaussianBlur(image, image, cv::Size(), blur_px);
    test::addNoise(image, 2.0, 3);
    return image;
  }
};

View randomView(std::mt19937& random) {
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  View view;
  view.distance_m = uniform(2.0, 8.0), view.yaw_rad = uniform(-0.8, 0.8);
  view.pitch_rad = uniform(-0.2, 0.2), view.blur_px = uniform(0.5, 1.2);
  return view;
}

ReferenceShape learned() {
  View view;
  view.distance_m = 2.2;
  ReferenceShape shape;
  shape.learn(view.draw(), view.opening());
  return shape;
}

TEST(RectangleMisfit, IsChiOfTwoDegreesOfFreedomForTheRightAspect) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal(0.0, 0.4);
  const Covariances known = spread(std::sqrt(0.4 * 0.4 - 0.3 * 0.3));  // 0.3 px are added to this
  double squares = 0.0;
  const int trials = 200;
  for (int i = 0; i < trials; ++i) {
    Quadrilateral corners = randomView(random).opening();
    for (auto& corner : corners) corner += Eigen::Vector2d(normal(random), normal(random));
    const auto left = rectangleMisfit(corners, known, camera(), {1.2, 0.001});
    ASSERT_TRUE(left);
    EXPECT_LT(*left, 5.0);
    squares += *left * *left / trials;
  }
  EXPECT_NEAR(squares, 2.0, 0.5);
}

TEST(RectangleMisfit, AnotherAspectDoesNotFit) {
  std::mt19937 random(5);
  for (int i = 0; i < 100; ++i) {
    View view = randomView(random);
    view.distance_m = std::min(view.distance_m, 6.0);
    view.width_m = i % 2 ? 0.7 : 1.8;
    EXPECT_GT(*rectangleMisfit(view.opening(), spread(0.3), camera(), {1.2, 0.03}), 4.0) << i;
  }
}

TEST(RectangleMisfit, NothingFromWhatIsNoQuadrilateral) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const OpeningAspect aspect{1.0, 0.03};
  EXPECT_FALSE(rectangleMisfit(test::rectangle(nan, 0, 5, 5), spread(0.3), camera(), aspect));
  EXPECT_FALSE(rectangleMisfit(test::rectangle(7, 7, 7, 7), spread(0.3), camera(), aspect));
  EXPECT_FALSE(rectangleMisfit(View().opening(), spread(nan), camera(), aspect));
}

TEST(ReferenceShape, TheTargetIsOfItsShapeFromAnywhere) {
  ReferenceShape shape = learned();
  std::mt19937 random(6);
  for (int i = 0; i < 30; ++i) {
    const View view = randomView(random);
    const auto camera_used = camera();
    EXPECT_FALSE(shape.inAspect(view.opening(), spread(0.2), kImage, &camera_used)) << i;
    const auto off = shape.inFrame(view.draw(), view.opening(), &camera_used);
    EXPECT_FALSE(off) << i << ": " << (off ? off->value : 0.0);
  }
}

TEST(ReferenceShape, AWiderFrameAndAThinnerOneAreOthers) {
  ReferenceShape shape = learned();
  std::mt19937 random(7);
  const auto camera_used = camera();
  for (int i = 0; i < 20; ++i) {
    View view = randomView(random);
    view.distance_m = std::min(view.distance_m, 5.0);
    view.frame_m = i % 2 ? 0.1 : 0.045;
    EXPECT_TRUE(shape.inFrame(view.draw(), view.opening(), &camera_used)) << i;
  }
}

TEST(ReferenceShape, AFrameThatDoesNotShowIsNoOther) {
  ReferenceShape shape = learned();
  View view;
  EXPECT_FALSE(shape.inFrame(view.draw(), view.opening(), nullptr));
  view.frame_m = 0.0;
  EXPECT_FALSE(shape.inFrame(view.draw(), view.opening(), nullptr));
}

TEST(ReferenceShape, AnotherAspectIsAnotherWindow) {
  ReferenceShape shape = learned();
  View view;
  view.width_m = 0.7;
  const auto camera_used = camera();
  const auto off = shape.inAspect(view.opening(), spread(0.2), kImage, &camera_used);
  ASSERT_TRUE(off);
  EXPECT_GT(off->value, off->limit);
  view.width_m = 1.1;
  EXPECT_TRUE(shape.inAspect(view.opening(), spread(0.2), kImage, &camera_used)) << "a twelfth narrower";
}

TEST(ReferenceShape, AnUnknownCameraTellsAspectsApartThatAreFarOff) {
  ReferenceShape shape = learned();
  View view;
  view.width_m = 0.7;
  EXPECT_FALSE(shape.inAspect(view.opening(), spread(0.2), kImage, nullptr));
  view.width_m = 0.5;
  EXPECT_TRUE(shape.inAspect(view.opening(), spread(0.2), kImage, nullptr)) << "a slot";
  std::mt19937 random(6);
  for (int i = 0; i < 30; ++i)
    EXPECT_FALSE(shape.inAspect(randomView(random).opening(), spread(0.2), kImage, nullptr)) << i;
}

TEST(ReferenceShape, AFramelessReferenceAsksForNoFrame) {
  View view;
  view.frame_m = 0.0;
  ReferenceShape shape;
  shape.learn(view.draw(), view.opening());
  EXPECT_FALSE(shape.inFrame(View().draw(), View().opening(), nullptr));
}

TEST(ReferenceShape, NothingToldWithoutAReferenceOrSense) {
  ReferenceShape shape;
  const auto camera_used = camera();
  const View view;
  EXPECT_FALSE(shape.inAspect(view.opening(), spread(0.2), kImage, &camera_used));
  EXPECT_FALSE(shape.inFrame(view.draw(), view.opening(), &camera_used));
  shape.learn(cv::Mat(), view.opening());
  shape.learn(view.draw(), test::rectangle(7, 7, 7, 7));
  EXPECT_FALSE(shape.inAspect(view.opening(), spread(0.2), kImage, &camera_used));
  shape = learned();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(shape.inFrame(view.draw(), test::rectangle(nan, 0, 5, 5), nullptr));
  EXPECT_FALSE(shape.inFrame(cv::Mat(480, 640, CV_8UC1), view.opening(), nullptr));
}

}  // namespace window_ingress::detection::reference_shape_test
