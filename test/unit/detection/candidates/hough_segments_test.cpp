#include "detection/candidates/hough_segments.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "detection/candidates/preprocess.hpp"
#include "detection/candidates/segment_quads.hpp"
#include "detection/candidates/side_support.hpp"
#include "drawn_window.hpp"

namespace window_ingress::detection::hough_segments_test {

/// Converts edges to segments as the search does.
std::vector<Segment> segmentsOf(const EdgeMap& map) {
  EdgeChains runs;
  HoughSegments lines{HoughSegmentsParams()};
  return lines.run(runs.run(map, nullptr), map.edges.size());
}

cv::Mat window(const geometry::Quadrilateral& opening, double noise = 1.0) {
  test::DrawnWindow drawn;
  drawn.width = 320, drawn.height = 240, drawn.type = CV_8UC1;
  drawn.opening = opening, drawn.noise = noise;
  return drawn.draw();
}

TEST(HoughSegments, FindsTheFourSidesOfAWindowFromAnyAngle) {
  for (double angle : {0.0, 0.1, 0.35, -0.6, 1.3}) {
    const auto opening = test::turned(test::rectangle(100, 70, 220, 170), angle, 0.1);
    const auto segments = segmentsOf(cannyEdges(window(opening), {}));
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector2d a = opening[i], along = (opening[(i + 1) % 4] - a).normalized();
      const double length = (opening[(i + 1) % 4] - a).norm();
      const bool found = std::any_of(segments.begin(), segments.end(), [&](const Segment& s) {
        const Eigen::Vector2d normal(along.y(), -along.x());
        return std::abs(normal.dot(s.a - a)) < 1.2 && std::abs(normal.dot(s.b - a)) < 1.2 &&
               s.length() > 0.8 * length;
      });
      EXPECT_TRUE(found) << "side " << i << " at angle " << angle;
    }
  }
}

TEST(HoughSegments, BrighterSideLiesOnTheRight) {
  cv::Mat image(100, 100, CV_8UC1, cv::Scalar(50));
  image(cv::Rect(50, 0, 50, 100)).setTo(200);
  const auto segments = segmentsOf(cannyEdges(image, {}));
  ASSERT_EQ(segments.size(), 1u);
  EXPECT_GT(segments[0].normal.x(), 0.99);
  EXPECT_LT(segments[0].b.y(), segments[0].a.y()) << "upwards, with the bright half on the right";
}

TEST(HoughSegments, TheTwoEdgesOfABarStayApart) {
  cv::Mat image(120, 160, CV_8UC1, cv::Scalar(60));
  image(cv::Rect(78, 0, 4, 120)).setTo(200);
  const auto segments = segmentsOf(cannyEdges(image, {}));
  ASSERT_EQ(segments.size(), 2u);
  EXPECT_LT(segments[0].normal.dot(segments[1].normal), -0.9);
}

TEST(HoughSegments, NoiseAndEmptyImagesGiveNoLongSegments) {
  EXPECT_TRUE(segmentsOf(cannyEdges(cv::Mat(64, 64, CV_8UC1, cv::Scalar(5)), {})).empty());
  cv::Mat noise(240, 320, CV_8UC1, cv::Scalar(128));
  test::addNoise(noise, 40.0, 3);
  for (const Segment& segment : segmentsOf(cannyEdges(noise, {}))) EXPECT_LT(segment.length(), 60.0);
}

TEST(HoughSegments, OnlyWhatLiesOnSegmentsIsKept) {
  cv::Mat image = window(test::rectangle(90, 60, 200, 170), 0.0);
  cv::circle(image, {270, 40}, 4, cv::Scalar(0), 1);
  const EdgeMap& map = cannyEdges(image, {});
  EdgeChains runs;
  HoughSegments lines{HoughSegmentsParams()};
  lines.run(runs.run(map, nullptr), map.edges.size());
  const cv::Mat kept = edgesOnSegments(runs, lines, map.edges.size());
  EXPECT_GT(cv::countNonZero(kept), 380);
  EXPECT_EQ(cv::countNonZero(kept & ~map.edges), 0) << "nothing is drawn";
  EXPECT_EQ(cv::countNonZero(kept(cv::Rect(260, 30, 20, 20))), 0) << "a small ring has no straight side";
}

