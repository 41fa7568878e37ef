// Preprocess, edges, closing, contours: the first half of the pipeline on drawn images.
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "detection/candidates/canny_edges.hpp"
#include "detection/candidates/contour_polygons.hpp"
#include "detection/candidates/preprocess.hpp"
#include "detection/candidates/side_support.hpp"
#include "drawn_window.hpp"

namespace window_ingress::detection::search_stages_test {

TEST(Preprocess, ReducesByPowersOfTwoUntilItFits) {
  for (const cv::Size size :
       {cv::Size(320, 240), cv::Size(640, 480), cv::Size(1280, 720), cv::Size(1920, 1080)}) {
    const SearchLevel level = preprocess(cv::Mat(size, CV_8UC3, cv::Scalar(1, 2, 3)), {});
    EXPECT_LE(level.image.cols, 480);
    EXPECT_GT(level.image.cols, 239);
    EXPECT_NEAR(level.image.cols * level.factor, size.width, level.factor);
  }
}

TEST(Preprocess, AStripIsNotReducedToNothing) {
  for (const cv::Size size : {cv::Size(8000, 16), cv::Size(16, 16000), cv::Size(5000, 40)}) {
    const cv::Mat level = preprocess(cv::Mat(size, CV_8UC3, cv::Scalar::all(1)), {}).image;
    EXPECT_GE(std::min(level.cols, level.rows), 16) << size;
  }
}

TEST(Preprocess, APixelOfTheLevelIsTheMeanOfThoseUnderIt) {
  cv::Mat image(480, 640, CV_8UC1, cv::Scalar(0));
  cv::circle(image, {200, 300}, 6, cv::Scalar(255), cv::FILLED);
  const SearchLevel level = preprocess(image, {});
  const cv::Moments m = cv::moments(level.image);
  const Eigen::Vector2d full = toFullImage({m.m10 / m.m00, m.m01 / m.m00}, level.factor);
  EXPECT_NEAR(full.x(), 200.0, 0.1);
  EXPECT_NEAR(full.y(), 300.0, 0.1);
}

TEST(Preprocess, EqualisationRaisesContrastAndTakesBothTypes) {
  PreprocessParams params;
  params.equalise = true;
  for (int type : {CV_8UC1, CV_8UC3}) {
    cv::Mat image(120, 160, type, cv::Scalar::all(100));
    image(cv::Rect(40, 30, 60, 50)).setTo(cv::Scalar::all(106));
    const SearchLevel level = preprocess(image, params);
    EXPECT_GT(cv::norm(level.image, cv::NORM_INF) - level.image.ptr<uchar>(2)[2], 6.5);
  }
}

TEST(CannyEdges, ThresholdsFollowTheContrastOfTheImage) {
  for (double contrast : {12.0, 40.0, 120.0}) {
    test::DrawnWindow drawn;
    drawn.opening = test::rectangle(200, 150, 420, 330);
    drawn.wall = cv::Scalar::all(60 + contrast);
    drawn.hole = cv::Scalar::all(60);
    drawn.noise = 1.0;
    const EdgeMap& map = cannyEdges(drawn.draw(), {});
    const int on_border = cv::countNonZero(map.edges(cv::Rect(197, 170, 7, 140)));
    EXPECT_GE(on_border, 130) << "contrast " << contrast;
  }
}

TEST(CannyEdges, SeesBordersThatDifferInColourOnly) {
  cv::Mat image(240, 320, CV_8UC3, cv::Scalar(200, 100, 50));
  test::fillQuad(image, test::rectangle(80, 60, 220, 170), cv::Scalar(60, 100, 190));
  EXPECT_GT(cv::countNonZero(cannyEdges(image, {}).edges), 400);
}

TEST(CloseGaps, ClosesGapsUpToTwiceItsRadius) {
  DilationParams params;
  params.radius = 0.01;
  cv::Mat edges(200, 200, CV_8UC1, cv::Scalar(0)), filled;
  cv::rectangle(edges, {50, 50}, {150, 150}, cv::Scalar(255));
  edges(cv::Rect(90, 50, 4, 1)).setTo(0);
  EXPECT_EQ(closeGaps(edges, params, filled), 2);
  cv::floodFill(filled, {100, 100}, cv::Scalar(255));
  EXPECT_EQ(filled.at<uchar>(0, 0), 0) << "the flood leaked through the gap";
}

Outlines outlinesOf(const cv::Mat& closed, int dilation_px = 0) {
  Outlines outlines;
  addOutlines(closed, dilation_px, {}, CandidateSource::kContour, outlines);
  return outlines;
}

TEST(ContourPolygons, TakesOffWhatTheClosingAdded) {
  cv::Mat edges(240, 320, CV_8UC1, cv::Scalar(0)), closed;
  const auto truth = test::rectangle(60, 50, 220, 170);
  cv::rectangle(edges, {60, 50}, {220, 170}, cv::Scalar(255));
  const auto outlines = outlinesOf(closed, closeGaps(edges, {}, closed));
  ASSERT_EQ(outlines.candidates.size(), 2u);
  for (const Candidate& candidate : outlines.candidates)
    EXPECT_LT(test::worstCorner(candidate.quad, truth), 1.1) << "inner and outer outline are the same edge";
}

TEST(BlobMasks, StandOutFromWhatSurroundsThemWhateverTheLight) {
  cv::Mat level(240, 320, CV_8UC1);
  for (int x = 0; x < level.cols; ++x) level.col(x).setTo(60 + x / 4);
  const cv::Rect above(40, 60, 30, 40), below(230, 100, 40, 30);
  level(above) += 30;
  level(below) -= 30;
  const auto masks = blobMasks(level, 0, 12.0);
  for (const auto& [mask, blob] : {std::pair(masks[0], above), std::pair(masks[1], below)}) {
    EXPECT_GT(cv::countNonZero(mask(blob)), 0.9 * blob.area());
    cv::Mat(mask, cv::Rect(blob.x - 2, blob.y - 2, blob.width + 4, blob.height + 4)).setTo(0);
    EXPECT_LT(cv::countNonZero(mask), 0.01 * mask.total());
  }
}

TEST(SideSupport, AnOutlineSupportsTheSidesItRunsAlong) {
  const auto quad = test::rectangle(50, 40, 150, 100);
  const std::vector<cv::Point> outline = {{50, 40}, {150, 40}, {150, 100}, {100, 100}, {100, 70}, {51, 70}};
  const auto sides = outlinedSides(quad, outline);
  EXPECT_GT(sides[0].fraction, 0.85) << "top";
  EXPECT_GT(sides[1].fraction, 0.85) << "right";
  EXPECT_NEAR(sides[2].fraction, 0.45, 0.08) << "half of the bottom";
  EXPECT_NEAR(sides[3].fraction, 0.45, 0.08) << "half of the left";
}

TEST(ContourPolygons, ACircleHasNoFourCorners) {
  cv::Mat edges(240, 320, CV_8UC1, cv::Scalar(0));
  cv::circle(edges, {160, 120}, 70, cv::Scalar(255));
  const auto result = outlinesOf(edges);
  EXPECT_TRUE(result.candidates.empty());
  ASSERT_FALSE(result.rejected.empty());
  EXPECT_EQ(result.rejected[0].reject, RejectReason::kCorners);
}

TEST(ContourPolygons, FourLinesRoundARoundedRectangle) {
  std::vector<cv::Point> hull = {{20, 10},  {100, 10}, {110, 20}, {110, 80},
                                 {100, 90}, {20, 90},  {10, 80},  {10, 20}};
  const auto quad = quadRoundHull(hull);
  ASSERT_TRUE(quad);
  EXPECT_LT(test::worstCorner(*quad, test::rectangle(10, 10, 110, 90)), 1e-9);
  EXPECT_FALSE(quadRoundHull({{0, 0}, {5, 0}, {0, 5}}));
}

TEST(ContourPolygons, SaysSoWhenThereAreTooMany) {
  cv::Mat dots(240, 320, CV_8UC1, cv::Scalar(0));
  for (int i = 0; i < 4800; ++i) dots.at<uchar>(4 * (i / 80) + 1, 4 * (i % 80) + 1) = 255;
  const auto result = outlinesOf(dots);
  EXPECT_EQ(result.contours, 4800);
  EXPECT_TRUE(result.budget_exceeded);
}

}  // namespace window_ingress::detection::search_stages_test
