#include "window_ingress/detection/reference_appearance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "drawn_window.hpp"

namespace window_ingress::detection {
namespace {

const auto kOpening = test::rectangle(100, 80, 220, 170);
const cv::Scalar kOrange(50, 140, 215), kBlue(200, 120, 40);

cv::Mat window(const cv::Scalar& frame, const cv::Scalar& hole, double light = 1.0) {
  test::WindowPicture picture;
  picture.width = 320, picture.height = 240, picture.opening = kOpening, picture.frame_px = 6;
  picture.frame = frame, picture.hole = hole;
  cv::Mat image = picture.draw();
  image.convertTo(image, -1, light);
  return image;
}

double distance(const cv::Mat& image, const geometry::Quadrilateral& quad = kOpening) {
  const ReferenceAppearance reference(window(kOrange, cv::Scalar(60, 55, 50)), kOpening);
  const auto result = reference.distance(image, quad, AppearanceParams());
  EXPECT_TRUE(result);
  return result.value_or(-1.0);
}

TEST(ReferenceAppearance, ItselfIsNear) {
  EXPECT_LT(distance(window(kOrange, cv::Scalar(60, 55, 50))), 0.01);
}

TEST(ReferenceAppearance, WhatIsSeenThroughTheHoleDoesNotCount) {
  EXPECT_LT(distance(window(kOrange, cv::Scalar(20, 230, 20))), 0.15);
}

TEST(ReferenceAppearance, BrightnessDoesNotCount) {
  for (double light : {0.5, 0.7, 1.15})
    EXPECT_LT(distance(window(kOrange, cv::Scalar(60, 55, 50), light)), 0.35);
}

TEST(ReferenceAppearance, AnotherPaintIsFar) {
  EXPECT_GT(distance(window(kBlue, cv::Scalar(60, 55, 50))), 0.6);
}

TEST(ReferenceAppearance, TheOuterBorderOfTheSameFrameIsFurther) {
  const cv::Mat image = window(kOrange, cv::Scalar(60, 55, 50));
  EXPECT_GT(distance(image, test::grown(kOpening, 6)), distance(image) + 0.3);
}

TEST(ReferenceAppearance, NoAnswerForGreyTooFewPixelsAndBadQuads) {
  const ReferenceAppearance reference(window(kOrange, cv::Scalar(60, 55, 50)), kOpening);
  const AppearanceParams params;
  const cv::Mat image = window(kOrange, cv::Scalar(60, 55, 50));
  EXPECT_FALSE(reference.distance(cv::Mat(240, 320, CV_8UC1, cv::Scalar(9)), kOpening, params));
  EXPECT_FALSE(reference.distance(cv::Mat(), kOpening, params));
  EXPECT_FALSE(reference.distance(image, test::rectangle(100, 80, 106, 86), params));
  EXPECT_FALSE(reference.distance(image, test::rectangle(-900, -900, -800, -800), params));
  auto broken = kOpening;
  broken[1].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(reference.distance(image, broken, params));
  const ReferenceAppearance grey(cv::Mat(240, 320, CV_8UC1, cv::Scalar(9)), kOpening);
  EXPECT_FALSE(grey.distance(image, kOpening, params));
}

TEST(ReferenceAppearance, HistogramBandsSumToOneTogether) {
  const auto histogram = ringHistogram(window(kOrange, kBlue), kOpening, AppearanceParams());
  ASSERT_TRUE(histogram);
  EXPECT_NEAR(cv::sum(*histogram)[0], 1.0, 1e-4);
}

}  // namespace
}  // namespace window_ingress::detection
