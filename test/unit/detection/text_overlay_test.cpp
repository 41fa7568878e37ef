#include "window_ingress/detection/text_overlay.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/imgproc.hpp>

#include "drawn_window.hpp"

namespace window_ingress::detection::text_overlay_test {

const cv::Scalar kWhite(255, 255, 255);

bool isBlank(const cv::Mat& canvas) {
  cv::Mat grey;
  cv::cvtColor(canvas, grey, cv::COLOR_BGR2GRAY);
  return cv::countNonZero(grey != 100) == 0;
}

TEST(TextOverlay, LabelsKeepOffEachOther) {
  cv::Mat canvas(480, 640, CV_8UC3, cv::Scalar::all(100));
  TextOverlay overlay(canvas);
  int written = 0;
  while (written < 100 && overlay.label({"aspect 3.1 > 2.5", kWhite}, {320, 240})) ++written;
  EXPECT_GE(written, 4);
  EXPECT_LT(written, 12) << "there is room for a few beside one point";
}

TEST(TextOverlay, NothingIsWrittenOutsideOrWhereItIsToBeFree) {
  cv::Mat canvas(480, 640, CV_8UC3, cv::Scalar::all(100));
  TextOverlay overlay(canvas);
  overlay.keepFree({200, 150, 240, 180});
  EXPECT_FALSE(overlay.label({"label", kWhite}, {5000, 5000}));
  EXPECT_FALSE(overlay.label({"label", kWhite}, {320, 240}));
  EXPECT_TRUE(isBlank(canvas));
  EXPECT_TRUE(overlay.label({"label", kWhite}, {200, 150})) << "above it";
  EXPECT_TRUE(isBlank(canvas(cv::Rect(200, 150, 240, 180)))) << "area kept free";
}

TEST(TextOverlay, TheBoxLeavesFreeWhatIsToBeFree) {
  const cv::Rect upper_left(10, 10, 200, 200), upper_right(430, 10, 200, 200);
  cv::Mat canvas(480, 640, CV_8UC3, cv::Scalar::all(100));
  TextOverlay overlay(canvas);
  overlay.keepFree(upper_left);
  overlay.keepFree(upper_right);
  overlay.box({{"11  corners", kWhite}, {"3  aspect", kWhite}});
  EXPECT_TRUE(isBlank(canvas(upper_left)));
  EXPECT_TRUE(isBlank(canvas(upper_right)));
  EXPECT_FALSE(isBlank(canvas));
  cv::Mat crowded(480, 640, CV_8UC3, cv::Scalar::all(100));
  TextOverlay everywhere(crowded);
  for (int x : {0, 400})
    for (int y : {0, 250}) everywhere.keepFree({x, y, 240, 230});
  everywhere.box({{"11  corners", kWhite}});
  EXPECT_FALSE(isBlank(crowded(cv::Rect(0, 0, 100, 50)))) << "in its usual corner";
}

TEST(TextOverlay, TextGrowsWithTheImage) {
  const auto boxHeight = [](int rows, int cols) {
    cv::Mat canvas(rows, cols, CV_8UC3, cv::Scalar::all(100)), blank;
    TextOverlay(canvas).box({{"corners", kWhite}});
    cv::inRange(canvas, cv::Scalar::all(100), cv::Scalar::all(100), blank);
    return cv::boundingRect(255 - blank).height;
  };
  EXPECT_GT(boxHeight(1200, 1600), 2 * boxHeight(240, 320));
}

TEST(TextOverlay, BadQuadrilateralsAreNotDrawn) {
  cv::Mat canvas(480, 640, CV_8UC3, cv::Scalar::all(100));
  auto quad = test::rectangle(100, 100, 200, 200);
  quad[1].x() = std::numeric_limits<double>::quiet_NaN();
  drawQuad(canvas, quad, kWhite, 1);
  quad[1].x() = 1e9;
  drawQuad(canvas, quad, kWhite, 1);
  EXPECT_TRUE(isBlank(canvas));
  drawQuad(canvas, test::rectangle(100, 100, 200, 200), kWhite, 1);
  EXPECT_FALSE(isBlank(canvas));
}

}  // namespace window_ingress::detection::text_overlay_test
