#include "detection/reference/reference_judge.hpp"

#include <gtest/gtest.h>

#include "drawn_window.hpp"

namespace window_ingress::detection::reference_judge_test {

const geometry::Quadrilateral kOpening = test::rectangle(200, 150, 440, 350);

/// Has learned an opening in a wall with or without a frame.
ReferenceJudge judgeOf(bool framed) {
  cv::Mat image(480, 640, CV_8UC3, cv::Scalar(136, 152, 161));
  if (framed) test::fillQuad(image, test::rectangle(185, 135, 455, 365), cv::Scalar(16, 78, 185));
  test::fillQuad(image, kOpening, cv::Scalar(70, 72, 70));
  test::addNoise(image, 2.0, 3);
  ReferenceJudge judge((DetectorParams()));
  judge.learn(std::make_shared<ReferenceAppearance>(image, kOpening));
  return judge;
}

AppearanceMatch frameAt(double distance) {
  AppearanceMatch match;
  match.distance = distance, match.limit = 0.4;
  return match;
}

TEST(ReferenceJudge, AFrameInOtherColoursMustBeFaithfulWhereNothingCoversIt) {
  const ReferenceJudge judge = judgeOf(true);
  ASSERT_FALSE(judge.frameless());
  RingMatch match;
  match.correlation = 0.93, match.faithful = 0.78, match.faithful_uncovered = 0.85;
  EXPECT_FALSE(judge.objectionTo(match, frameAt(0.2)));
  EXPECT_TRUE(judge.objectionTo(match, frameAt(0.7)));
  EXPECT_TRUE(judge.objectionTo(match, std::nullopt)) << "colours that nobody could compare";
  match.faithful_uncovered = 0.9;
  EXPECT_FALSE(judge.objectionTo(match, frameAt(0.7))) << "another light";
}

TEST(ReferenceJudge, AWallWithoutAFrameIsNotExcusedByWhatIsCovered) {
  const ReferenceJudge judge = judgeOf(false);
  ASSERT_TRUE(judge.frameless());
  RingMatch match;
  match.correlation = 0.5, match.faithful = 0.4, match.faithful_uncovered = 0.95;
  EXPECT_TRUE(judge.objectionTo(match, std::nullopt));
  match.correlation = 0.7;
  EXPECT_FALSE(judge.objectionTo(match, std::nullopt));
}

}  // namespace window_ingress::detection::reference_judge_test
