#include "window_ingress/detection/window_tracker.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "drawn_window.hpp"

namespace window_ingress::detection {
namespace {

using geometry::Quadrilateral;
using test::WindowPicture;

constexpr double kPeriodSec = 1.0 / 30.0;

TrackInput inputOf(const cv::Mat& image, int frame) {
  TrackInput input;
  input.image = image;
  input.stamp_sec = 10.0 + kPeriodSec * frame;
  return input;
}

/// A window that drifts, turns and comes nearer.
WindowPicture movingWindow(int frame) {
  WindowPicture picture;
  const double grown = 60.0 + 0.8 * frame, x = 300.0 + 40.0 * std::sin(0.05 * frame),
               y = 230.0 + 15.0 * std::sin(0.08 * frame);
  picture.opening = test::turned(test::rectangle(x - 1.2 * grown, y - grown, x + 1.2 * grown, y + grown),
                                 0.05 * std::sin(0.1 * frame), 0.1);
  picture.frame_px = 0.12 * grown;
  picture.seed = 1 + frame;
  return picture;
}

TEST(WindowTracker, FollowsAMovingWindowToATenthOfAPixelUnderOneNumber) {
  WindowTracker tracker{DetectorParams()};
  int followed = 0;
  double squares = 0.0;
  const int frames = 120;
  for (int i = 0; i < frames; ++i) {
    const WindowPicture picture = movingWindow(i);
    const auto window = tracker.update(inputOf(picture.draw(), i));
    ASSERT_TRUE(window) << i << ": " << tracker.trace().detail;
    EXPECT_TRUE(tracker.tracking());
    EXPECT_TRUE(window->whole());
    EXPECT_EQ(window->target_id, 1u);
    EXPECT_LT(test::worstCorner(window->corners, picture.opening), 0.3) << i;
    for (int k = 0; k < 4; ++k)
      squares += (window->corners[k] - picture.opening[k]).squaredNorm() / (8.0 * frames);
    followed += tracker.trace().segments == 0;
  }
  EXPECT_GE(followed, frames - 2) << "of the frames need no search";
  EXPECT_LT(std::sqrt(squares), 0.05) << "RMS a coordinate [px]";
}

TEST(WindowTracker, ABadPictureIsRefusedAndForgets) {
  WindowTracker tracker{DetectorParams()};
  ASSERT_TRUE(tracker.update(inputOf(movingWindow(0).draw(), 0)));
  for (const cv::Mat& image : {cv::Mat(), cv::Mat(480, 640, CV_16UC1, cv::Scalar(9))}) {
    EXPECT_FALSE(tracker.update(inputOf(image, 1)));
    EXPECT_EQ(tracker.trace().outcome, RejectReason::kBadImage);
  }
  const auto window = tracker.update(inputOf(movingWindow(2).draw(), 2));
  ASSERT_TRUE(window);
  EXPECT_EQ(window->target_id, 2u);
}

}  // namespace
}  // namespace window_ingress::detection
