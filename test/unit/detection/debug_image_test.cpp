#include "window_ingress/detection/debug_image.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "drawn_window.hpp"

namespace window_ingress::detection::debug_image_test {

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

TEST(DebugImage, OfAPartialWindowOnlyTheSidesSeenAreDrawn) {
  WindowObservation window;
  window.corner_visible = {false, false, false, false};
  window.edges[geometry::kTop].visible = true;
  window.edges[geometry::kTop].a = {60, 100};
  window.edges[geometry::kTop].b = {250, 100};
  cv::Mat canvas;
  drawDetection(cv::Mat(240, 320, CV_8UC3, cv::Scalar::all(90)), DetectionTrace(), &window, canvas);
  const auto isGreen = [&](int x, int y) {
    const cv::Vec3b pixel = canvas.at<cv::Vec3b>(y, x);
    return pixel[1] > pixel[0] + 60 && pixel[1] > pixel[2] + 60;
  };
  EXPECT_TRUE(isGreen(150, 100));
  EXPECT_FALSE(isGreen(0, 0)) << "corners that were not seen are no corners";
  EXPECT_FALSE(isGreen(150, 150));
}

TEST(DebugImage, TheYawIsWrittenBesideAWholeWindowAlone) {
  const cv::Mat image(240, 320, CV_8UC3, cv::Scalar::all(90));
  const auto changed = [&](const WindowObservation& window) {
    cv::Mat canvas = image.clone();
    drawYaw(canvas, window, "yaw +12.3 +-0.4 deg");
    return cv::norm(canvas, image, cv::NORM_L1) > 0.0;
  };
  WindowObservation window;
  window.corners = test::rectangle(160, 80, 220, 170);
  EXPECT_TRUE(changed(window));
  WindowObservation broken = window;
  broken.corners[1].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(changed(broken));
  window.corner_visible[0] = false;
  EXPECT_FALSE(changed(window));
  cv::Mat none, grey(10, 10, CV_8UC1, cv::Scalar::all(0));
  drawYaw(none, broken, "yaw");
  drawYaw(grey, broken, "yaw");
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(cv::countNonZero(grey), 0);
}

TEST(DebugImage, GatesHaveColoursOfTheirOwnAndNoneIsTheTargetsGreen) {
  for (int i = 1; i < kRejectReasons; ++i) {
    const cv::Scalar colour = colourOf(static_cast<RejectReason>(i));
    EXPECT_FALSE(colour[1] > colour[0] + 60 && colour[1] > colour[2] + 60) << i;
    for (int k = 1; k < i; ++k)
      EXPECT_GT(cv::norm(colour - colourOf(static_cast<RejectReason>(k))), 35.0) << i << " " << k;
  }
}

TEST(DebugImage, WordsGoToWhatAGateStoppedBeforeWhatWasOutscored) {
  DetectionTrace trace;
  for (int i = 0; i < 12; ++i)
    trace.candidates.push_back(
        {test::rectangle(20 + 100 * (i % 6), 60 + 150 * (i / 6), 90 + 100 * (i % 6), 120 + 150 * (i / 6)),
         CandidateSource::kSegments, RejectReason::kOutscored, 0.8, 0.9, 0.8, false, 0.0});
  trace.candidates.push_back({test::rectangle(280, 380, 380, 440), CandidateSource::kSegments,
                              RejectReason::kAppearance, 0.825, 0.492, 0.3, true, 0.825});
  const cv::Mat image(480, 640, CV_8UC3, cv::Scalar::all(90));
  cv::Mat canvas, other;
  drawDetection(image, trace, nullptr, canvas);
  trace.candidates.back().value = 0.614;
  drawDetection(image, trace, nullptr, other);
  EXPECT_GT(cv::norm(canvas, other), 0.0) << "its value is told";
}

TEST(DebugImage, AnySizeAndAnyNumberOfCandidatesIsBorne) {
  DetectionTrace trace;
  for (int i = 0; i < 500; ++i)
    trace.candidates.push_back(
        {test::rectangle(i % 50, i % 30, i % 50 + 40.0, i % 30 + 30.0), CandidateSource::kSegments,
         static_cast<RejectReason>(1 + i % (kRejectReasons - 1)), 0.3, 0.4, 0.001 * i, false, 0.0});
  trace.detail = std::string(500, 'x');
  cv::Mat canvas;
  for (const cv::Size size : {cv::Size(16, 16), cv::Size(315, 160), cv::Size(2000, 1500)}) {
    drawDetection(cv::Mat(size, CV_8UC1, cv::Scalar(90)), trace, nullptr, canvas, 1.5);
    EXPECT_EQ(canvas.size(), size);
  }
  drawDetection(cv::Mat(40, 40, CV_32FC3), trace, nullptr, canvas);
  EXPECT_EQ(canvas.size(), cv::Size(2000, 1500)) << "left as it was";
}

}  // namespace window_ingress::detection::debug_image_test
