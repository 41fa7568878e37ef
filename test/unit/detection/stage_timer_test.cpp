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

double sum(const StageTimer& watch) {
  double total = 0.0;
  for (int i = 0; i < kStages; ++i) total += watch.milliseconds(static_cast<Stage>(i));
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
  StageTimer watch(slowClock);
  watch.begin();
  watch.done(Stage::kEdges);
  watch.done(Stage::kLines);
  watch.done(Stage::kEdges);
  EXPECT_NEAR(watch.milliseconds(Stage::kEdges), 2.0, 1e-9);
  EXPECT_NEAR(watch.milliseconds(Stage::kLines), 1.0, 1e-9);
  watch.begin();
  EXPECT_EQ(sum(watch), 0.0);
}

TEST(StageTimer, AWindowIsSearchedThenFollowed) {
  const cv::Mat image = windowImage();
  StageTimer watch(slowClock);
  WindowTracker tracker{DetectorParams{}};
  tracker.setWatch(&watch);
  TrackInput input;
  input.image = image;
  watch.begin();
  ASSERT_TRUE(tracker.update(input));
  for (const Stage stage : {Stage::kPreprocess, Stage::kEdges, Stage::kLines, Stage::kOutlines,
                            Stage::kCandidates, Stage::kReference, Stage::kBorders})
    EXPECT_GT(watch.milliseconds(stage), 0.0) << toString(stage);
  tracker.setParams(DetectorParams{});  // keeps the timer
  input.stamp_sec = 0.03;
  watch.begin();
  ASSERT_TRUE(tracker.update(input));
  EXPECT_GT(watch.milliseconds(Stage::kEdges), 0.0);
}

TEST(StageTimer, NobodyNeedsOne) {
  WindowDetector detector{DetectorParams{}};
  EXPECT_EQ(detector.watch(), nullptr);
  done(detector.watch(), Stage::kEdges);
  EXPECT_TRUE(detector.detect(windowImage(), 0.0));
}

}  // namespace window_ingress::detection::stage_timer_test
