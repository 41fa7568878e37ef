#include "window_ingress/detection/candidate_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "drawn_window.hpp"

namespace window_ingress::detection {
namespace {

test::WindowPicture framed(double scale = 1.0) {
  test::WindowPicture picture;
  picture.width = static_cast<int>(640 * scale), picture.height = static_cast<int>(480 * scale);
  picture.opening = test::rectangle(200.3 * scale, 150.2 * scale, 420.4 * scale, 330.1 * scale);
  picture.frame_px = 14.0 * scale;
  return picture;
}

bool holds(const std::vector<Rival>& rivals, const geometry::Quadrilateral& quad, double within_px) {
  return std::any_of(rivals.begin(), rivals.end(),
                     [&](const Rival& rival) { return test::worstCorner(rival.quad, quad) < within_px; });
}

TEST(CandidateSearch, OneSetOfParametersServesAllImageSizes) {
  CandidateSearch search{DetectorParams()};
  for (double scale : {0.5, 1.0, 2.0, 3.0}) {
    DetectionTrace trace;
    const auto picture = framed(scale);
    const auto rivals = search.run(picture.draw(), nullptr, trace);
    EXPECT_TRUE(holds(rivals, picture.opening, 3.0 * search.factor())) << "inner, scale " << scale;
    EXPECT_TRUE(holds(rivals, test::grown(picture.opening, picture.frame_px), 3.0 * search.factor()))
        << scale;
    EXPECT_FALSE(trace.budget_exceeded);
  }
}

TEST(CandidateSearch, BestFirstAndNoMoreThanAsked) {
  DetectorParams params;
  params.max_candidates = 3;
  DetectionTrace trace;
  const auto rivals = CandidateSearch(params).run(framed().draw(), nullptr, trace);
  ASSERT_EQ(rivals.size(), 3u);
  EXPECT_GE(rivals[0].rank(), rivals[1].rank());
  EXPECT_GE(rivals[1].rank(), rivals[2].rank());
  for (const CandidateTrace& candidate : trace.candidates) EXPECT_NE(candidate.reject, RejectReason::kNone);
}

TEST(CandidateSearch, AFineGratingStaysWithinItsBudget) {
  cv::Mat grating(480, 640, CV_8UC1);
  for (int y = 0; y < grating.rows; ++y)
    for (int x = 0; x < grating.cols; ++x) grating.at<uchar>(y, x) = (x / 8 + y / 8) % 2 ? 230 : 20;
  DetectionTrace trace;
  const auto rivals = CandidateSearch(DetectorParams()).run(grating, nullptr, trace);
  EXPECT_LE(static_cast<int>(rivals.size()), DetectorParams().max_candidates);
}

}  // namespace
}  // namespace window_ingress::detection
