#include "openness/interior/smooth_regions.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace window_ingress::openness::smooth_regions_test {

constexpr int kSide = OpeningCells::kSide;
constexpr double kSlope = 0.7;
constexpr std::uint64_t kAll = (std::uint64_t{1} << (kSide * kSide)) - 1;

std::uint64_t column(int x) {
  std::uint64_t cells = 0;
  for (int y = 0; y < kSide; ++y) cells |= std::uint64_t{1} << (y * kSide + x);
  return cells;
}

// A plain image whose two halves are separated by a vertical edge, with noise.
cv::Mat halves(double left, double right, double sigma) {
  cv::Mat image(120, 160, CV_8UC1, cv::Scalar(left));
  image.colRange(80, 160).setTo(right);
  cv::Mat noise(image.size(), CV_16SC1), sum;
  cv::RNG(7).fill(noise, cv::RNG::NORMAL, 0.0, sigma);
  image.convertTo(sum, CV_16SC1);
  sum += noise;
  sum.convertTo(image, CV_8UC1);
  cv::GaussianBlur(image, image, cv::Size(), 0.8);
  return image;
}

std::uint64_t beside(const cv::Mat& image, const cv::Point2f& point) {
  SmoothRegions regions;
  regions.find(image, kSlope);
  return regions.cellsBeside(point);
}

TEST(SmoothRegions, bothSidesOfAnEdgeLieBesideItsPoints) {
  for (const double noise : {0.0, 2.0, 4.0})
    EXPECT_EQ(
        beside(halves(100, 160, noise), {79.5f, 60.0f}) & (column(0) | column(1) | column(4) | column(5)),
        column(0) | column(1) | column(4) | column(5))
        << noise;
}

TEST(SmoothRegions, whatIsBeyondAnEdgeDoesNotLieBesideAPoint) {
  for (const double contrast : {5.0, 10.0, -20.0, 100.0}) {
    cv::Mat image = halves(100, 100 + contrast, 2.0);
    cv::circle(image, {25, 60}, 5, 160, -1);
    EXPECT_NE(beside(image, {20.0f, 60.0f}) & column(1), 0u);
    EXPECT_EQ(beside(image, {20.0f, 60.0f}) & (column(3) | column(4) | column(5)), 0u) << contrast;
  }
}

TEST(SmoothRegions, plainImageLiesBesideAnyOfItsPoints) {
  EXPECT_EQ(beside(halves(120, 120, 2.0), {30.0f, 30.0f}), kAll);
}

TEST(SmoothRegions, tooDarkOrTooBrightToShowAnEdgeIsNone) {
  EXPECT_EQ(beside(halves(8, 8, 1.0), {30.0f, 30.0f}), 0u);
  EXPECT_EQ(beside(halves(252, 252, 1.0), {30.0f, 30.0f}), 0u);
}

TEST(SmoothRegions, textureIsNone) { EXPECT_EQ(beside(halves(120, 120, 60.0), {30.0f, 30.0f}), 0u); }

TEST(SmoothRegions, pointsOutsideAndTinyImagesHarmNothing) {
  SmoothRegions regions;
  EXPECT_EQ(regions.cellsBeside({10.0f, 10.0f}), 0u) << "before any image";
  regions.find(cv::Mat(3, 2, CV_8UC1, cv::Scalar(100)), kSlope);
  for (const float place : {-1e6f, -3.0f, 1.0f, 50.0f, 1e6f}) (void)regions.cellsBeside({place, place});
  EXPECT_EQ(regions.cellsBeside({1e6f, 1e6f}), 0u);
}

}  // namespace window_ingress::openness::smooth_regions_test
