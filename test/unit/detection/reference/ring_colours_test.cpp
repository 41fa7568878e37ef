#include "detection/reference/ring_colours.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "drawn_window.hpp"
#include "window_ingress/detection/reference_appearance.hpp"

namespace window_ingress::detection::ring_colours_test {

const auto kOpening = test::rectangle(100, 80, 220, 170);
const cv::Scalar kOrange(50, 140, 215), kWall(150, 160, 170);
constexpr int kFew = 40;

// Noise around a frame of 6 px and a wall.
cv::Mat noisyWindow(std::uint64_t seed, double sigma) {
  cv::Mat image(240, 320, CV_8UC3, kWall);
  cv::rectangle(image, {94, 74}, {226, 176}, kOrange, cv::FILLED);
  cv::rectangle(image, {100, 80}, {220, 170}, cv::Scalar(20, 20, 20), cv::FILLED);
  cv::Mat noise(image.size(), CV_32FC3);
  cv::RNG(seed).fill(noise, cv::RNG::NORMAL, 0.0, sigma);
  cv::add(image, noise, image, cv::noArray(), CV_8U);
  return image;
}

double sumOf(const RingHistogram::Band& band) {
  return std::accumulate(band.share.begin(), band.share.end(), 0.0);
}

TEST(RingHistogram, EachBandSumsToOne) {
  const auto histogram = ringColours(noisyWindow(1, 5.0), kOpening, kFew);
  ASSERT_TRUE(histogram);
  for (const auto& band : histogram->seen.bands) {
    EXPECT_NEAR(sumOf(band), 1.0, 1e-4);
    EXPECT_GT(band.pixels, 100.0);
  }
}

TEST(RingHistogram, DistanceHasTheLimitsAndTheSymmetryOfADistance) {
  const auto orange = ringColours(noisyWindow(1, 5.0), kOpening, kFew);
  cv::Mat swapped;
  cv::cvtColor(noisyWindow(1, 5.0), swapped, cv::COLOR_BGR2RGB);
  const auto blue = ringColours(swapped, kOpening, kFew);
  ASSERT_TRUE(orange && blue);
  EXPECT_DOUBLE_EQ(bhattacharyya(*orange, *orange), 0.0);
  EXPECT_NEAR(bhattacharyya(*orange, *blue), bhattacharyya(*blue, *orange), 0.02);
  EXPECT_GT(bhattacharyya(*orange, *blue), 0.6);
}

TEST(RingMeans, PaintIsTheHueOfAFrameThatHasOneWhateverItsLight) {
  RingMeans ring;
  ring.frame = {50, 140, 215}, ring.surround = {150, 160, 170};
  const auto paint = ring.paint();
  ASSERT_TRUE(paint);
  EXPECT_NEAR(paint->norm(), 1.0, 1e-5);
  EXPECT_NEAR(paint->sum(), 0.0, 1e-5);
  EXPECT_GT(paint->z(), 0.5F) << "orange: red ...";
  EXPECT_LT(paint->x(), -0.5F) << "... and no blue";
  ring.frame *= 0.5F, ring.surround *= 0.5F;
  ASSERT_TRUE(ring.paint());
  EXPECT_GT(ring.paint()->dot(*paint), 0.99F);
  ring.frame = {228, 235, 235}, ring.surround = {40, 70, 170};
  EXPECT_FALSE(ring.paint()) << "white on brick: the colour is that of the wall";
  ring.frame = {45, 75, 175};
  EXPECT_FALSE(ring.paint()) << "that of the wall";
}

// A ring of few pixels is no further away than one of many pixels of the same colours.
TEST(RingHistogram, FewPixelsOfTheSameColoursAreNotFurther) {
  cv::Mat colours(600, 800, CV_8UC3);
  cv::RNG random(7);
  random.fill(colours, cv::RNG::UNIFORM, 60, 200);
  const auto reference = ringColours(colours, test::rectangle(200, 150, 600, 450), kFew);
  ASSERT_TRUE(reference);
  for (double side : {30.0, 60.0, 120.0}) {
    double sum_of_squares = 0.0;
    constexpr int kTrials = 200;
    for (int i = 0; i < kTrials; ++i) {
      const double x = random.uniform(50.0, 600.0), y = random.uniform(50.0, 400.0);
      const auto sample = ringColours(colours, test::rectangle(x, y, x + side, y + side), kFew);
      ASSERT_TRUE(sample);
      const double distance = bhattacharyya(*reference, *sample);
      sum_of_squares += distance * distance;
    }
    EXPECT_LT(sum_of_squares / kTrials, 0.02) << side;
  }
}

TEST(RingHistogram, AVeilOfHazeIsTakenOff) {
  const cv::Mat clear = noisyWindow(1, 2.0);
  const auto reference = ringColours(clear, kOpening, kFew);
  cv::Mat hazy, other;
  clear.convertTo(hazy, -1, 0.4, 0.6 * 190);
  cv::cvtColor(hazy, other, cv::COLOR_BGR2RGB);
  const auto same = ringColours(hazy, kOpening, kFew), blue = ringColours(other, kOpening, kFew);
  ASSERT_TRUE(reference && same && blue);
  EXPECT_LT(bhattacharyya(*reference, *same), 0.35);
  EXPECT_GT(bhattacharyya(*reference, *blue), 0.6);
}

TEST(RingHistogram, ABandOutsideTheImageIsNotSeenAndNotCompared) {
  const cv::Mat image = noisyWindow(1, 2.0), frame = image(cv::Rect(93, 73, 135, 105)).clone();
  const auto whole = ringColours(image, kOpening, kFew);
  const auto cut = ringColours(frame, test::rectangle(7, 7, 127, 97), kFew);
  ASSERT_TRUE(whole && cut);
  EXPECT_GT(cut->seen.bands[0].pixels, 0.0);
  EXPECT_EQ(cut->seen.bands[1].pixels, 0.0);
  EXPECT_LT(bhattacharyya(*whole, *cut), 0.2);
}

TEST(RingHistogram, BlendGoesFromOneToTheOther) {
  const auto a = ringColours(noisyWindow(1, 2.0), kOpening, kFew);
  const auto b = ringColours(noisyWindow(2, 40.0), kOpening, kFew);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(blended(*a, *b, 0.0).seen.bands[0].share, a->seen.bands[0].share);
  EXPECT_NEAR(bhattacharyya(blended(*a, *b, 1.0), *b), 0.0, 1e-6);
  EXPECT_LT(bhattacharyya(blended(*a, *b, 0.3), *a), bhattacharyya(blended(*a, *b, 0.7), *a) + 1e-9);
}

TEST(RingHistogram, GreyImagesHaveNoAnswer) {
  const cv::Mat noisy = noisyWindow(1, 5.0);
  cv::Mat grey;
  cv::cvtColor(noisy, grey, cv::COLOR_BGR2GRAY);
  EXPECT_FALSE(ringColours(grey, kOpening, kFew));
  cv::cvtColor(grey, grey, cv::COLOR_GRAY2BGR);
  EXPECT_FALSE(ringColours(grey, kOpening, kFew));
  EXPECT_TRUE(isGrey(grey));
  cv::rectangle(grey, {0, 200}, {320, 240}, cv::Scalar(20, 20, 220), cv::FILLED);
  EXPECT_FALSE(isGrey(grey));
  EXPECT_TRUE(ringColours(grey, kOpening, kFew)) << "a colourless frame in an image with colours";
}

TEST(RingHistogram, BadQuadrilateralsHaveNoAnswer) {
  const cv::Mat image = noisyWindow(1, 5.0);
  auto broken = kOpening;
  broken[2].y() = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(ringColours(image, broken, kFew));
  EXPECT_FALSE(ringColours(image, test::rectangle(5, 5, 5, 5), kFew));
  EXPECT_FALSE(ringColours(image, test::rectangle(-1e7, -1e7, 1e7, 1e7), kFew));
  EXPECT_FALSE(ringColours(cv::Mat(), kOpening, kFew));
}

// Steep perspectives, partly outside the image and beyond the horizon: no pixel outside the image is read.
TEST(RingHistogram, StaysWithinTheImage) {
  cv::RNG random(3);
  const cv::Mat image = noisyWindow(1, 5.0);
  for (int i = 0; i < 3000; ++i) {
    geometry::Quadrilateral quad;
    for (auto& p : quad) p = {random.uniform(-400.0, 700.0), random.uniform(-300.0, 500.0)};
    const auto canonical = geometry::canonical(quad);
    if (!canonical) continue;
    const auto colours = ringColours(image, *canonical, 1);
    EXPECT_TRUE(!colours || (colours->means.darkest >= 0.0 && colours->means.darkest <= 255.0));
  }
}

}  // namespace window_ingress::detection::ring_colours_test
