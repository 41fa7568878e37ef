#include "evaluation/images/stage_sheet.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "drawn_window.hpp"

namespace window_ingress::evaluation::stage_sheet_test {

constexpr int kWidth = 200;

test::DrawnWindow window() {
  test::DrawnWindow drawn;
  drawn.width = 320, drawn.height = 240, drawn.frame_px = 8;
  drawn.opening = test::rectangle(100, 70, 220, 170);
  return drawn;
}

bool holdsGreen(const cv::Mat& part) {
  for (int y = 0; y < part.rows; ++y)
    for (int x = 0; x < part.cols; ++x) {
      const auto& pixel = part.at<cv::Vec3b>(y, x);
      if (pixel[1] > pixel[0] + 100 && pixel[1] > pixel[2] + 100) return true;
    }
  return false;
}

TEST(StageSheet, ThreeRowsOfThreeAndTheTargetInTheLast) {
  const auto drawn = window();
  const detection::ReferenceAppearance reference(drawn.draw(), drawn.opening);
  const cv::Mat sheet = stageSheet(drawn.draw(), {}, &reference, kWidth);
  ASSERT_EQ(sheet.type(), CV_8UC3);
  EXPECT_NEAR(sheet.cols, 3 * kWidth, 40);
  EXPECT_NEAR(sheet.rows, 3 * kWidth * 240 / 320, 120);
  const cv::Rect last(sheet.cols * 2 / 3, sheet.rows * 2 / 3, sheet.cols / 3, sheet.rows / 3);
  EXPECT_TRUE(holdsGreen(sheet(last)));
  EXPECT_FALSE(holdsGreen(sheet(cv::Rect(0, 0, sheet.cols / 3, sheet.rows / 3))));
}

TEST(StageSheet, GreyImagesAndEmptyWallsAreDrawn) {
  EXPECT_FALSE(stageSheet(cv::Mat(240, 320, CV_8UC1, cv::Scalar(90)), {}, nullptr, kWidth).empty());
}

TEST(StageSheet, BadInputIsRefused) {
  EXPECT_THROW(stageSheet(cv::Mat(), {}, nullptr, kWidth), std::invalid_argument);
  EXPECT_THROW(stageSheet(cv::Mat(20, 20, CV_8UC3), {}, nullptr, kWidth), std::invalid_argument);
  EXPECT_THROW(stageSheet(cv::Mat(240, 320, CV_32FC1), {}, nullptr, kWidth), std::invalid_argument);
  EXPECT_THROW(stageSheet(cv::Mat(240, 320, CV_8UC3), {}, nullptr, 3), std::invalid_argument);
}

}  // namespace window_ingress::evaluation::stage_sheet_test
