#include "detection/candidates/nested_quads.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "drawn_window.hpp"

namespace window_ingress::detection::nested_quads_test {

const auto kOpening = test::rectangle(100, 80, 220, 170);

cv::Mat framed() {
  test::DrawnWindow drawn;
  drawn.width = 320, drawn.height = 240, drawn.opening = kOpening, drawn.frame_px = 10;
  return drawn.draw();
}

std::vector<RejectReason> judge(const cv::Mat& image, const std::vector<geometry::Quadrilateral>& loops) {
  std::vector<ScoredCandidate> candidates(loops.size());
  for (std::size_t i = 0; i < loops.size(); ++i) candidates[i].quad = loops[i], candidates[i].score = 1.0;
  judgeNestedQuads(image, 2, candidates);
  std::vector<RejectReason> verdicts;
  for (const ScoredCandidate& candidate : candidates) verdicts.push_back(candidate.verdict);
  return verdicts;
}

TEST(NestedLoops, TheInnerBorderOfAFrameWins) {
  const auto verdicts = judge(framed(), {test::grown(kOpening, 10), kOpening});
  EXPECT_EQ(verdicts[0], RejectReason::kOuterBorder);
  EXPECT_EQ(verdicts[1], RejectReason::kNone);
}

TEST(NestedLoops, TheBackBorderOfTheRevealLoses) {
  cv::Mat image = framed();
  test::fillQuad(image, kOpening, cv::Scalar(120, 120, 125));
  test::fillQuad(image, test::grown(kOpening, -8), cv::Scalar(40, 40, 40));
  const auto verdicts = judge(image, {test::grown(kOpening, 10), kOpening, test::grown(kOpening, -8)});
  EXPECT_EQ(verdicts[0], RejectReason::kOuterBorder);
  EXPECT_EQ(verdicts[1], RejectReason::kNone);
  EXPECT_EQ(verdicts[2], RejectReason::kPane);
}

TEST(NestedLoops, WithoutAFrameTheFrontWinsOverTheBack) {
  cv::Mat image(240, 320, CV_8UC3, cv::Scalar(150, 165, 175));
  const auto back = test::rectangle(112, 84, 216, 164);
  test::fillQuad(image, kOpening, cv::Scalar(90, 95, 100));
  image(cv::Rect(100, 80, 60, 6)).setTo(cv::Scalar(200, 200, 210));
  image(cv::Rect(100, 164, 120, 6)).setTo(cv::Scalar(220, 220, 225));
  test::fillQuad(image, back, cv::Scalar(30, 30, 30));
  const auto verdicts = judge(image, {back, kOpening});
  EXPECT_EQ(verdicts[0], RejectReason::kPane);
  EXPECT_EQ(verdicts[1], RejectReason::kNone);
}

TEST(NestedLoops, PanesBetweenMullionsLose) {
  cv::Mat image = framed();
  const auto left = test::rectangle(100, 80, 156, 170), right = test::rectangle(164, 80, 220, 170);
  image(cv::Rect(156, 80, 8, 90)).setTo(cv::Scalar(50, 140, 215));
  const auto verdicts = judge(image, {left, right, kOpening});
  EXPECT_EQ(verdicts[0], RejectReason::kPane);
  EXPECT_EQ(verdicts[1], RejectReason::kPane);
  EXPECT_EQ(verdicts[2], RejectReason::kNone);
}

TEST(NestedLoops, LoopsApartDoNotMatterToEachOther) {
  const auto verdicts = judge(framed(), {kOpening, test::rectangle(10, 10, 60, 50)});
  EXPECT_EQ(verdicts[0], RejectReason::kNone);
  EXPECT_EQ(verdicts[1], RejectReason::kNone);
  EXPECT_TRUE(judge(framed(), {}).empty());
}

TEST(NestedLoops, AFrameIsABorderAllRound) {
  for (const auto& outer : {kOpening, test::rectangle(80, 80, 220, 170), test::rectangle(10, 10, 310, 230)}) {
    cv::Mat image(240, 320, CV_8UC3, cv::Scalar(150, 165, 175));
    test::fillQuad(image, kOpening, cv::Scalar(30, 30, 30));
    EXPECT_EQ(judge(image, {outer, kOpening})[0], RejectReason::kNone) << "no ring, one side only, too wide";
  }
}

}  // namespace window_ingress::detection::nested_quads_test
