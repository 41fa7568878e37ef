#include "evaluation/images/track_survey.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "evaluation/images/survey_flight.hpp"

namespace window_ingress::evaluation::track_survey_test {

using Eigen::Vector2d;
using geometry::Quadrilateral;

const auto kCamera = geometry::PinholeCamera::fromFieldOfView(640, 480, 1.2);

Quadrilateral box(double left, double top, double right, double bottom) {
  return {Vector2d(left, top), Vector2d(right, top), Vector2d(right, bottom), Vector2d(left, bottom)};
}

Quadrilateral grown(const Quadrilateral& quad, double by_px) {
  return box(quad[0].x() - by_px, quad[0].y() - by_px, quad[2].x() + by_px, quad[2].y() + by_px);
}

const Quadrilateral kInside = box(100, 80, 500, 400), kBeyond = box(-200, 80, 900, 400);

detection::WindowObservation whole(const Quadrilateral& quad) {
  detection::WindowObservation window;
  window.corners = quad;
  window.target_id = 1;
  return window;
}

// Upper and lower side of a window that extends beyond the image at both sides.
detection::WindowObservation twoSides(double shift_px) {
  detection::WindowObservation window;
  window.target_id = 1;
  window.corner_visible = {false, false, false, false};
  for (const int side : {0, 2}) {
    const double y = (side == 0 ? 80.0 : 400.0) + shift_px;
    window.edges[side].visible = true;
    window.edges[side].a = Vector2d(side == 0 ? 0.0 : 639.0, y);
    window.edges[side].b = Vector2d(side == 0 ? 639.0 : 0.0, y);
  }
  return window;
}

TrackResult judged(const Quadrilateral& truth, const std::optional<detection::WindowObservation>& window,
                   double plane_m = 2.0) {
  TrackResult result;
  result.seed = 4;
  result.plane_m = plane_m;
  result.truth.inner = truth;
  result.truth.outer = grown(truth, 12.0);
  result.truth.far = grown(truth, -30.0);
  result.window = window;
  judge(result, kCamera);
  return result;
}

TEST(TrackSurvey, SidesInViewAreThoseThatShow) {
  EXPECT_EQ(sidesInView(kInside, kCamera), 4);
  EXPECT_EQ(sidesInView(kBeyond, kCamera), 2);
  EXPECT_EQ(sidesInView(box(-200, -200, 900, 700), kCamera), 0);
  EXPECT_EQ(sidesInView(box(600, 80, 900, 400), kCamera), 1)
      << "40 px of the upper and the lower one are too few";
}

TEST(TrackSurvey, VerdictsOfWholeObservations) {
  EXPECT_EQ(judged(kInside, whole(kInside)).verdict, TrackVerdict::kWhole);
  EXPECT_EQ(judged(kInside, std::nullopt).verdict, TrackVerdict::kNothing);
  EXPECT_EQ(judged(kInside, whole(grown(kInside, 11.0))).verdict, TrackVerdict::kOuter);
  EXPECT_EQ(judged(kInside, whole(grown(kInside, -29.0))).verdict, TrackVerdict::kFar);
  const TrackResult wrong = judged(kInside, whole(box(100, 80, 520, 400)));
  EXPECT_EQ(wrong.verdict, TrackVerdict::kWrong);
  EXPECT_NEAR(wrong.error_px, 20.0, 1e-9);
}

TEST(TrackSurvey, VerdictsOfPartialObservationsAreThoseOfTheirSides) {
  const TrackResult right = judged(kBeyond, twoSides(1.5));
  EXPECT_EQ(right.verdict, TrackVerdict::kPartial);
  EXPECT_NEAR(right.error_px, 1.5, 1e-9);
  EXPECT_EQ(judged(kBeyond, twoSides(20.0)).verdict, TrackVerdict::kWrong);
}

TEST(TrackSurvey, SidesOfABentImageAreStraightOnceUnbent) {
  auto bent = kCamera;
  bent.distortion = {-0.25, 0.06, 0.0, 0.0, 0.0};
  Quadrilateral truth = kInside;
  detection::WindowObservation window;
  for (auto& corner : truth) corner = bent.distort(corner);
  window.edges[0].visible = true;
  window.edges[0].a = bent.distort({200.0, 80.0});
  window.edges[0].b = bent.distort({320.0, 80.0});
  EXPECT_NEAR(worstSideDistance(window, truth, bent), 0.0, 1e-4);
  window.edges[0].b = truth[0] + 0.5 * (truth[1] - truth[0]);
  EXPECT_GT(worstSideDistance(window, truth, bent), 1.0) << "the chord is not the side";
}

TEST(TrackSurvey, SummaryLeavesOutWhatCannotBeSeenButNotWhatIsWrong) {
  TrackSummary summary;
  const Quadrilateral out_of_view = box(-200, -200, 900, 700);
  summary.add(judged(kInside, whole(kInside), 4.0));
  summary.add(judged(kBeyond, twoSides(0.0), 1.0));
  summary.add(judged(out_of_view, std::nullopt, 0.5));
  EXPECT_EQ(summary.frames(3), 0);
  summary.add(judged(out_of_view, whole(kInside), 0.5));
  EXPECT_EQ(summary.count(0, TrackVerdict::kWhole), 1);
  EXPECT_EQ(summary.count(2, TrackVerdict::kPartial), 1);
  EXPECT_EQ(summary.count(3, TrackVerdict::kWrong), 1);
}

TEST(TrackSurvey, AnotherNumberIsASwapButNotInAnotherFlight) {
  TrackSummary summary;
  const auto add = [&](std::uint32_t seed, std::uint32_t number) {
    TrackResult result = judged(kInside, whole(kInside));
    result.seed = seed;
    result.window->target_id = number;
    summary.add(result);
  };
  add(1, 1), add(1, 1), add(2, 7), add(2, 7);
  EXPECT_NE(summary.markdown("x").find(" | 0 |\n"), std::string::npos);
  TrackResult lost = judged(kInside, std::nullopt);
  lost.seed = 2;
  summary.add(lost);
  add(2, 8);
  EXPECT_NE(summary.markdown("x").find(" | 1 |\n"), std::string::npos);
}

TEST(TrackSurvey, RowsHaveAllColumns) {
  const auto fields = [](const std::string& text) { return std::count(text.begin(), text.end(), ','); };
  EXPECT_EQ(fields(trackRow(judged(kInside, whole(kInside)))), fields(trackColumns()));
  EXPECT_EQ(fields(trackRow(judged(kInside, std::nullopt))), fields(trackColumns()));
  TrackSummary summary;
  summary.add(judged(kInside, whole(kInside)));
  const auto bars = [](const std::string& text) { return std::count(text.begin(), text.end(), '|'); };
  EXPECT_EQ(bars(summary.markdown("x")), 2 * bars(TrackSummary::markdownHeader())) << "four rows against two";
}

TEST(SurveyFlight, LeadsFromTheStartToItsEndBeforeTheOpening) {
  const FlightRange range;
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const SurveyFlight flight(range, seed);
    const Eigen::Vector3d start = flight.T_window_camera(0.0).translation();
    EXPECT_GT(start.head<2>().norm(), range.nearest_start_m - 0.1);
    EXPECT_LT(start.head<2>().norm(), range.farthest_start_m + 0.1);
    const Eigen::Vector3d end = flight.T_window_camera(flight.durationSec()).translation();
    EXPECT_NEAR(end.x(), -range.end_m, 1e-9);
    EXPECT_LT(end.tail<2>().cwiseAbs().maxCoeff(), 0.06) << "within the opening";
  }
}

TEST(SurveyFlight, MotionIsTheDerivativeOfThePose) {
  const SurveyFlight flight(FlightRange(), 3);
  for (double time_sec = 0.0; time_sec < flight.durationSec(); time_sec += 0.3) {
    const auto motion = flight.motion(time_sec);
    const Eigen::Isometry3d foretold = motion.T_camera_window(0.02).inverse();
    const Eigen::Isometry3d there = flight.T_window_camera(time_sec + 0.02);
    EXPECT_LT((foretold.translation() - there.translation()).norm(), 1e-3);
    EXPECT_LT(Eigen::AngleAxisd(Eigen::Matrix3d(foretold.linear().transpose() * there.linear())).angle(),
              2e-3);
    EXPECT_LT(motion.angular_velocity_camera_radps.norm(), 2.5) << "no wild turns";
  }
}

}  // namespace window_ingress::evaluation::track_survey_test