TEST(HoughSegments, ABorderBentByALensIsStraightAfterIt) {
  auto camera = geometry::PinholeCamera::fromFieldOfView(640, 480, 1.4);
  camera.distortion = {-0.25, 0.06, 0.0, 0.0, 0.0};
  cv::Mat image(240, 320, CV_8UC1, cv::Scalar(200));
  const auto lens = lensOfLevel(&camera, {image, 2});
  for (int y = 0; y < 240; ++y)
    for (int x = 0; x < 320; ++x)
      if (lens->undistort(Eigen::Vector2d(x, y)).x() > 285.0) image.at<uchar>(y, x) = 50;
  EdgeChains runs;
  HoughSegments lines{HoughSegmentsParams()};
  const auto& segments = lines.run(runs.run(cannyEdges(image, {}), &*lens), image.size());
  ASSERT_FALSE(segments.empty());
  EXPECT_GT(segments[0].length(), 220.0);
  EXPECT_NEAR(segments[0].a.x(), 285.0, 1.0);
  EXPECT_NEAR(segments[0].b.x(), 285.0, 1.0);
}

TEST(HoughSegments, IsDeterministic) {
  const EdgeMap& map = cannyEdges(window(test::rectangle(90, 60, 200, 170), 4.0), {});
  const auto first = segmentsOf(map), second = segmentsOf(map);
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(first[i].a, second[i].a);
}

TEST(SegmentQuads, FindsAWindowWithGapsInItsBorder) {
  cv::Mat image = window(test::rectangle(90, 60, 230, 170), 0.0);
  image(cv::Rect(140, 55, 12, 12)).setTo(image.at<uchar>(5, 5));
  image(cv::Rect(84, 54, 12, 12)).setTo(image.at<uchar>(5, 5));
  const auto segments = segmentsOf(cannyEdges(image, {}));
  SegmentQuads quads{SegmentQuadsParams()};
  const auto result = quads.run(segments, 1000.0, SegmentQuads::kQuick);
  ASSERT_FALSE(result.candidates.empty());
  const bool found = std::any_of(result.candidates.begin(), result.candidates.end(), [](const Candidate& c) {
    return test::worstCorner(c.quad, test::rectangle(90, 60, 230, 170)) < 2.0;
  });
  EXPECT_TRUE(found);
}

TEST(SideSupport, FullOnTheWindowAndNoneBesideIt) {
  const auto opening = test::rectangle(100, 70, 220, 170);
  const EdgeMap& map = cannyEdges(window(opening), {});
  for (const SideSupport& side : measureSides(map, nullptr, opening)) {
    EXPECT_GT(side.fraction, 0.9);
    EXPECT_LT(side.overshoot, 0.1);
  }
  for (const SideSupport& side : measureSides(map, nullptr, test::rectangle(110, 80, 210, 160)))
    EXPECT_LT(side.fraction, 0.1);
}

TEST(SideSupport, ACellOfAGridOvershoots) {
  cv::Mat image(240, 320, CV_8UC1, cv::Scalar(220));
  for (int i = 0; i < 5; ++i) {
    cv::line(image, {60 + 40 * i, 30}, {60 + 40 * i, 190}, cv::Scalar(20), 2);
    cv::line(image, {60, 30 + 40 * i}, {220, 30 + 40 * i}, cv::Scalar(20), 2);
  }
  const auto cell = measureSides(cannyEdges(image, {}), nullptr, test::rectangle(102, 72, 138, 108));
  const auto grid = measureSides(cannyEdges(image, {}), nullptr, test::rectangle(58, 28, 222, 192));
  for (int i = 0; i < 4; ++i) EXPECT_GT(cell[i].overshoot, grid[i].overshoot + 0.2);
}

TEST(SideSupport, OutsideTheImageAndDegenerateSidesHaveNone) {
  const EdgeMap& map = cannyEdges(window(test::rectangle(100, 70, 220, 170)), {});
  for (const SideSupport& side : measureSides(map, nullptr, test::rectangle(-500, -400, 900, 800)))
    EXPECT_EQ(side.fraction, 0.0);
  for (const SideSupport& side : measureSides(map, nullptr, test::rectangle(5, 5, 5, 5)))
    EXPECT_EQ(side.fraction, 0.0);
}

}  // namespace window_ingress::detection::hough_segments_test
