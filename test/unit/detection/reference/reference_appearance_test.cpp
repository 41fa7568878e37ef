#include "window_ingress/detection/reference_appearance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "drawn_window.hpp"

namespace window_ingress::detection::reference_appearance_test {

const auto kOpening = test::rectangle(100, 80, 220, 170);
const cv::Scalar kOrange(50, 140, 215), kBlue(200, 120, 40);

cv::Mat window(const cv::Scalar& frame, const cv::Scalar& hole, double light = 1.0) {
  test::DrawnWindow drawn;
  drawn.width = 320, drawn.height = 240, drawn.opening = kOpening, drawn.frame_px = 6;
  drawn.frame = frame, drawn.hole = hole;
  cv::Mat image = drawn.draw();
  image.convertTo(image, -1, light);
  return image;
}

double distance(const cv::Mat& image, const geometry::Quadrilateral& quad = kOpening) {
  const ReferenceAppearance reference(window(kOrange, cv::Scalar(60, 55, 50)), kOpening);
  const auto result = reference.compare(image, quad, AppearanceParams());
  EXPECT_TRUE(result);
  return result ? result->distance : -1.0;
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

TEST(ReferenceAppearance, SaysWhyAnImageCannotBeOne) {
  const cv::Mat drawn = window(kOrange, cv::Scalar(60, 55, 50));
  EXPECT_EQ(ReferenceAppearance::faultOf(drawn, kOpening), "");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::pair<geometry::Quadrilateral, std::string> bad[] = {
      {test::rectangle(5000, 5000, 5100, 5100), "outside"},
      {test::rectangle(100, 80, 110, 170), "10 pixels long"},
      {{Eigen::Vector2d(nan, 0), {9, 0}, {9, 9}, {0, 9}}, "convex"},
      {{Eigen::Vector2d(100, 80), {220, 170}, {220, 80}, {100, 170}}, "convex"}};
  for (const auto& [corners, word] : bad)
    EXPECT_NE(ReferenceAppearance::faultOf(drawn, corners).find(word), std::string::npos) << word;
  EXPECT_NE(ReferenceAppearance::faultOf(cv::Mat(), kOpening), "");
  EXPECT_NE(ReferenceAppearance::faultOf(cv::Mat(240, 320, CV_16UC3), kOpening), "");
}

TEST(ReferenceAppearance, KnowsWhetherItsOpeningIsAGuess) {
  const cv::Mat drawn = window(kOrange, cv::Scalar(60, 55, 50));
  EXPECT_TRUE(ReferenceAppearance(drawn, kOpening).openingIsKnown());
  EXPECT_FALSE(ReferenceAppearance(drawn).openingIsKnown());
  EXPECT_FALSE(ReferenceAppearance::guessed(drawn, kOpening).openingIsKnown());
}

TEST(ReferenceAppearance, NoAnswerForGreyTooFewPixelsAndBadQuads) {
  const ReferenceAppearance reference(window(kOrange, cv::Scalar(60, 55, 50)), kOpening);
  const AppearanceParams params;
  const cv::Mat image = window(kOrange, cv::Scalar(60, 55, 50));
  EXPECT_FALSE(reference.compare(cv::Mat(240, 320, CV_8UC1, cv::Scalar(9)), kOpening, params));
  EXPECT_FALSE(reference.compare(cv::Mat(), kOpening, params));
  EXPECT_FALSE(reference.compare(image, test::rectangle(100, 80, 106, 86), params));
  EXPECT_FALSE(reference.compare(image, test::rectangle(-900, -900, -800, -800), params));
  auto broken = kOpening;
  broken[1].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(reference.compare(image, broken, params));
  const ReferenceAppearance grey(cv::Mat(240, 320, CV_8UC1, cv::Scalar(9)), kOpening);
  EXPECT_FALSE(grey.compare(image, kOpening, params));
}

// The target's frame, a little bluer.
cv::Mat evening() { return window(cv::Scalar(75, 140, 205), cv::Scalar(60, 55, 50)); }

TEST(ReferenceAppearance, WholeImageCountsItsRimForTheFrame) {
  const cv::Mat image = window(kOrange, cv::Scalar(60, 55, 50));
  const ReferenceAppearance rim(image(cv::Rect(93, 73, 134, 104)));
  const auto own = rim.compare(image, kOpening, {}),
             other = rim.compare(window(kBlue, cv::Scalar()), kOpening, {});
  ASSERT_TRUE(own && other);
  EXPECT_LT(own->distance, 0.2);
  EXPECT_GT(other->distance, 0.6);
}

TEST(ReferenceAppearance, LimitAndOddsFollowWhatElseIsInTheImage) {
  const ReferenceAppearance orange(window(kOrange, cv::Scalar(60, 55, 50)), kOpening);
  const ReferenceAppearance bare(window(test::DrawnWindow().wall, cv::Scalar(60, 55, 50)), kOpening);
  const cv::Mat image = window(kOrange, cv::Scalar(60, 55, 50));
  const auto seen = orange.compare(image, kOpening, {});
  ASSERT_TRUE(seen);
  EXPECT_GT(seen->limit, 0.3);
  EXPECT_GT(seen->odds, 4.0);
  const auto blue = orange.compare(window(kBlue, cv::Scalar(60, 55, 50)), kOpening, {});
  ASSERT_TRUE(blue);
  EXPECT_LT(blue->odds, 1.0);
  const auto wall = bare.compare(image, test::rectangle(20, 20, 60, 60), {});
  ASSERT_TRUE(wall);
  EXPECT_LT(std::abs(std::log2(wall->odds)), 1.0) << "a frame of the wall's colour tells little";
}

TEST(ReferenceAppearance, AdaptsToTheLightButNeverFurtherThanAllowed) {
  ReferenceAppearance reference(window(kOrange, cv::Scalar(60, 55, 50)), kOpening);
  const cv::Mat view = evening();
  const AppearanceParams params;
  const double before = reference.compare(view, kOpening, params)->distance;
  EXPECT_EQ(reference.drift(), 0.0);
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(reference.adapt(view, kOpening, 0.1, params));
  EXPECT_LT(reference.compare(view, kOpening, params)->distance, 0.6 * before);
  EXPECT_LT(reference.compare(window(kOrange, cv::Scalar(60, 55, 50)), kOpening, params)->distance, 0.01)
      << "the reference image stays valid";
  for (int i = 0; i < 200; ++i)
    reference.adapt(window(kOrange + i / 200.0 * (kBlue - kOrange), cv::Scalar(60, 55, 50)), kOpening, 0.3,
                    params);
  EXPECT_LE(reference.drift(), ReferenceAppearance::kMaxDrift);
  EXPECT_GT(reference.drift(), 0.7 * ReferenceAppearance::kMaxDrift);
}

TEST(ReferenceAppearance, DoesNotAdaptToSomethingElse) {
  ReferenceAppearance reference(window(kOrange, cv::Scalar(60, 55, 50)), kOpening);
  EXPECT_FALSE(reference.adapt(window(kBlue, cv::Scalar(60, 55, 50)), kOpening, 0.5, {}));
  EXPECT_FALSE(reference.adapt(evening(), kOpening, 0.0, {}));
  EXPECT_FALSE(reference.adapt(evening(), kOpening, std::numeric_limits<double>::quiet_NaN(), {}));
  EXPECT_FALSE(reference.adapt(cv::Mat(), kOpening, 0.5, {}));
  EXPECT_EQ(reference.drift(), 0.0);
}

}  // namespace window_ingress::detection::reference_appearance_test
