#include "window_ingress/detection/debug_image.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "drawn_window.hpp"

namespace window_ingress::detection {
namespace {

TEST(DebugImage, TargetIsGreenWithAYellowCentre) {
  WindowObservation window;
  window.corners = test::rectangle(100, 80, 220, 170);
  cv::Mat canvas;
  for (int type : {CV_8UC1, CV_8UC3}) {
    drawDetection(cv::Mat(240, 320, type, cv::Scalar::all(90)), DetectionTrace(), &window, canvas);
    ASSERT_EQ(canvas.type(), CV_8UC3);
    EXPECT_EQ(canvas.at<cv::Vec3b>(125, 160), cv::Vec3b(0, 255, 255));
    const cv::Vec3b side = canvas.at<cv::Vec3b>(80, 160);
    EXPECT_GT(side[1], side[0] + 60);
    EXPECT_GT(side[1], side[2] + 60);
  }
}

TEST(DebugImage, RejectedCandidatesAreDrawnAndBadInputIsBorne) {
  DetectionTrace trace;
  trace.candidates.push_back({test::rectangle(150, 100, 200, 150), CandidateSource::kContour,
                              RejectReason::kAspect, 3.0, 2.0, 0.0, false, 0.0});
  auto broken = test::rectangle(150, 100, 1e12, 150);
  broken[0].x() = std::numeric_limits<double>::quiet_NaN();
  trace.candidates.push_back(
      {broken, CandidateSource::kSegments, RejectReason::kAngle, 1.0, 0.5, 0.0, false, 0.0});
  const cv::Mat image(240, 320, CV_8UC3, cv::Scalar::all(90));
  cv::Mat canvas;
  drawDetection(image, trace, nullptr, canvas);
  EXPECT_NE(canvas.at<cv::Vec3b>(100, 175), image.at<cv::Vec3b>(100, 175));
  cv::Mat untouched;
  drawDetection(cv::Mat(), trace, nullptr, untouched);
  EXPECT_TRUE(untouched.empty());
}

}  // namespace
}  // namespace window_ingress::detection
