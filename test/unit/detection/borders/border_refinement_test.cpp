#include "window_ingress/detection/border_refinement.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "drawn_window.hpp"

namespace window_ingress::detection::border_refinement_test {

geometry::Quadrilateral jittered(const geometry::Quadrilateral& quad, std::mt19937& random, double by_px) {
  std::uniform_real_distribution<double> uniform(-by_px, by_px);
  geometry::Quadrilateral result = quad;
  for (auto& p : result) p += Eigen::Vector2d(uniform(random), uniform(random));
  return result;
}

TEST(BorderRefinement, CornersOfAntialiasedWindowsToATenthOfAPixel) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  double squares = 0.0, bias = 0.0;
  const int trials = 60;
  for (int i = 0; i < trials; ++i) {
    test::DrawnWindow drawn;
    drawn.width = 320, drawn.height = 240, drawn.type = i % 2 ? CV_8UC1 : CV_8UC3, drawn.seed = i;
    const double x = 60 + 10 * uniform(random), y = 50 + 10 * uniform(random);
    drawn.opening =
        test::turned(test::rectangle(x, y, x + 60 + 100 * uniform(random), y + 50 + 80 * uniform(random)),
                     0.5 * (uniform(random) - 0.5), 0.3 * (uniform(random) - 0.5));
    const auto borders = refineBorders(drawn.draw(), {jittered(drawn.opening, random, 1.5), 3.0}, nullptr);
    ASSERT_TRUE(borders) << i;
    EXPECT_LT(test::worstCorner(borders->corners, drawn.opening), 0.15) << i;
    for (int k = 0; k < 4; ++k) squares += (borders->corners[k] - drawn.opening[k]).squaredNorm() / 8.0;
    bias +=
        std::sqrt(geometry::signedArea(borders->corners)) - std::sqrt(geometry::signedArea(drawn.opening));
  }
  EXPECT_LT(std::sqrt(squares / trials), 0.04) << "RMS a coordinate [px]";
  EXPECT_LT(std::abs(bias / trials), 0.03) << "outward bias [px]";
}

TEST(BorderRefinement, TellsItsOwnErrorWithinAFactor) {
  std::mt19937 random(5);
  for (double noise : {2.0, 8.0, 16.0}) {
    double mahalanobis = 0.0;
    const int trials = 30;
    for (int i = 0; i < trials; ++i) {
      test::DrawnWindow drawn;
      drawn.width = 200, drawn.height = 160, drawn.noise = noise, drawn.seed = 100 + i;
      drawn.opening = test::turned(test::rectangle(50.3, 40.2, 150.1, 120.4), 0.05 + 0.01 * i, 0.1);
      const auto borders = refineBorders(drawn.draw(), {jittered(drawn.opening, random, 1.0), 3.0}, nullptr);
      ASSERT_TRUE(borders);
      for (int k = 0; k < 4; ++k) {
        const Eigen::Vector2d error = borders->corners[k] - drawn.opening[k];
        mahalanobis += error.dot(borders->corner_covariance[k].inverse() * error) / 8.0;
      }
    }
    EXPECT_LT(mahalanobis / trials, 4.0) << "noise " << noise;
    EXPECT_GT(mahalanobis / trials, 0.02) << "noise " << noise;
  }
}

TEST(BorderRefinement, BordersAreStraightInTheUndistortedImage) {
  geometry::PinholeCamera camera = geometry::PinholeCamera::fromFieldOfView(640, 480, 1.4);
  camera.distortion = {-0.25, 0.06, 0.0, 0.0, 0.0};
  const auto ideal = test::rectangle(120, 90, 500, 380);
  cv::Mat image(480, 640, CV_8UC1, cv::Scalar(170));
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) {
      int inside = 0;
      for (int k = 0; k < 16; ++k)
        inside += geometry::contains(
            ideal, camera.undistort({x - 0.375 + 0.25 * (k % 4), y - 0.375 + 0.25 * (k / 4)}));
      image.at<uchar>(y, x) = cv::saturate_cast<uchar>(170 - 110.0 * inside / 16);
    }
  geometry::Quadrilateral truth;
  for (int i = 0; i < 4; ++i) truth[i] = camera.distort(ideal[i]);
  const auto with = refineBorders(image, {truth, 3.0}, &camera);
  ASSERT_TRUE(with);
  EXPECT_LT(test::worstCorner(with->corners, truth), 0.1);
  const auto without = refineBorders(image, {truth, 3.0}, nullptr);
  EXPECT_TRUE(!without || test::worstCorner(without->corners, truth) > 0.5);
}

