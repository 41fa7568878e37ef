#include "window_ingress/navigation/commit_criterion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "navigation/motion/stopping.hpp"
#include "navigation_samples.hpp"

namespace window_ingress::navigation::commit_criterion_test {

RelativeState at(double distance_m, double lateral_m = 0.0, double sigma_m = 0.01) {
  RelativeState relative;
  relative.position_window_m = {-distance_m, lateral_m, 0.0};
  relative.sigma_m.setConstant(sigma_m);
  return relative;
}

const geometry::OpeningSize kOpening{1.2, 1.0};

CommitCriterion criterionOf(const RelativeState& relative, const geometry::OpeningSize& opening = kOpening) {
  CommitCriterionInput input;
  input.relative = relative;
  input.opening = opening;
  return evaluateCommitCriterion(input, NavigatorParams());
}

TEST(CommitDistance, IsWhereTheOpeningOutgrowsTheView) {
  NavigatorParams params;
  params.vehicle.half_length_m = 0.05;
  params.commit.speed_mps = 0.3;  // so that the stopping distance does not matter
  params.commit.view_margin_m = 0.0;
  params.vehicle.camera.forward_m = 0.0;
  const double level = commitDistance(at(2.0), kOpening, 0.0, params);
  EXPECT_NEAR(level, 0.5 / std::tan(params.vehicle.camera.vertical_fov_rad / 2.0), 1e-12);
  EXPECT_NEAR(commitDistance(at(2.0), kOpening, 0.17, params),
              0.5 / std::tan(params.vehicle.camera.vertical_fov_rad / 2.0 - 0.17), 1e-12);
  EXPECT_GT(commitDistance(at(2.0, 0.3), kOpening, 0.0, params), level);
}

TEST(CommitDistance, LeavesRoomToStopBeforeTheOpening) {
  NavigatorParams params;
  params.commit.speed_mps = 2.0;
  const double stop = stoppingDistance(2.0, params.vehicle);
  EXPECT_DOUBLE_EQ(commitDistance(at(5.0), kOpening, 0.0, params), stop + params.vehicle.half_length_m);
}

TEST(CommitCriterion, HoldsOnTheAxisAndSaysWhyNotOffIt) {
  EXPECT_TRUE(criterionOf(at(1.2)).holds) << criterionOf(at(1.2)).unmet;
  EXPECT_NE(criterionOf(at(1.2, 0.3)).unmet.find("lateral offset"), std::string::npos);
  EXPECT_NE(criterionOf(at(1.2, 0.0, 0.1)).unmet.find("lateral miss"), std::string::npos);
  auto high = at(1.2);
  high.position_window_m.z() = 0.35;
  EXPECT_NE(criterionOf(high).unmet.find("vertical offset"), std::string::npos);
  auto turned = at(1.2);
  turned.heading_error_rad = -0.3;
  EXPECT_NE(criterionOf(turned).unmet.find("heading"), std::string::npos);
  auto drifting = at(1.2, -0.12);
  drifting.velocity_window_mps.y() = 0.4;
  EXPECT_NE(criterionOf(drifting).unmet.find("across"), std::string::npos);
}

TEST(CommitCriterion, FunnelWidensWithTheDistance) {
  for (double lateral = 0.05; lateral < 3.0; lateral += 0.05) {
    double before = std::numeric_limits<double>::infinity();
    for (double distance = 0.5; distance < 8.0; distance += 0.1) {
      const auto criterion = criterionOf(at(distance, lateral));
      EXPECT_GE(criterion.fullness, 0.0);
      EXPECT_EQ(criterion.in_funnel, criterion.fullness < 1.0);
      if (distance <= 2.5) continue;
      EXPECT_LE(criterion.fullness, before + 1e-9);
      before = criterion.fullness;
    }
  }
}

TEST(CommitCriterion, UnknownsNeverHold) {
  const double nan = std::nan("");
  EXPECT_FALSE(criterionOf(at(1.2, nan)).holds && criterionOf(at(1.2, nan)).in_funnel);
  EXPECT_FALSE(criterionOf(at(1.2, 0.0, nan)).in_funnel);
  EXPECT_FALSE(criterionOf(at(1.2), {0.4, 0.4}).holds);
  EXPECT_FALSE(criterionOf(at(1.2), {0.4, 0.4}).in_funnel);
}

TEST(CommitCriterion, SpreadsOfEstimateDriftAndGustsAddUpAsSquares) {
  const NavigatorParams params;
  CommitCriterionInput input;
  input.relative = at(0.8);
  input.opening = kOpening;
  const double blind_sec = 0.8 / params.commit.speed_mps;
  const double drift_m = params.vehicle.odom_drift_m_per_sqrt_sec * std::sqrt(blind_sec);
  EXPECT_NEAR(evaluateCommitCriterion(input, params).miss_m.x(), 3.0 * std::hypot(0.01, drift_m), 1e-12);

  input.drift_m_per_sqrt_sec = 0.05;
  EXPECT_NEAR(evaluateCommitCriterion(input, params).miss_m.x(),
              3.0 * std::hypot(0.01, 0.05 * std::sqrt(blind_sec)), 1e-12);
  input.drift_m_per_sqrt_sec = 0.0;

  input.gusts_mps.x() = 0.045;
  const double answered_sec = params.vehicle.response_sec + 1.0 / params.align.lateral_gain_hz;
  const double gust_m = 0.045 * 0.73 * answered_sec;
  const auto gusty = evaluateCommitCriterion(input, params);
  EXPECT_NEAR(gusty.miss_m.x(), 3.0 * std::hypot(0.01, drift_m, gust_m), 1e-12);
  EXPECT_NEAR(gusty.miss_m.y(), 3.0 * std::hypot(0.01, drift_m), 1e-12);
  input.gusts_mps.x() = 0.4;
  EXPECT_GT(evaluateCommitCriterion(input, params).miss_m.x(), 3.0 * 0.4 * answered_sec)
      << "calm does not hide what carries";
  CommitCriterionInput early = input;
  early.gusts_watched_sec = 3.0;
  EXPECT_GT(evaluateCommitCriterion(early, params).miss_m.x(),
            1.25 * evaluateCommitCriterion(input, params).miss_m.x())
      << "of few gusts the strongest was not among them";
  NavigatorParams late = params;
  late.vehicle.response_sec = 0.9;
  EXPECT_GT(evaluateCommitCriterion(input, late).miss_m.x(),
            1.5 * evaluateCommitCriterion(input, params).miss_m.x())
      << "what answers late is carried further";
  EXPECT_FALSE(evaluateCommitCriterion(input, params).holds);

  input.gusts_mps.x() = 0.0;
  input.unseen_sec = 4.0;
  EXPECT_NEAR(evaluateCommitCriterion(input, params).miss_m.x(),
              3.0 * std::hypot(0.01, params.vehicle.odom_drift_m_per_sqrt_sec * std::sqrt(blind_sec + 4.0)),
              1e-12);
}

// The vehicle drifts with this velocity error until it responds. Afterwards its position control has to
// counter the error permanently.
TEST(CommitCriterion, AVelocityThatIsOffIsAMiss) {
  const NavigatorParams params;
  CommitCriterionInput input;
  input.relative = at(0.8);
  input.opening = kOpening;
  const CommitCriterion before = evaluateCommitCriterion(input, params);
  input.odometry_mps = 0.05;
  EXPECT_EQ(evaluateCommitCriterion(input, params).miss_m.x(), before.miss_m.x()) << "as with any odometry";
  input.odometry_mps = 0.3;
  const double least_m = 0.2 * (params.vehicle.response_sec + 1.0 / params.align.lateral_gain_hz);
  EXPECT_GT(evaluateCommitCriterion(input, params).miss_m.x(), before.miss_m.x() + least_m);
  EXPECT_GT(evaluateCommitCriterion(input, params).miss_m.y(), before.miss_m.y() + least_m);
}

TEST(CommitCriterion, AnOffsetCountsTheLessTheFurtherTheVehicleCanSteerItAway) {
  double before = 10.0;
  for (double distance = 0.3; distance < 3.0; distance += 0.1) {
    const double miss_m = criterionOf(at(distance, 0.2, 0.0)).miss_m.x();
    EXPECT_LE(miss_m, before + 0.02) << distance;
    before = miss_m;
  }
  EXPECT_GT(criterionOf(at(0.3, 0.2, 0.0)).miss_m.x(), 0.2);
  EXPECT_GT(criterionOf(at(1.5, 0.2, 0.0)).miss_m.x(), 0.05);
}

TEST(CommitCriterion, SettlesOffTheAxisWhereTheVelocityDoesNotFollowWhatSteeringAsks) {
  const NavigatorParams params;
  const auto settledAt = [](double lateral_m, double across_mps) {
    RelativeState relative = at(1.6, lateral_m);
    relative.velocity_window_mps = {0.9, across_mps, 0.0};
    return criterionOf(relative).settled_m.x();
  };
  EXPECT_LT(settledAt(0.1, -0.1 * params.align.lateral_gain_hz), 0.06) << "steered onto the axis";
  EXPECT_GT(settledAt(0.05, 0.25), 0.2) << "carried off it";
  EXPECT_DOUBLE_EQ(settledAt(-0.05, -0.25), settledAt(0.05, 0.25));
  EXPECT_NEAR(settledAt(0.2, 0.0), 0.2, 1e-12) << "kept where it is";
}

TEST(CommitCriterion, DoesNotHoldWhileTheVehicleIsCarriedOffTheAxis) {
  RelativeState relative = at(2.2, 0.06);
  relative.velocity_window_mps = {0.9, 0.0, 0.0};
  EXPECT_TRUE(criterionOf(relative).holds);
  relative.velocity_window_mps.y() = 0.295;
  const CommitCriterion carried = criterionOf(relative);
  EXPECT_LT(carried.miss_m.maxCoeff(), carried.clearance_m.x());
  EXPECT_EQ(carried.unmet.find("carried off the axis"), 0u) << carried.unmet;
}

}  // namespace window_ingress::navigation::commit_criterion_test
