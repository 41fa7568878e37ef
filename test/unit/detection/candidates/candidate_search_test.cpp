#include "detection/candidates/candidate_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <random>

#include "drawn_window.hpp"

namespace window_ingress::detection::candidate_search_test {

test::DrawnWindow framed(double scale = 1.0) {
  test::DrawnWindow drawn;
  drawn.width = static_cast<int>(640 * scale), drawn.height = static_cast<int>(480 * scale);
  drawn.opening = test::rectangle(200.3 * scale, 150.2 * scale, 420.4 * scale, 330.1 * scale);
  drawn.frame_px = 14.0 * scale;
  return drawn;
}

bool holds(const std::vector<ScoredCandidate>& candidates, const geometry::Quadrilateral& quad,
           double within_px) {
  return std::any_of(candidates.begin(), candidates.end(), [&](const ScoredCandidate& candidate) {
    return test::worstCorner(candidate.quad, quad) < within_px;
  });
}

TEST(CandidateSearch, OneSetOfParametersServesAllImageSizes) {
  CandidateSearch search{DetectorParams()};
  for (double scale : {0.5, 1.0, 2.0, 3.0}) {
    DetectionTrace trace;
    const auto drawn = framed(scale);
    const auto candidates = search.run(drawn.draw(), nullptr, trace);
    EXPECT_TRUE(holds(candidates, drawn.opening, 3.0 * search.factor())) << "inner, scale " << scale;
    EXPECT_TRUE(holds(candidates, test::grown(drawn.opening, drawn.frame_px), 3.0 * search.factor()))
        << scale;
    EXPECT_FALSE(trace.budget_exceeded);
  }
}

TEST(CandidateSearch, BestFirstAndNoMoreThanAsked) {
  DetectorParams params;
  params.max_candidates = 3;
  DetectionTrace trace;
  const auto candidates = CandidateSearch(params).run(framed().draw(), nullptr, trace);
  ASSERT_EQ(candidates.size(), 3u);
  EXPECT_GE(candidates[0].rank(), candidates[1].rank());
  EXPECT_GE(candidates[1].rank(), candidates[2].rank());
  EXPECT_TRUE(trace.budget_exceeded);
  for (const CandidateTrace& candidate : trace.candidates) {  // nobody has compared those beyond the limit
    EXPECT_NE(candidate.reject, RejectReason::kNone);
    EXPECT_NE(candidate.reject, RejectReason::kOutscored);
  }
}

TEST(CandidateSearch, AFineGratingStaysWithinItsBudget) {
  cv::Mat grating(480, 640, CV_8UC1);
  for (int y = 0; y < grating.rows; ++y)
    for (int x = 0; x < grating.cols; ++x) grating.at<uchar>(y, x) = (x / 8 + y / 8) % 2 ? 230 : 20;
  DetectionTrace trace;
  const auto candidates = CandidateSearch(DetectorParams()).run(grating, nullptr, trace);
  EXPECT_LE(static_cast<int>(candidates.size()), DetectorParams().max_candidates);
}

cv::Mat brightAndDarkPatches() {
  cv::Mat image(480, 640, CV_8UC3);
  std::mt19937 random(3);
  std::uniform_int_distribution<int> grey(60, 190), at(0, 640), size(6, 40);
  image.setTo(cv::Scalar::all(128));
  for (int n = 0; n < 1500; ++n)
    cv::rectangle(image, cv::Rect(at(random), at(random), size(random), size(random)),
                  cv::Scalar::all(grey(random)), cv::FILLED);
  return image;
}

// A ring that differs only in hue.
cv::Mat hueAmongPatches(const geometry::Quadrilateral& opening) {
  cv::Mat image = brightAndDarkPatches(), ring(image.size(), CV_8UC1, cv::Scalar(0));
  test::fillQuad(ring, test::grown(opening, 24.0), cv::Scalar(255));
  test::fillQuad(ring, opening, cv::Scalar(0));
  cv::add(image, cv::Scalar(-30, 0, 30), image, ring);
  return image;
}

TEST(CandidateSearch, ColoursAloneShowWhatIsLostAmongBrightAndDark) {
  const auto opening = test::rectangle(200, 150, 420, 330);
  const cv::Mat image = hueAmongPatches(opening);
  CandidateSearch search{DetectorParams()};
  DetectionTrace trace;
  const bool at_once = holds(search.run(image, nullptr, trace), opening, 6.0);
  EXPECT_FALSE(at_once) << "the image is too easy for this test";
  EXPECT_TRUE(holds(search.runOnColours({}, trace), opening, 6.0));
}

TEST(CandidateSearch, ABlobIsFoundWhereItsEdgesAreTooSoft) {
  const auto opening = test::rectangle(220, 160, 420, 320);
  cv::Mat image(480, 640, CV_8UC3, cv::Scalar::all(128)), hole(image.size(), CV_8UC1, cv::Scalar(0));
  test::fillQuad(hole, opening, cv::Scalar(255));
  cv::add(image, cv::Scalar(-30, 0, 30), image, hole);
  cv::GaussianBlur(image, image, cv::Size(), 8.0);
  test::addNoise(image, 2.0, 5);
  CandidateSearch search{DetectorParams()};
  DetectionTrace trace;
  EXPECT_TRUE(search.run(image, nullptr, trace).empty()) << "the image is too easy for this test";
  const auto& candidates = search.runOnColours({}, trace);
  ASSERT_TRUE(holds(candidates, opening, 12.0));
  EXPECT_EQ(candidates[0].found.source, CandidateSource::kBlob);
}

// A thin, blurred frame of one colour in front of bright and dark patches, in dim and uneven light.
cv::Mat thinPaintInPatchyLight(const geometry::Quadrilateral& opening, const cv::Scalar& paint) {
  cv::Mat image = brightAndDarkPatches(), ring(image.size(), CV_8UC1, cv::Scalar(0)), light, painted;
  test::fillQuad(ring, test::grown(opening, 5.0), cv::Scalar(255));
  test::fillQuad(ring, opening, cv::Scalar(0));
  image.convertTo(light, CV_32FC3, 1.0 / 255.0);
  cv::multiply(light, paint, painted, 1.0, CV_32FC3);
  painted.convertTo(painted, CV_8UC3);
  painted.copyTo(image, ring);
  cv::GaussianBlur(image, image, cv::Size(), 3.0);
  image.convertTo(image, CV_8UC3, 0.35);
  test::addNoise(image, 3.0, 5);
  return image;
}

TEST(CandidateSearch, AThinBlurredFrameIsFoundByItsPaintInAnyLight) {
  const auto opening = test::rectangle(240, 170, 380, 290);
  const cv::Mat image = thinPaintInPatchyLight(opening, cv::Scalar(100, 180, 245));
  CandidateSearch search{DetectorParams()};
  DetectionTrace trace;
  EXPECT_FALSE(holds(search.run(image, nullptr, trace), opening, 8.0))
      << "the image is too easy for this test";
  EXPECT_FALSE(holds(search.runOnColours({}, trace), opening, 8.0)) << "the image is too easy for this test";
  EXPECT_TRUE(holds(search.runOnColours(Eigen::Vector3f(-0.76F, 0.12F, 0.64F), trace), opening, 8.0));
  EXPECT_FALSE(holds(search.runOnColours(Eigen::Vector3f(-0.41F, 0.82F, -0.41F), trace), opening, 8.0))
      << "another paint";
}

TEST(CandidateSearch, AGreyImageHasNoColours) {
  cv::Mat grey;
  cv::cvtColor(framed().draw(), grey, cv::COLOR_BGR2GRAY);
  CandidateSearch search{DetectorParams()};
  DetectionTrace trace;
  EXPECT_FALSE(search.run(grey, nullptr, trace).empty());
  EXPECT_TRUE(search.runOnColours({}, trace).empty());
  EXPECT_TRUE(search.runOnColours(Eigen::Vector3f(-0.7F, 0.0F, 0.7F), trace).empty());
}

}  // namespace window_ingress::detection::candidate_search_test
