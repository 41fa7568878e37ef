#include "opencv_composition.hpp"

#include <gtest/gtest.h>

#include "drawn_window.hpp"

namespace window_ingress::test::opencv_composition_test {

constexpr double kFramePx = 14.0, kLinePx = 8.0;  ///< it may find the outer border; its lines are thick
constexpr double kLeft = 220, kTop = 140, kRight = 420, kBottom = 320;

DrawnWindow plainWindow() {
  DrawnWindow drawn;
  drawn.opening = rectangle(kLeft, kTop, kRight, kBottom);
  drawn.frame_px = kFramePx;
  return drawn;
}

std::vector<cv::Point> opening() {
  return {{int(kLeft), int(kTop)},
          {int(kRight), int(kTop)},
          {int(kRight), int(kBottom)},
          {int(kLeft), int(kBottom)}};
}

bool isNear(const std::vector<cv::Point>& found, double tolerance_px) {
  const cv::Rect box = cv::boundingRect(found);
  return std::abs(box.x - kLeft) < tolerance_px && std::abs(box.y - kTop) < tolerance_px &&
         std::abs(box.br().x - kRight) < tolerance_px && std::abs(box.br().y - kBottom) < tolerance_px;
}

TEST(OpencvComposition, WithoutHoughItFindsAPlainWindow) {
  OpencvComposition composition(false);
  const auto found = composition.run(plainWindow().draw());
  ASSERT_EQ(found.size(), 4u);
  EXPECT_TRUE(isNear(found, kFramePx + kLinePx)) << cv::boundingRect(found);
}

// In most images the redrawn segments leave gaps at the corners, the weakness of the literal pipeline. In a
// clean image it works.
TEST(OpencvComposition, WithHoughItFindsAWindowInAnImageWithoutNoise) {
  OpencvComposition composition;
  DrawnWindow clean = plainWindow();
  clean.noise = 0.0;
  const auto found = composition.run(clean.draw());
  ASSERT_EQ(found.size(), 4u);
  EXPECT_TRUE(isNear(found, kFramePx + kLinePx)) << cv::boundingRect(found);
}

TEST(OpencvComposition, FindsNothingInAFlatImage) {
  OpencvComposition composition;
  EXPECT_TRUE(composition.run(cv::Mat(480, 640, CV_8UC3, cv::Scalar(150, 165, 175))).empty());
}

TEST(OpencvComposition, ReferenceOfAnotherColourRejects) {
  OpencvComposition composition(false);
  DrawnWindow other = plainWindow();
  other.hole = cv::Scalar(40, 200, 40), other.frame = cv::Scalar(220, 40, 200);
  composition.setReference(other.draw(), opening());
  EXPECT_TRUE(composition.run(plainWindow().draw()).empty());
  composition.setReference(plainWindow().draw(), opening());
  EXPECT_EQ(composition.run(plainWindow().draw()).size(), 4u);
}

TEST(OpencvComposition, OddSizesAndOtherSizesAfterwards) {
  OpencvComposition composition;
  for (const cv::Size size : {cv::Size(683, 511), cv::Size(315, 160), cv::Size(640, 480)})
    EXPECT_NO_THROW(composition.run(cv::Mat(size, CV_8UC3, cv::Scalar(10, 20, 30)))) << size;
}

}  // namespace window_ingress::test::opencv_composition_test