TEST(BorderRefinement, ColoursOfEqualBrightnessDo) {
  cv::Mat image(200, 260, CV_8UC3, cv::Scalar(180, 100, 60));
  const auto quad = test::turned(test::rectangle(60, 50, 180, 140), 0.1, 0.0);
  test::fillQuad(image, quad, cv::Scalar(60, 118, 90));
  const auto borders = refineBorders(image, {test::grown(quad, 1.0), 3.0}, nullptr);
  ASSERT_TRUE(borders);
  EXPECT_LT(test::worstCorner(borders->corners, quad), 0.1);
}

TEST(BorderRefinement, ASideThatCannotBeFittedStaysWhereItStartedIfAsked) {
  cv::Mat image(240, 320, CV_8UC1, cv::Scalar(170));
  const auto opening = test::rectangle(80, 60, 240, 180);
  test::fillQuad(image, opening, cv::Scalar(60));
  image.rowRange(165, 240).setTo(60);
  double inliers = 1.0;
  EXPECT_FALSE(refineBorders(image, {opening, 3.0}, nullptr, &inliers));
  EXPECT_LT(inliers, 0.45);
  BorderStart start{opening, 3.0};
  start.knowAll(0.7);
  const auto borders = refineBorders(image, start, nullptr);
  ASSERT_TRUE(borders);
  EXPECT_DOUBLE_EQ(borders->edges[geometry::kBottom].sigma_px, 0.7);
  EXPECT_LT(borders->edges[geometry::kTop].sigma_px, 0.1);
}

TEST(BorderRefinement, ASideThatWasLocatedTurnedIsFittedWhereItShows) {
  test::DrawnWindow drawn;
  drawn.opening = test::rectangle(100, 80, 230, 180);
  for (const double turned_px : {2.0, 3.5, 4.5}) {
    BorderStart start{drawn.opening, 2.5};
    start.knowAll(1.0);
    start.quad[0].y() += turned_px, start.quad[1].y() -= turned_px;
    const auto borders = refineBorders(drawn.draw(), start, nullptr);
    ASSERT_TRUE(borders);
    EXPECT_LT(test::worstCorner(borders->corners, drawn.opening), 0.15) << turned_px;
  }
}

/// A dark opening, and a start whose left side lies off its border.
struct KnownStart {
  KnownStart(double off_px, double sigma_px) {
    test::fillQuad(image, opening, cv::Scalar(60));
    start.quad[0].x() += off_px, start.quad[3].x() += off_px;
    start.knowAll(sigma_px);
  }
  std::optional<RefinedBorders> fit() const { return refineBorders(image, start, nullptr); }
  double left_px(const RefinedBorders& borders) const { return borders.corners[0].x() - opening[0].x(); }

  geometry::Quadrilateral opening = test::rectangle(80, 60, 240, 180);
  cv::Mat image = cv::Mat(240, 320, CV_8UC1, cv::Scalar(170));
  BorderStart start{opening, 3.0};
};

TEST(BorderRefinement, ABorderThatContradictsWhatIsKnownOfASideDoesNotMoveIt) {
  const KnownStart known(1.5, 0.2);
  const auto borders = known.fit();
  ASSERT_TRUE(borders);
  EXPECT_EQ(borders->seen, 4);
  EXPECT_NEAR(known.left_px(*borders), 1.5, 0.05);
  EXPECT_NEAR(borders->edges[geometry::kLeft].sigma_px, 0.2, 1e-9);
}

TEST(BorderRefinement, WhatIsKnownOfASideAndItsBorderAreAveragedByWhatEachKnows) {
  const auto apart = [](double sigma_px) {
    const KnownStart known(0.1, sigma_px);
    const auto borders = known.fit();
    EXPECT_TRUE(borders);
    EXPECT_LT(borders->edges[geometry::kLeft].sigma_px, sigma_px);
    return known.left_px(*borders);
  };
  EXPECT_NEAR(apart(1.0), 0.0, 0.03);
  EXPECT_NEAR(apart(0.03), 0.05, 0.02) << "as well known as a sharp border";
  EXPECT_GT(apart(0.01), 0.085);
}

TEST(BorderRefinement, AnUnknownSideMustShowItsBorder) {
  KnownStart known(0.0, 0.5);
  known.image.colRange(0, 100).setTo(60);
  EXPECT_TRUE(known.fit());
  known.start.known[geometry::kLeft] = {};
  EXPECT_FALSE(known.fit());
}

TEST(BorderRefinement, NothingFromPlainImagesTinyOrOutsideQuads) {
  const cv::Mat plain(100, 100, CV_8UC3, cv::Scalar::all(80));
  EXPECT_FALSE(refineBorders(plain, {test::rectangle(20, 20, 80, 80), 3.0}, nullptr));
  EXPECT_FALSE(refineBorders(plain, {test::rectangle(20, 20, 21, 21), 3.0}, nullptr));
  EXPECT_FALSE(refineBorders(plain, {test::rectangle(-500, -400, -300, -200), 3.0}, nullptr));
}

}  // namespace window_ingress::detection::border_refinement_test
