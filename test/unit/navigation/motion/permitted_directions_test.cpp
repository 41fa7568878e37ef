#include "navigation/motion/permitted_directions.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "navigation/behaviours/behaviour.hpp"
#include "navigation/motion/stopping.hpp"
#include "navigation_samples.hpp"

namespace window_ingress::navigation::permitted_directions_test {

const Eigen::Vector3d kWish(0.5, 0.4, 0.2);
const Eigen::Vector3d kNothing = Eigen::Vector3d::Zero();

/// 3 m in front of the window, on its axis.
class PermittedDirections : public testing::Test {
 protected:
  NavigatorParams params_ = test::withoutGlass();
  MissionState mission_;
  Situation situation_;

  void SetUp() override {
    situation_.vehicle = test::vehicleAt({-3.0, 0.0, 1.5}, 0.0);
    situation_.target = test::targetAtOrigin(0.0);
  }
  Eigen::Vector3d permitted(State state) const {
    return permittedVelocity(kWish, state, situation_, mission_, params_);
  }
};

TEST_F(PermittedDirections, StatesThatDoNotMoveGetNothing) {
  for (const auto state : {State::kIdle, State::kHold, State::kPassed, State::kAborted}) {
    EXPECT_EQ(permitted(state), kNothing) << toString(state);
  }
}

TEST_F(PermittedDirections, NoStateMovesWithoutOdometry) {
  situation_.vehicle.reset();
  mission_.trusted = mission_.committed = situation_.target;
  for (std::size_t i = 0; i < kStateCount; ++i) EXPECT_EQ(permitted(static_cast<State>(i)), kNothing);
}

TEST_F(PermittedDirections, SearchAndAnAmbiguousWindowAllowOnlyHeight) {
  const Eigen::Vector3d climb(0.0, 0.0, 0.2);
  EXPECT_EQ(permitted(State::kSearch), climb);
  situation_.target->sign_trusted = false;
  EXPECT_EQ(permitted(State::kAlign), climb);
  EXPECT_EQ(permitted(State::kApproach), climb);
  situation_.target.reset();
  EXPECT_EQ(permitted(State::kAlign), climb);
  EXPECT_EQ(permitted(State::kApproach), climb);
}

TEST_F(PermittedDirections, AlignGoesSidewaysAndBackButNeverForward) {
  EXPECT_TRUE(permitted(State::kAlign).isApprox(Eigen::Vector3d(0.0, 0.4, 0.2)));
  EXPECT_EQ(permittedVelocity(-kWish, State::kAlign, situation_, mission_, params_), -kWish);
}

TEST_F(PermittedDirections, ApproachGoesForwardOnlyWithinTheFunnel) {
  EXPECT_EQ(permitted(State::kApproach), kWish);
  situation_.vehicle = test::vehicleAt({-3.0, 3.5, 1.5}, 0.0);
  EXPECT_TRUE(permitted(State::kApproach).isApprox(Eigen::Vector3d(0.0, 0.4, 0.2)));
}

TEST_F(PermittedDirections, NearTheWallOutsideTheFunnelOnlyAway) {
  situation_.vehicle = test::vehicleAt({-0.8, 1.5, 1.5}, 0.0);
  for (const auto state : {State::kAlign, State::kApproach}) {
    EXPECT_EQ(permitted(state), kNothing);
    const Eigen::Vector3d away = permittedVelocity(-kWish, state, situation_, mission_, params_);
    EXPECT_TRUE(away.isApprox(Eigen::Vector3d(-0.5, 0.0, 0.0))) << away.transpose();
  }
}

TEST_F(PermittedDirections, APlaceIsGoneBackToSlowlyAndNotTowardsAWindow) {
  const auto position = situation_.vehicle->T_odom_base.translation();
  for (const auto state : {State::kSearch, State::kHold, State::kPassed}) {
    mission_ = MissionState();
    mission_.place_odom_m = position + Eigen::Vector3d(0.0, 0.5, 0.0);
    const Eigen::Vector3d sideways = permitted(state);
    EXPECT_NEAR(sideways.y(), std::min(kWish.y(), params_.hold.speed_mps), 1e-12) << toString(state);
    EXPECT_NEAR(sideways.x(), 0.0, 1e-12);
    mission_.place_odom_m = position - Eigen::Vector3d(0.0, 0.5, 0.0);
    EXPECT_EQ(permitted(state).head<2>().norm(), 0.0) << "it leads away from the place";
    mission_.place_odom_m = position + Eigen::Vector3d(0.5, 0.5, 0.0);
    mission_.trusted = situation_.target;
    EXPECT_LE(permitted(state).x(), 1e-12) << "it leads towards a window";
    EXPECT_GT(permitted(state).y(), 0.1);
  }
  mission_.place_odom_m = position + Eigen::Vector3d(0.0, 0.5, 0.0);
  EXPECT_EQ(permitted(State::kAborted), kNothing);
}

TEST_F(PermittedDirections, APlaceFarBelowIsGoneBackToSidewaysAllTheSame) {
  mission_.place_odom_m = situation_.vehicle->T_odom_base.translation() + Eigen::Vector3d(0.0, 0.5, -1.2);
  EXPECT_TRUE(permitted(State::kSearch).isApprox(Eigen::Vector3d(0.0, kWish.y(), kWish.z())));
  EXPECT_TRUE(permitted(State::kHold).isApprox(Eigen::Vector3d(0.0, kWish.y(), 0.0)));
}

TEST_F(PermittedDirections, NobodyCommitsByAnOdometryThatDisagreesWithItself) {
  situation_.vehicle = test::vehicleAt({-1.5, 0.0, 1.5}, 0.0);
  for (const double disagreement_mps : {0.0, 0.3, 0.4, 2.0}) {
    situation_.odometry.disagreement_mps = disagreement_mps;
    const CommitCriterion criterion = criterionWith(*situation_.target, situation_, mission_, params_);
    EXPECT_EQ(criterion.holds, disagreement_mps < 0.35) << disagreement_mps;
    EXPECT_EQ(criterion.unmet.find("odometry") != std::string::npos, !criterion.holds) << criterion.unmet;
  }
}

TEST_F(PermittedDirections, NobodyCommitsByAVelocityThatIsOffUntilItIsKnownToBeSteady) {
  situation_.vehicle = test::vehicleAt({-1.5, 0.0, 1.5}, 0.0);
  for (const bool is_known : {false, true}) {
    for (const double unexplained_mps : {0.0, 0.05, 0.1}) {
      situation_.odometry.is_bias_known = is_known;
      situation_.odometry.unexplained_mps = unexplained_mps;
      const CommitCriterion criterion = criterionWith(*situation_.target, situation_, mission_, params_);
      EXPECT_EQ(criterion.holds, is_known || unexplained_mps < 0.08) << unexplained_mps;
      EXPECT_EQ(criterion.unmet.find("constant bias") != std::string::npos, !criterion.holds)
          << criterion.unmet;
    }
  }
}

TEST_F(PermittedDirections, TheFenceLeavesRoomToStop) {
  mission_.committed = situation_.target;
  mission_.home_odom_m = situation_.vehicle->T_odom_base.translation();
  EXPECT_EQ(permitted(State::kCommit), kWish);
  for (double left_m = 0.5; left_m > -0.5; left_m -= 0.1) {
    mission_.home_odom_m = situation_.vehicle->T_odom_base.translation() -
                           Eigen::Vector3d(params_.limits.fence_radius_m - left_m, 0.0, 0.0);
    const double outward = permitted(State::kCommit).x();
    EXPECT_LE(stoppingDistance(outward, params_.vehicle), std::max(0.0, left_m) + 1e-9);
    EXPECT_NEAR(permitted(State::kCommit).y(), kWish.y(), 1e-12);
    EXPECT_EQ(permittedVelocity(-kWish, State::kCommit, situation_, mission_, params_).x(), -kWish.x());
  }
}

TEST_F(PermittedDirections, CommitAndBackOffNeedWhatTheyFlyBy) {
  EXPECT_EQ(permitted(State::kCommit), kNothing);
  EXPECT_EQ(permitted(State::kBackOff), kNothing);
  mission_.committed = mission_.trusted = situation_.target;
  EXPECT_EQ(permitted(State::kCommit), kWish);
  EXPECT_TRUE(permitted(State::kBackOff).isApprox(Eigen::Vector3d(0.0, 0.4, 0.2)));
}

TEST_F(PermittedDirections, ApproachHeedsWhatForbidsIt) {
  situation_.target->approach_forbidden = "fit NO_GO";
  EXPECT_TRUE(permitted(State::kApproach).isApprox(Eigen::Vector3d(0.0, 0.4, 0.2)));
}

TEST_F(PermittedDirections, AtTheCommitLineOnlyByTheContract) {
  for (const double y_m : {0.0, 0.33}) {
    situation_.vehicle = test::vehicleAt({-1.0, y_m, 1.5}, 0.0);
    const bool holds = criterionWith(*situation_.target, situation_, mission_, params_).holds;
    ASSERT_EQ(holds, y_m == 0.0);
    EXPECT_EQ(permitted(State::kApproach).x() > 0.0, holds);
  }
}

TEST_F(PermittedDirections, BehindTheCommitLineTheFunnelIsNotEnough) {
  situation_.vehicle = test::vehicleAt({-1.0, 0.0, 1.5}, 0.0, 0.5);  // heading off the normal
  const CommitCriterion criterion = criterionWith(*situation_.target, situation_, mission_, params_);
  ASSERT_TRUE(criterion.in_funnel && !criterion.holds);
  EXPECT_EQ(permitted(State::kApproach).x(), 0.0);
}

TEST_F(PermittedDirections, AWindowSeenFromBehindIsNotFlownAt) {
  situation_.target->T_odom_window.linear() = geometry::yawRotation(M_PI);
  for (const auto state : {State::kAlign, State::kApproach})
    for (const Eigen::Vector3d& wish : {kWish, Eigen::Vector3d(-kWish)})
      EXPECT_EQ(permittedVelocity(wish, state, situation_, mission_, params_).head<2>().norm(), 0.0);
}

TEST_F(PermittedDirections, WithinTheRevealBackOffLeadsOnlyAwayAndToTheAxis) {
  mission_.trusted = situation_.target;
  situation_.vehicle = test::vehicleAt({-0.1, -0.05, 1.55}, 0.0);
  EXPECT_TRUE(permitted(State::kBackOff).isApprox(Eigen::Vector3d(0.0, 0.4, 0.0)));
  const Eigen::Vector3d away = permittedVelocity(-kWish, State::kBackOff, situation_, mission_, params_);
  EXPECT_TRUE(away.isApprox(Eigen::Vector3d(-0.5, 0.0, -0.2))) << away.transpose();
}

TEST_F(PermittedDirections, NearTheWallNothingLeadsAwayFromTheAxis) {
  for (double angle = 0.0; angle < 6.28; angle += 0.05) {
    const Eigen::Vector3d offset(0.0, 0.5 * std::cos(angle), 0.4 * std::sin(angle));
    situation_.vehicle = test::vehicleAt(Eigen::Vector3d(-0.5, 0.0, 1.5) + offset, 0.0);
    for (double way = 0.0; way < 6.28; way += 0.1) {
      const Eigen::Vector3d wish(0.3, std::cos(way), std::sin(way));
      const auto velocity = permittedVelocity(wish, State::kApproach, situation_, mission_, params_);
      ASSERT_LE(velocity.x(), 1e-12);
      ASSERT_LE(velocity.y() * offset.y(), 1e-12);
      ASSERT_LE(velocity.z() * offset.z(), 1e-12);
    }
  }
}

TEST_F(PermittedDirections, HeightLimitsLeaveRoomToStop) {
  situation_.vehicle = test::vehicleAt({-3.0, 0.0, params_.limits.max_height_m - 0.02}, 0.0);
  EXPECT_LT(permitted(State::kSearch).z(), 0.1);
  situation_.vehicle = test::vehicleAt({-3.0, 0.0, params_.limits.max_height_m + 1.0}, 0.0);
  EXPECT_EQ(permitted(State::kSearch).z(), 0.0);
  situation_.vehicle = test::vehicleAt({-3.0, 0.0, params_.limits.min_height_m - 0.1}, 0.0);
  EXPECT_EQ(permittedVelocity(-kWish, State::kSearch, situation_, mission_, params_).z(), 0.0);
  EXPECT_EQ(permitted(State::kSearch).z(), 0.2);
}

TEST_F(PermittedDirections, NeverAddsSpeed) {
  mission_.committed = mission_.trusted = situation_.target;
  for (std::size_t i = 0; i < kStateCount; ++i) {
    for (double angle = 0.0; angle < 6.28; angle += 0.1) {
      const Eigen::Vector3d wish(std::cos(angle), std::sin(angle), std::cos(3 * angle));
      const auto velocity = permittedVelocity(wish, static_cast<State>(i), situation_, mission_, params_);
      EXPECT_LE(velocity.norm(), wish.norm() + 1e-12);
    }
  }
}

}  // namespace window_ingress::navigation::permitted_directions_test
