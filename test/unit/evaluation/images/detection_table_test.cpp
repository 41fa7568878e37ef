#include "evaluation/images/detection_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "evaluation/csv.hpp"

namespace window_ingress::evaluation::detection_table_test {

TEST(DetectionTable, RowsHaveAsManyFieldsAsTheHeader) {
  const auto commas = [](const std::string& text) { return std::count(text.begin(), text.end(), ','); };
  DetectionRow row;
  row.reject_reason = "border";
  EXPECT_EQ(commas(detectionValues(row)), commas(detectionColumns()));
  row.window.emplace();
  for (auto& corner : row.window->corners) corner.setZero();
  row.window->has_appearance = true;
  row.pose.emplace();
  EXPECT_EQ(commas(detectionValues(row)), commas(detectionColumns()));
}

TEST(DetectionTable, CornersThatAreNotSeenStayEmpty) {
  DetectionRow row;
  row.window.emplace();
  for (auto& corner : row.window->corners) corner.setConstant(7.0);
  row.window->corner_visible[2] = false;
  EXPECT_EQ(detectionValues(row).substr(0, 55), "1,0.0000,,7.000,7.000,7.000,7.000,,,7.000,7.000,,,,,,,,");
}

TEST(DetectionTable, CandidatesAreListedByRankWithThePlaceThatTheSearchGaveThem) {
  detection::DetectionTrace trace;
  trace.candidates.resize(3);
  for (auto& candidate : trace.candidates)
    candidate.quad.fill(Eigen::Vector2d(1.0, 2.0)), candidate.reject = detection::RejectReason::kOutscored;
  trace.candidates[0].reject = detection::RejectReason::kAspect;  // stopped at a gate
  trace.candidates[1].score = 0.9, trace.candidates[1].proposal = 0.3;
  trace.candidates[2].score = 0.6, trace.candidates[2].proposal = 0.5;
  trace.candidates[2].reject = detection::RejectReason::kNone;  // the target
  const std::string rows = candidateRows("a.png", trace),
                    end = ",1.000,2.000,1.000,2.000,1.000,2.000,1.000,2.000\n";
  EXPECT_EQ(rows, "a.png,1,1,contour,none,0,0,0.6000," + end +           //
                      "a.png,2,2,contour,outscored,0,0,0.9000," + end +  //
                      "a.png,3,,contour,aspect,0,0,0.0000," + end);
  const auto commas = [](const std::string& text) { return std::count(text.begin(), text.end(), ','); };
  EXPECT_EQ(commas(rows), 3 * (1 + commas(candidateColumns())));
}

TEST(DetectionTable, FieldsWithCommasAreQuoted) {
  EXPECT_EQ(csvField("plain.png"), "plain.png");
  EXPECT_EQ(csvField("a,\"b\""), "\"a,\"\"b\"\"\"");
}

}  // namespace window_ingress::evaluation::detection_table_test
