#include "window_ingress/perception/window_perception.hpp"

#include <gtest/gtest.h>

#include "drawn_window.hpp"

namespace window_ingress::perception::window_perception_test {

constexpr int kFrames = 12;

// A framed window that grows from image to image, with a textured opening.
detection::TrackInput frameAt(int i) {
  test::DrawnWindow drawn;
  drawn.width = 320, drawn.height = 240, drawn.frame_px = 6.0, drawn.seed = 1 + i;
  drawn.opening = test::rectangle(100.0 - 0.5 * i, 70.0 - 0.5 * i, 210.0 + 0.5 * i, 160.0 + 0.5 * i);
  detection::TrackInput frame;
  frame.image = drawn.draw();
  for (int x = 115; x < 200; x += 12)
    for (int y = 80; y < 150; y += 12)
      cv::rectangle(frame.image, cv::Rect(x, y, 5, 5), cv::Scalar(120, 130, 90 + x % 40), cv::FILLED);
  frame.stamp_sec = 10.0 + i / 30.0;
  return frame;
}

cv::Mat bareWall() { return cv::Mat(240, 320, CV_8UC3, cv::Scalar(150, 165, 175)); }

std::vector<detection::WindowObservation> look(WindowPerception& perception) {
  std::vector<detection::WindowObservation> seen;
  for (int i = 0; i < kFrames; ++i)
    if (const auto& window = perception.update(frameAt(i))) seen.push_back(*window);
  return seen;
}

bool areTheSame(const detection::WindowObservation& a, const detection::WindowObservation& b) {
  return a.corners == b.corners && a.interior.points.size() == b.interior.points.size() &&
         a.stamp_sec == b.stamp_sec;
}

TEST(WindowPerception, FindsTheWindowAndFollowsWhatLiesInIt) {
  WindowPerception perception({}, {});
  const auto seen = look(perception);
  ASSERT_EQ(seen.size(), static_cast<std::size_t>(kFrames)) << perception.trace().detail;
  EXPECT_GT(seen.back().interior.points.size(), 10u);
  EXPECT_TRUE(perception.window());
  EXPECT_FALSE(perception.windows().empty());
}

TEST(WindowPerception, SaysWhyThereIsNoWindow) {
  WindowPerception perception({}, {});
  look(perception);
  detection::TrackInput frame = frameAt(kFrames);
  frame.image = bareWall();
  EXPECT_FALSE(perception.update(frame));
  EXPECT_FALSE(perception.window());
  EXPECT_FALSE(perception.trace().detail.empty());
}

TEST(WindowPerception, ForgetsAllThatItSaw) {
  WindowPerception perception({}, {}), fresh({}, {});
  look(perception);
  perception.reset();
  EXPECT_FALSE(perception.window());
  const auto again = look(perception), expected = look(fresh);
  ASSERT_EQ(again.size(), expected.size());
  for (std::size_t i = 0; i < again.size(); ++i) EXPECT_TRUE(areTheSame(again[i], expected[i])) << i;
}

}  // namespace window_ingress::perception::window_perception_test
