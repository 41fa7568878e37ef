#include "window_ingress/detection/seen_windows.hpp"

#include <gtest/gtest.h>

#include "drawn_window.hpp"

namespace window_ingress::detection::seen_windows_test {

CandidateTrace candidate(double x, double y, double size, RejectReason reject, double score) {
  CandidateTrace trace;
  trace.quad = test::rectangle(x, y, x + size, y + size);
  trace.reject = reject;
  trace.score = score;
  return trace;
}

std::vector<SeenWindow> seen(const DetectionTrace& trace, const std::optional<WindowObservation>& target) {
  std::vector<SeenWindow> windows;
  windowsSeen(trace, target, windows);
  return windows;
}

TEST(WindowsSeen, AreTheTargetAndWhatIsAWindowByItsGeometryEachOnce) {
  WindowObservation target;
  target.corners = test::rectangle(10, 10, 60, 60);
  target.score = 0.9;
  DetectionTrace trace;
  trace.candidates = {candidate(10, 10, 50, RejectReason::kNone, 0.9),
                      candidate(7, 7, 56, RejectReason::kOutscored, 0.95),       // the target's outer border
                      candidate(100, 10, 50, RejectReason::kOutscored, 0.6),     // a neighbour
                      candidate(103, 13, 44, RejectReason::kAppearance, 0.7),    // the neighbour again
                      candidate(200, 10, 50, RejectReason::kAppearance, 0.8),    // a window of another colour
                      candidate(300, 10, 50, RejectReason::kLineSupport, 0.9)};  // no window
  const auto windows = seen(trace, target);
  ASSERT_EQ(windows.size(), 3u);
  EXPECT_TRUE(windows[0].is_target);
  EXPECT_EQ(windows[0].corners[0].x(), 10.0);
  EXPECT_EQ(windows[1].corners[0].x(), 100.0);
  EXPECT_TRUE(windows[1].may_be_target);
  EXPECT_FALSE(windows[1].is_target);
  EXPECT_EQ(windows[2].corners[0].x(), 200.0);
  EXPECT_FALSE(windows[2].may_be_target) << "its look speaks against it";
}

TEST(WindowsSeen, WithoutAWholeTargetAreTheOthersAndNeverMoreThanADozen) {
  WindowObservation partial;
  partial.corner_visible[2] = false;
  DetectionTrace trace;
  EXPECT_TRUE(seen(trace, partial).empty());
  for (int i = 0; i < 40; ++i)
    trace.candidates.push_back(candidate(60.0 * i, 0, 50, RejectReason::kOutscored, 0.01 * i));
  const auto windows = seen(trace, partial);
  ASSERT_EQ(windows.size(), 12u);
  for (std::size_t i = 1; i < windows.size(); ++i) EXPECT_GE(windows[i - 1].score, windows[i].score);
}

}  // namespace window_ingress::detection::seen_windows_test
