#include <gtest/gtest.h>

#include <limits>
#include <opencv2/imgproc.hpp>

#include "detection/borders/edge_profiles.hpp"
#include "window_ingress/detection/border_refinement.hpp"

namespace window_ingress::detection::colour_sharpness_test {

const cv::Scalar kFrame(70, 158, 209), kPaint(58, 137, 184), kReveal(128, 142, 152), kBehind(60, 60, 60);
const geometry::Quadrilateral kOpening{
    {{60.5, 50.5}, {199.5, 50.5}, {199.5, 159.5}, {60.5, 159.5}}};  // between two pixels

// A frame with two darker pixels of paint around its corner, a reveal as bright as these, and the background.
cv::Mat drawn(double noise) {
  cv::Mat image(210, 260, CV_8UC3, kFrame);
  image(cv::Rect(61, 51, 139, 109)).setTo(kPaint);
  image(cv::Rect(63, 53, 135, 105)).setTo(kReveal);
  image(cv::Rect(69, 59, 123, 93)).setTo(kBehind);
  cv::Mat rough(image.size(), CV_16SC3), sum;
  cv::RNG random(5);
  random.fill(rough, cv::RNG::NORMAL, 0.0, noise);
  image.convertTo(sum, CV_16SC3);
  sum += rough;
  sum.convertTo(image, CV_8UC3);
  cv::GaussianBlur(image, image, {}, 0.6);
  return image;
}

// Colour at half the resolution, as in a compressed image.
cv::Mat withSoftColour(const cv::Mat& image) {
  cv::Mat planes[3], small, converted;
  cv::cvtColor(image, converted, cv::COLOR_BGR2YCrCb);
  cv::split(converted, planes);
  for (int c = 1; c < 3; ++c) {
    cv::resize(planes[c], small, {}, 0.5, 0.5, cv::INTER_AREA);
    cv::resize(small, planes[c], planes[c].size(), 0.0, 0.0, cv::INTER_LINEAR);
  }
  cv::merge(planes, 3, converted);
  cv::cvtColor(converted, converted, cv::COLOR_YCrCb2BGR);
  return converted;
}

EdgeProfiles topOf(const cv::Mat& image) {
  EdgeProfiles profiles;
  profiles.sample(image, nullptr, {kOpening[0], kOpening[1], 40, 0.06, 7});
  return profiles;
}

TEST(ColourSharpness, OfHalfTheSizeIsSoftAndAsTakenIsNot) {
  for (const double noise : {0.0, 2.0, 6.0}) {
    EXPECT_FALSE(isColourSoft(topOf(drawn(noise)))) << noise;
    EXPECT_TRUE(isColourSoft(topOf(withSoftColour(drawn(noise))))) << noise;
  }
}

TEST(ColourSharpness, WithoutColourNothingIsSoft) {
  cv::Mat grey, same;
  cv::cvtColor(drawn(2.0), grey, cv::COLOR_BGR2GRAY);
  cv::cvtColor(grey, same, cv::COLOR_GRAY2BGR);
  EXPECT_FALSE(isColourSoft(topOf(grey)));
  EXPECT_FALSE(isColourSoft(topOf(same)));
  EXPECT_FALSE(isColourSoft(topOf(cv::Mat(210, 260, CV_8UC3, kFrame))));
  EXPECT_FALSE(isColourSoft(EdgeProfiles()));
}

TEST(ColourSharpness, BrightnessKeepsItsPartAndColourLosesSome) {
  const Eigen::Vector3f change(40.0f, -5.0f, -20.0f), part = resolvedPart(change);
  EXPECT_NEAR(Eigen::Vector3f(0.114f, 0.587f, 0.299f).dot(part - change), 0.0, 1e-4);
  EXPECT_LT(part.norm(), 0.5f * change.norm());
  const Eigen::Vector3f grey = Eigen::Vector3f::Constant(7.0f);
  EXPECT_NEAR((resolvedPart(grey) - grey).norm(), 0.0, 1e-5);
}

TEST(ColourSharpness, TheFrontOfARevealIsWhereBrightnessChanges) {
  for (const double start_px : {-0.5, 0.0, 0.5}) {
    BorderStart start{kOpening, 2.5};
    for (auto& corner : start.quad) corner += Eigen::Vector2d::Constant(start_px);
    start.knowAll(1.0);
    const auto borders = refineBorders(withSoftColour(drawn(1.0)), start, nullptr);
    ASSERT_TRUE(borders);
    for (int i = 0; i < 4; ++i)
      EXPECT_LT((borders->corners[i] - kOpening[i]).cwiseAbs().maxCoeff(), 0.35) << start_px << " " << i;
  }
}

}  // namespace window_ingress::detection::colour_sharpness_test
