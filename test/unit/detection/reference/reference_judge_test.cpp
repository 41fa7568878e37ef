#include "detection/reference/reference_judge.hpp"

#include <gtest/gtest.h>

#include "drawn_window.hpp"

namespace window_ingress::detection::reference_judge_test {

const geometry::Quadrilateral kOpening = test::rectangle(200, 150, 440, 350);

const cv::Scalar kWall(136, 152, 161), kOrange(16, 78, 185);

/// A judge that has learned an opening in a wall, with or without a frame, and sees it.
ReferenceJudge judgeOf(bool framed, const cv::Scalar& paint = kOrange) {
  cv::Mat image(480, 640, CV_8UC3, kWall);
  if (framed) test::fillQuad(image, test::rectangle(185, 135, 455, 365), paint);
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

TEST(ReferenceJudge, AFrameAloneTellsOnlyWhereItsColoursAreItsOwn) {
  EXPECT_TRUE(judgeOf(true).frameTells(0.5));
  EXPECT_FALSE(judgeOf(true).frameTells(0.2)) << "borders that are hardly the reference's";
  EXPECT_FALSE(judgeOf(true, 0.5 * kWall).frameTells(0.5)) << "darker than the wall, and of its colour";
  ReferenceJudge of_wall = judgeOf(false);
  EXPECT_FALSE(of_wall.frameTells(0.5));
  of_wall.see(cv::Mat(480, 640, CV_8UC1, cv::Scalar(90)), nullptr);
  EXPECT_TRUE(of_wall.frameTells(0.0)) << "nothing is compared";
}

// Another time of day changes a frame's contrasts. A frame in another paint correlates as well.
TEST(ReferenceJudge, CorrelationAloneDecidesWhereNoFramesColoursTell) {
  RingMatch match;
  match.correlation = 0.9, match.faithful = 0.6, match.faithful_uncovered = 0.8;
  const ReferenceJudge darker = judgeOf(true, 0.5 * kWall), painted = judgeOf(true);
  EXPECT_FALSE(darker.objectionTo(match, std::nullopt));
  EXPECT_EQ(darker.bordersNeeded(match), 0);
  EXPECT_TRUE(painted.objectionTo(match, std::nullopt));
  EXPECT_EQ(painted.bordersNeeded(match), 3);
  match.faithful = 0.8, match.faithful_uncovered = 0.95;
  EXPECT_FALSE(painted.objectionTo(match, std::nullopt));
  EXPECT_EQ(painted.bordersNeeded(match), 2);
  match.correlation = 0.6;
  EXPECT_EQ(judgeOf(false).bordersNeeded(match), 2);
  match.correlation = 0.7;
  EXPECT_EQ(judgeOf(false).bordersNeeded(match), 0);
}

// A taller window in the same frame, of which three sides are mistaken for the target's.
TEST(ReferenceJudge, AFrameThatGoesOnBeyondACornerIsAnother) {
  const ReferenceJudge judge = judgeOf(true);
  cv::Mat tall(480, 640, CV_8UC3, kWall), right = tall.clone();
  test::fillQuad(tall, test::rectangle(185, 65, 455, 365), kOrange);
  test::fillQuad(tall, test::rectangle(200, 80, 440, 350), cv::Scalar(70, 72, 70));
  test::fillQuad(right, test::rectangle(185, 135, 455, 365), kOrange);
  test::fillQuad(right, kOpening, cv::Scalar(70, 72, 70));
  const auto goesOn = [](ReferenceJudge judge, const cv::Mat& image) {
    judge.see(image, nullptr);
    return judge.frameGoesOn(kOpening);
  };
  EXPECT_FALSE(goesOn(judge, right));
  EXPECT_TRUE(goesOn(judge, tall));
  const cv::Mat fog = 0.15 * right + 0.85 * cv::Scalar::all(180);
  EXPECT_FALSE(goesOn(judge, fog)) << "where all colours are alike";
  EXPECT_FALSE(goesOn(judgeOf(false), tall)) << "a wall goes on";
}

TEST(ReferenceJudge, WhereSomethingStandsBeforeItMoreMustFit) {
  ReferenceJudge wall = judgeOf(false), frame = judgeOf(true);
  RingMatch match;
  match.correlation = 0.67, match.faithful = 0.76, match.faithful_uncovered = 0.87;
  EXPECT_FALSE(wall.objectionTo(match, std::nullopt));
  wall.setCovered(true);
  EXPECT_TRUE(wall.objectionTo(match, std::nullopt));
  match.faithful_uncovered = 0.95;
  EXPECT_FALSE(wall.objectionTo(match, std::nullopt));
  EXPECT_EQ(frame.bordersNeeded(match), 2);
  frame.setCovered(true);
  EXPECT_EQ(frame.bordersNeeded(match), 4) << "a poster has three";
}

// A blind in the colour of the wall is drawn, but for a slit at the left.
TEST(ReferenceJudge, AnOpeningShowsWhereItShowsInTheReference) {
  cv::Mat closed(480, 640, CV_8UC3, kWall), slit = closed.clone();
  test::fillQuad(slit, test::rectangle(200, 150, 220, 350), cv::Scalar(70, 72, 70));
  ReferenceJudge judge((DetectorParams()));
  judge.learn(std::make_shared<ReferenceAppearance>(slit, kOpening));
  EXPECT_TRUE(judge.showsOpening(kOpening));
  judge.see(closed, nullptr);
  EXPECT_FALSE(judge.showsOpening(kOpening));
  ReferenceJudge of_open = judgeOf(false);
  of_open.see(slit, nullptr);
  EXPECT_FALSE(of_open.showsOpening(kOpening)) << "one border of four";
}

}  // namespace window_ingress::detection::reference_judge_test
