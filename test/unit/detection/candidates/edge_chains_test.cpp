#include "detection/candidates/edge_chains.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "drawn_window.hpp"

namespace window_ingress::detection::edge_chains_test {

const std::vector<EdgeChain>& runsOf(EdgeChains& runs, const cv::Mat& image) {
  return runs.run(cannyEdges(image, {}), nullptr);
}

TEST(EdgeChains, ARectangleHasFourLongRunsWithItsBrighterSideOnTheRight) {
  cv::Mat image(120, 160, CV_8UC1, cv::Scalar(40));
  image(cv::Rect(40, 30, 80, 60)).setTo(200);
  EdgeChains runs;
  int sides = 0;
  for (const EdgeChain& run : runsOf(runs, image)) {
    if ((run.b - run.a).norm() < 40.0) continue;
    ++sides;
    EXPECT_GT(run.normal.dot(Eigen::Vector2d(80, 60) - run.moments.mean()), 0.0);
    const Eigen::Vector2d along = (run.b - run.a).normalized();
    EXPECT_NEAR(Eigen::Vector2d(-along.y(), along.x()).dot(run.normal), 1.0, 1e-9);
    EXPECT_GT(run.contrast, 40.0);
  }
  EXPECT_EQ(sides, 4);
}

TEST(EdgeChains, EveryEdgePixelBelongsToOneRunAtMost) {
  cv::Mat image(120, 160, CV_8UC1, cv::Scalar(128));
  test::addNoise(image, 30.0, 2);
  EdgeChains runs;
  cv::Mat seen = cv::Mat::zeros(image.size(), CV_8UC1);
  for (const EdgeChain& run : runsOf(runs, image)) {
    ASSERT_EQ(run.count, static_cast<int>(run.moments.n));
    for (int k = run.first + 1; k + 1 < run.first + run.count; ++k) {  // parts of a chain share their ends
      const auto p = runs.pixels()[k];
      EXPECT_EQ(seen.at<uchar>(p.y, p.x)++, 0);
    }
  }
}

TEST(EdgeChains, ACircleIsCutIntoShortRuns) {
  cv::Mat image(200, 200, CV_8UC1, cv::Scalar(40));
  cv::circle(image, {100, 100}, 60, cv::Scalar(200), cv::FILLED);
  EdgeChains runs;
  const auto& found = runsOf(runs, image);
  EXPECT_GT(found.size(), 6u);
  for (const EdgeChain& run : found) EXPECT_LT((run.b - run.a).norm(), 60.0);
}

TEST(EdgeChains, EmptyAndTinyImagesHaveNone) {
  EdgeChains runs;
  for (const cv::Size& size : {cv::Size(1, 1), cv::Size(3, 2), cv::Size(64, 64)})
    EXPECT_TRUE(runsOf(runs, cv::Mat(size, CV_8UC1, cv::Scalar(9))).empty());
}

TEST(LineMoments, GiveTheLineOfLeastSquares) {
  LineMoments moments, halves;
  for (int half = 0; half < 2; ++half) {
    LineMoments part;
    for (int i = 0; i < 20; ++i) {
      const Eigen::Vector2d p(10.0 + 3.0 * (20 * half + i), 5.0 + 4.0 * (20 * half + i));
      moments.add(p);
      part.add(p);
    }
    halves.add(part);
  }
  EXPECT_NEAR(std::abs(moments.along().dot(Eigen::Vector2d(0.6, 0.8))), 1.0, 1e-12);
  EXPECT_NEAR((halves.mean() - moments.mean()).norm(), 0.0, 1e-9);
}

}  // namespace window_ingress::detection::edge_chains_test
