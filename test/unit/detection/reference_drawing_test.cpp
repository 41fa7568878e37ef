#include <gtest/gtest.h>

#include <random>

#include "detection/reference/ring_colours.hpp"
#include "drawn_window.hpp"
#include "window_ingress/detection/debug_image.hpp"

namespace window_ingress::detection::reference_drawing_test {

const geometry::Quadrilateral kOpening{Eigen::Vector2d(200, 150), {400, 150}, {400, 350}, {200, 350}};

cv::Mat image(int type) { return {480, 640, type, cv::Scalar::all(100)}; }

TEST(RingLine, LiesSoFarOutsideASquare) {
  const auto line = ringLine(kOpening, 0.1);
  EXPECT_NEAR((line[0] - Eigen::Vector2d(180, 130)).norm(), 0.0, 1e-6);
  EXPECT_NEAR((line[2] - Eigen::Vector2d(420, 370)).norm(), 0.0, 1e-6);
}

TEST(RingLine, HoldsTheOpeningWhateverItsShape) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> jitter(-30.0, 30.0);
  for (int i = 0; i < 200; ++i) {
    geometry::Quadrilateral quad = kOpening;
    for (auto& corner : quad) corner += Eigen::Vector2d(jitter(random), jitter(random));
    const auto line = ringLine(quad, 0.1);
    ASSERT_TRUE(geometry::isConvex(line));
    for (const auto& corner : quad) EXPECT_TRUE(geometry::contains(line, corner));
  }
}

// The compared colours are tinted, the rest is faded, and the border is green.
TEST(DrawReference, ShowsBorderAndBands) {
  const ReferenceAppearance reference(image(CV_8UC3), kOpening);
  const cv::Mat drawn = drawReference(reference);  // bands: 10 px and 28 px wide
  ASSERT_EQ(drawn.type(), CV_8UC3);
  EXPECT_EQ(drawn.cols, 640);
  EXPECT_GT(drawn.rows, 480);
  const auto at = [&](int x, int y) { return drawn.at<cv::Vec3b>(y, x); };
  EXPECT_EQ(at(300, 250), cv::Vec3b::all(45)) << "what is seen through the opening does not count";
  EXPECT_EQ(at(300, 50), cv::Vec3b::all(45)) << "nor the wall far from it";
  EXPECT_GT(at(300, 144)[2], at(300, 144)[0]) << "the frame in orange";
  EXPECT_GT(at(300, 130)[0], at(300, 130)[2]) << "the surround in blue";
  EXPECT_GT(at(300, 150)[1], 150) << "the border in green";
}

TEST(DrawReference, GreyImagesAndGuessesAreDrawn) {
  EXPECT_EQ(drawReference(ReferenceAppearance(image(CV_8UC1), kOpening)).type(), CV_8UC3);
  const cv::Mat known = drawReference(ReferenceAppearance(image(CV_8UC3), kOpening));
  const cv::Mat guessed = drawReference(ReferenceAppearance::guessed(image(CV_8UC3), kOpening));
  EXPECT_GT(cv::norm(known, guessed), 0.0) << "the text says so";
}

}  // namespace window_ingress::detection::reference_drawing_test
