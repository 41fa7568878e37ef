#include "evaluation/images/detection_survey.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "evaluation/images/truth_comparison.hpp"

namespace window_ingress::evaluation::detection_survey_test {

using Eigen::Vector2d;
using geometry::Quadrilateral;

Quadrilateral box(double left, double top, double right, double bottom) {
  return {Vector2d(left, top), Vector2d(right, top), Vector2d(right, bottom), Vector2d(left, bottom)};
}

const Quadrilateral kInner = box(200, 100, 400, 260);

SurveyTruth truth() {
  SurveyTruth known;
  known.inner = kInner;
  known.outer = box(188, 88, 412, 272);
  known.far = box(220, 110, 385, 240);
  return known;
}

Quadrilateral withCornerMoved(double by_px) {
  Quadrilateral quad = kInner;
  quad[1].x() += by_px;
  return quad;
}

TEST(SurveyVerdict, EachBorderIsKnownByItsCorners) {
  EXPECT_EQ(judge(kInner, truth()), SurveyVerdict::kHit);
  EXPECT_EQ(judge(*truth().outer, truth()), SurveyVerdict::kOuterBorder);
  EXPECT_EQ(judge(truth().far, truth()), SurveyVerdict::kFarBorder);
  EXPECT_EQ(judge(box(20, 30, 120, 130), truth()), SurveyVerdict::kWrongTarget);
  EXPECT_EQ(judge(std::nullopt, truth()), SurveyVerdict::kMissed);
}

TEST(SurveyVerdict, HitUpToTheTolerance) {
  const double tolerance_px = hitTolerance(kInner);
  EXPECT_NEAR(tolerance_px, 0.02 * 180.0, 1e-9);
  EXPECT_EQ(judge(withCornerMoved(0.99 * tolerance_px), truth()), SurveyVerdict::kHit);
  EXPECT_EQ(judge(withCornerMoved(1.01 * tolerance_px), truth()), SurveyVerdict::kInexact);
  EXPECT_EQ(hitTolerance(box(0, 0, 40, 40)), 3.0) << "small windows";
}

TEST(SurveyVerdict, ThinFrameIsNoExcuseForItsOuterBorder) {
  SurveyTruth thin = truth();
  thin.outer = box(198, 98, 402, 262);
  EXPECT_EQ(judge(*thin.outer, thin), SurveyVerdict::kOuterBorder) << "though within the tolerance";
  thin.outer.reset();
  EXPECT_EQ(judge(box(198, 98, 402, 262), thin), SurveyVerdict::kHit) << "a hole has no outer border";
}

TEST(SurveyVerdict, WithoutTargetAnythingFoundIsFalse) {
  SurveyTruth none = truth();
  none.present = false;
  EXPECT_EQ(judge(kInner, none), SurveyVerdict::kFalseAlarm);
  EXPECT_EQ(judge(std::nullopt, none), SurveyVerdict::kNothing);
}

SurveyImage sampleAt(double distance_m) {
  SurveyImage sample;
  sample.scenario = "walls";
  sample.seed = 5;
  sample.distance_m = distance_m;
  sample.truth = truth();
  return sample;
}

detection::WindowObservation seen(const Quadrilateral& quad) {
  detection::WindowObservation window;
  window.corners = quad;
  return window;
}

TEST(SurveyResult, TellsWhatStoppedTheTrueCandidate) {
  detection::DetectionTrace trace;
  detection::CandidateTrace candidate;
  candidate.quad = withCornerMoved(10.0);
  candidate.reject = detection::RejectReason::kScore;
  trace.candidates.push_back(candidate);
  candidate.quad = box(20, 30, 120, 130);
  candidate.reject = detection::RejectReason::kAspect;
  trace.candidates.push_back(candidate);
  EXPECT_EQ(resultOf(sampleAt(4.0), std::nullopt, trace, 1.0).true_candidate, "score");
  trace.candidates.erase(trace.candidates.begin());
  EXPECT_EQ(resultOf(sampleAt(4.0), std::nullopt, trace, 1.0).true_candidate, "unseen");
}

TEST(SurveyResult, CandidatesThatAreNoQuadrilateralsAreNoTrouble) {
  detection::DetectionTrace trace;
  trace.candidates.resize(2);
  for (auto& corner : trace.candidates[0].quad) corner.setConstant(std::numeric_limits<double>::quiet_NaN());
  for (auto& corner : trace.candidates[1].quad) corner.setZero();
  EXPECT_EQ(resultOf(sampleAt(4.0), std::nullopt, trace, 1.0).true_candidate, "unseen");
}

TEST(SurveyResult, RowHasAllColumns) {
  const auto fields = [](const std::string& text) { return std::count(text.begin(), text.end(), ','); };
  const detection::DetectionTrace trace;
  for (const bool found : {true, false}) {
    const auto window = found ? std::make_optional(seen(kInner)) : std::nullopt;
    const std::string row = surveyRow(resultOf(sampleAt(4.0), window, trace, 1.0));
    EXPECT_EQ(fields(row), fields(surveyColumns())) << row;
  }
}

SurveyResult resultAt(double distance_m, const std::optional<Quadrilateral>& found, double ms = 1.0) {
  const auto window = found ? std::make_optional(seen(*found)) : std::nullopt;
  return resultOf(sampleAt(distance_m), window, {}, ms);
}

TEST(SurveySummary, CountsVerdictsAndMeasuresHitsOnly) {
  SurveySummary summary(kDefaultBins);
  summary.add(resultAt(2.5, withCornerMoved(1.0), 3.0));
  summary.add(resultAt(4.0, withCornerMoved(2.0), 1.0));
  summary.add(resultAt(4.0, *truth().outer, 2.0));
  summary.add(resultAt(7.0, std::nullopt, 9.0));
  EXPECT_EQ(summary.frames, 4);
  EXPECT_EQ(summary.count(SurveyVerdict::kHit), 2);
  EXPECT_EQ(summary.count(SurveyVerdict::kOuterBorder), 1);
  EXPECT_DOUBLE_EQ(summary.part(SurveyVerdict::kMissed), 0.25);
  EXPECT_DOUBLE_EQ(summary.innerPart(), 2.0 / 3.0);
  EXPECT_EQ(SurveySummary(kDefaultBins).innerPart(), 1.0) << "of nothing";
  EXPECT_EQ(summary.misses.at("unseen"), 1);
  EXPECT_EQ(summary.corners[0].frames(), 1);
  EXPECT_EQ(summary.corners[1].frames(), 1) << "the outer border does not count";
  EXPECT_EQ(summary.corners[2].frames(), 0);
  EXPECT_NEAR(summary.corners[1].rms().x(), 1.0, 1e-12) << "2 px in one corner of four";
  EXPECT_EQ(summary.milliseconds, (std::vector<double>{3.0, 1.0, 2.0, 9.0}));
}

TEST(SurveySummary, DistancesGoToTheNearestBin) {
  SurveySummary summary({{2.0, 2.0}, {4.0, 4.0}, {8.0, 8.0}});
  for (const double distance_m : {1.0, 2.9, 3.1, 9.0}) summary.add(resultAt(distance_m, kInner));
  EXPECT_EQ(summary.corners[0].frames(), 2);
  EXPECT_EQ(summary.corners[1].frames(), 1);
  EXPECT_EQ(summary.corners[2].frames(), 1);
}

TEST(SurveyTable, RowsOfTheTablesHaveTheirHeadersColumns) {
  SurveyTable table;
  table.add(resultAt(2.5, kInner));
  table.add(resultAt(4.5, std::nullopt));
  const auto count = [](const std::string& line, char c) { return std::count(line.begin(), line.end(), c); };
  const std::string csv = table.csv();
  const std::string header = csv.substr(0, csv.find('\n'));
  EXPECT_EQ(2 * count(header, ','), count(csv, ','));
  const std::string markdown = table.markdown();
  const std::string exact = markdown.substr(markdown.find("\n\n") + 2);
  EXPECT_EQ(count(markdown.substr(0, markdown.find("\n\n")), '|') % 3, 0);
  EXPECT_EQ(count(exact, '|'), 3 * count(exact.substr(0, exact.find('\n')), '|'));
}

}  // namespace window_ingress::evaluation::detection_survey_test
