#include "evaluation/poses/pose_survey.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "window_ingress/estimation/window_pose_estimator.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::evaluation::pose_survey_test {

constexpr double kDegree = M_PI / 180.0;

Eigen::Isometry3d view(double distance_m, double yaw_rad) {
  return geometry::makePose(geometry::R_optical_flu() * geometry::yawRotation(yaw_rad), {0, 0, distance_m});
}

TEST(PoseBound, IsWhatWasPublished) {
  // For one pixel of noise a sample: distance, yaw [deg], bound [deg], lateral [m].
  const double rows[][4] = {{2, 10, 0.09, 0.003}, {4, 10, 0.35, 0.02}, {4, 30, 0.13, 0.007},
                            {6, 30, 0.25, 0.02},  {8, 10, 1.1, 0.15},  {8, 30, 0.38, 0.04}};
  const PoseSurveySetup setup;
  for (const auto& row : rows) {
    const auto bound = poseBound(setup.camera, view(row[0], row[1] * kDegree), setup.opening, 1.0).value();
    EXPECT_NEAR(bound.yaw_rad / kDegree, row[2], 0.06 * row[2]) << row[0] << " m, " << row[1] << " deg";
    EXPECT_NEAR(bound.lateral_m, row[3], 0.25 * row[3]) << row[0] << " m, " << row[1] << " deg";
  }
  // With 0.3 px, sigma_u is 0.2, 0.57, 1.2 degrees.
  for (const auto& [distance, sigma_u] : {std::pair(4.0, 0.2), std::pair(6.0, 0.57), std::pair(8.0, 1.2)})
    EXPECT_NEAR(poseBound(setup.camera, view(distance, 0.2), setup.opening, 0.3)->sigma_u_rad / kDegree,
                sigma_u, 0.15 * sigma_u);
}

TEST(PoseBound, ScalesWithTheNoiseAndNeedsAWindowInFront) {
  const PoseSurveySetup setup;
  const auto one = poseBound(setup.camera, view(4, 0.3), setup.opening, 1.0).value();
  const auto half = poseBound(setup.camera, view(4, 0.3), setup.opening, 0.5).value();
  EXPECT_NEAR(half.yaw_rad, 0.5 * one.yaw_rad, 1e-12);
  EXPECT_NEAR(half.lateral_m, 0.5 * one.lateral_m, 1e-12);
  EXPECT_GT(one.sigma_u_rad, one.yaw_rad);
  EXPECT_FALSE(poseBound(setup.camera, view(-1, 0.3), setup.opening, 1.0));
}

TEST(NoisyBorders, HaveTheSpreadsThatTheyState) {
  const PoseSurveySetup setup;
  const auto T = view(3, 0.4);
  const auto truth = geometry::projectOpening(setup.camera, T, setup.opening).value();
  std::mt19937 random(1);
  const int draws = 3000;
  double corner_squares = 0.0;
  for (int i = 0; i < draws; ++i) {
    const auto window = noisyBorders(setup.camera, T, setup.opening, 0.5, random).value();
    for (int k = 0; k < 4; ++k) {
      const Eigen::Vector2d off = window.corners[k] - truth[k];
      corner_squares += off.dot(window.corner_covariance[k].ldlt().solve(off)) / (4.0 * draws);
    }
    EXPECT_EQ(window.visibleSides(), 4);
  }
  EXPECT_NEAR(corner_squares, 2.0, 0.1);
  EXPECT_FALSE(noisyBorders(setup.camera, view(-1, 0), setup.opening, 0.5, random));
}

TEST(PeerMethods, AreExactWithoutNoiseAndRefuseWhatIsNoWindow) {
  const PoseSurveySetup setup;
  for (int method = kFirstPeer; method < kPoseMethods; ++method) {
    for (const double yaw : {-0.7, -0.1, 0.0, 0.3}) {
      const auto T = view(3, yaw);
      const auto corners = geometry::projectOpening(setup.camera, T, setup.opening).value();
      const auto found = poseByPeer(method, corners, setup.camera, setup.opening);
      ASSERT_TRUE(found) << nameOfMethod(method);
      EXPECT_TRUE(found->isApprox(T, 1e-3)) << nameOfMethod(method) << " " << yaw;
    }
    const geometry::Quadrilateral none{Eigen::Vector2d(1, 1), Eigen::Vector2d(1, 1), Eigen::Vector2d(1, 1),
                                       Eigen::Vector2d(NAN, 1)};
    const auto of_none = poseByPeer(method, none, setup.camera, setup.opening);
    EXPECT_TRUE(!of_none || of_none->matrix().allFinite()) << nameOfMethod(method);
  }
}

TEST(PoseSurvey, OursReachesTheBoundIsTheBestAndItsTrustIsDeserved) {
  const PoseSurveySetup setup;
  std::vector<PoseCellResult> results;
  std::uint32_t seed = 7;
  int trusted = 0, wrong = 0;
  for (const double noise : {0.05, 0.5})
    for (const double distance : {2.0, 5.0, 8.0})
      for (const double yaw_deg : {10.0, 25.0, 45.0}) {
        results.push_back(surveyCell(setup, {distance, yaw_deg * kDegree, noise}, 400, seed++));
        const PoseCellResult& r = results.back();
        ASSERT_EQ(r.draws, 400);
        trusted += r.trusted, wrong += r.trusted_wrong;
        if (!r.signIsDecidable()) continue;
        const double ours = r.methods[kOurs].yawRms();
        EXPECT_LT(ours, 1.15 * r.yaw_bound_rad) << distance << " m, " << yaw_deg << " deg";  // 400 draws
        EXPECT_LT(r.methods[kOurs].lateralRms(), 1.15 * r.lateral_bound_m);
        EXPECT_NEAR(r.yaw_consistency, 1.0, 0.3);
        for (int method = kFirstPeer; method < kPoseMethods; ++method)
          EXPECT_LT(ours, 1.02 * r.methods[method].yawRms()) << nameOfMethod(method);
      }
  EXPECT_GT(trusted, 6000);
  EXPECT_LE(wrong, 0.002 * trusted);
  EXPECT_NE(poseSurveySummary(results).find("best or equal (0.5 %) in"), std::string::npos);
}

TEST(PoseSurvey, TheSameSeedGivesTheSameRow) {
  const PoseSurveySetup setup;
  const PoseCell cell{4.0, 0.3, 0.2};
  const std::string row = poseSurveyRow(surveyCell(setup, cell, 20, 3));
  EXPECT_EQ(row, poseSurveyRow(surveyCell(setup, cell, 20, 3)));
  EXPECT_NE(row, poseSurveyRow(surveyCell(setup, cell, 20, 4)));
  const auto commas = [](const std::string& text) { return std::count(text.begin(), text.end(), ','); };
  EXPECT_EQ(commas(row), commas(poseSurveyColumns()));
}

TEST(PoseSurvey, ACellThatDoesNotFitIntoTheImageHasNoDraws) {
  EXPECT_EQ(surveyCell(PoseSurveySetup(), {0.5, 0.3, 0.2}, 5, 1).draws, 0);
}

}  // namespace window_ingress::evaluation::pose_survey_test
