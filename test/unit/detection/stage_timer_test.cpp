#include "window_ingress/detection/stage_timer.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "drawn_window.hpp"
#include "window_ingress/detection/window_detector.hpp"
#include "window_ingress/detection/window_tracker.hpp"

namespace window_ingress::detection::stage_timer_test {

// A clock that advances by a millisecond at each reading.
double slow_clock_sec = 0.0;
double slowClock() { return slow_clock_sec += 1e-3; }

double sum(const StageTimer& timer) {
  double total = 0.0;
  for (int i = 0; i < kStages; ++i) total += timer.milliseconds(static_cast<Stage>(i));
  return total;
}

cv::Mat windowImage() {
  test::DrawnWindow window;
  window.opening = {Eigen::Vector2d(220, 150), {420, 150}, {420, 310}, {220, 310}};
  window.frame_px = 14.0;
  return window.draw();
}

TEST(StageTimer, NamesAreDifferent) {
  std::set<std::string> names;
  for (int i = 0; i < kStages; ++i) names.insert(toString(static_cast<Stage>(i)));
  EXPECT_EQ(static_cast<int>(names.size()), kStages);
}

TEST(StageTimer, AddsUpAndBeginsAnew) {
  StageTimer timer(slowClock);
  timer.begin();
  timer.done(Stage::kEdges);
  timer.done(Stage::kLines);
  timer.done(Stage::kEdges);
  EXPECT_NEAR(timer.milliseconds(Stage::kEdges), 2.0, 1e-9);
  EXPECT_NEAR(timer.milliseconds(Stage::kLines), 1.0, 1e-9);
  timer.begin();
  EXPECT_EQ(sum(timer), 0.0);
}

TEST(StageTimer, AWindowIsSearchedThenFollowed) {
  const cv::Mat image = windowImage();
  StageTimer timer(slowClock);
  WindowTracker tracker{DetectorParams{}};
  tracker.setTimer(&timer);
  TrackInput input;
  input.image = image;
  timer.begin();
  ASSERT_TRUE(tracker.update(input));
  for (const Stage stage : {Stage::kPreprocess, Stage::kEdges, Stage::kLines, Stage::kOutlines,
                            Stage::kCandidates, Stage::kReference, Stage::kBorders})
    EXPECT_GT(timer.milliseconds(stage), 0.0) << toString(stage);
  tracker.setParams(DetectorParams{});  // keeps the timer
  input.stamp_sec = 0.03;
  timer.begin();
  ASSERT_TRUE(tracker.update(input));
  EXPECT_GT(timer.milliseconds(Stage::kEdges), 0.0);
}

TEST(StageTimer, NobodyNeedsOne) {
  WindowDetector detector{DetectorParams{}};
  EXPECT_EQ(detector.timer(), nullptr);
  done(detector.timer(), Stage::kEdges);
  EXPECT_TRUE(detector.detect(windowImage(), 0.0));
}

}  // namespace window_ingress::detection::stage_timer_test
