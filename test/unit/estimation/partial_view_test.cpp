/// Poses from what is left of a window near its plane: four, three or two borders and a prior pose.
#include <gtest/gtest.h>

#include <limits>

#include "estimation/planar/predicted_opening.hpp"
#include "pose_fixtures.hpp"

namespace window_ingress::estimation::partial_view_test {

using namespace fixtures;
using Vector6d = Eigen::Matrix<double, 6, 1>;

const double kNaN = std::numeric_limits<double>::quiet_NaN();

/// The stretches of the borders between `from` and `to` of their lengths, corners unseen.
detection::WindowObservation partly(const detection::WindowObservation& whole,
                                    const std::array<bool, 4>& seen, double from = 0.2, double to = 0.8) {
  auto window = whole;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector2d a = whole.corners[i], b = whole.corners[(i + 1) % 4];
    window.edges[i].visible = seen[i];
    window.edges[i].a = a + from * (b - a);
    window.edges[i].b = a + to * (b - a);
  }
  window.corner_visible.fill(false);
  window.corners.fill(Eigen::Vector2d::Zero());
  window.corner_covariance.fill(Eigen::Matrix2d::Zero());
  return window;
}

Vector6d spreadOf(double position_m, double angle_rad) {
  Vector6d spread;
  spread << Eigen::Vector3d::Constant(position_m), Eigen::Vector3d::Constant(angle_rad);
  return spread;
}

PosePrior disturbedPrior(const Eigen::Isometry3d& truth, const Vector6d& spread, std::mt19937& random) {
  std::normal_distribution<double> normal;
  Vector6d off;
  for (int i = 0; i < 6; ++i) off(i) = spread(i) * normal(random);
  return {moved(truth, off), spread.cwiseAbs2().asDiagonal()};
}

constexpr std::array<bool, 4> kAll{true, true, true, true}, kNoBottom{true, true, false, true},
    kSides{false, true, false, true}, kCorner{true, true, false, false}, kOne{true, false, false, false};

TEST(PartialView, FourBordersNeedNoPriorThoughNoCornerIsSeen) {
  const WindowPoseEstimator estimator{PoseParams{}};
  for (const auto& lens : {camera(), distortedCamera()}) {
    std::mt19937 random(1);
    const auto T = view(1.6, 0.3, 0.1, 0.1);
    const auto whole = bordersSeen(camera(), T, 1e-6, random);
    auto window = partly(whole, kAll);
    for (auto& edge : window.edges) {
      edge.a = lens.distort(edge.a);
      edge.b = lens.distort(edge.b);
    }
    const auto result = estimator.estimate(window, lens);
    ASSERT_TRUE(result.estimate) << result.detail;
    EXPECT_LT(angleBetween(result.estimate->best.T_camera_window.linear(), T.linear()), 1e-4);
    EXPECT_LT((result.estimate->best.T_camera_window.translation() - T.translation()).norm(), 1e-4);
    EXPECT_LT(result.estimate->best.reprojection_rms_px, 1e-3);
  }
}

TEST(PartialView, ThreeOrTwoBordersSharpenThePriorAndAreHonest) {
  const WindowPoseEstimator estimator{trustingParams()};
  for (const auto& seen : {kNoBottom, kSides, kCorner}) {
    std::mt19937 random(2);
    const auto T = view(1.4, 0.25, 0.1, -0.05);
    const Vector6d spread = spreadOf(0.05, 0.03);
    Vector6d squares = Vector6d::Zero();
    double prior_error = 0.0, error = 0.0, narrowest = 1.0;
    const int draws = 1000;
    for (int i = 0; i < draws; ++i) {
      PoseHints hints;
      hints.prior = disturbedPrior(T, spread, random);
      const auto window = partly(bordersSeen(camera(), T, 0.5, random), seen, 0.0, 1.0);
      const auto result = estimator.estimate(window, camera(), hints);
      ASSERT_TRUE(result.estimate) << result.detail;
      const auto& best = result.estimate->best;
      const Eigen::AngleAxisd turn(Eigen::Matrix3d(best.T_camera_window.linear() * T.linear().transpose()));
      Vector6d off;
      off << best.T_camera_window.translation() - T.translation(), turn.angle() * turn.axis();
      // Coordinate by coordinate: where two borders leave the rest to the prior, what is likely is a bent
      // sheet.
      squares += off.cwiseAbs2().cwiseQuotient(best.covariance.diagonal()) / draws;
      error += off.head<3>().squaredNorm();
      prior_error += (hints.prior->T_camera_window.translation() - T.translation()).squaredNorm();
      narrowest = std::min(narrowest, best.covariance(3, 3) / (spread(3) * spread(3)));
    }
    for (int k = 0; k < 6; ++k) EXPECT_NEAR(squares(k), 1.0, 0.25) << k;
    EXPECT_LT(error, 0.7 * prior_error);
    EXPECT_LT(narrowest, 0.9);
  }
}

TEST(PartialView, APriorThatKnowsTheSideDecidesIt) {
  const WindowPoseEstimator estimator{trustingParams()};
  std::mt19937 random(3);
  const auto T = view(1.5, 0.3);
  PoseHints hints;
  hints.prior = PosePrior{view(1.45, 0.28, 0.02, 0.01), spreadOf(0.1, 0.05).cwiseAbs2().asDiagonal()};
  const auto window = partly(bordersSeen(camera(), T, 0.3, random), kSides);
  const auto known = estimator.estimate(window, camera(), hints).estimate.value();
  EXPECT_NEAR(known.yaw_rad, 0.3, 3.0 * known.yaw_sigma_rad);
  EXPECT_GT(known.log_likelihood_ratio, 6.2);
  EXPECT_TRUE(known.sign_trusted);
}

TEST(PartialView, APriorOfAWholeViewIsCombinedWithIt) {
  const WindowPoseEstimator estimator{trustingParams()};
  std::mt19937 random(4);
  const auto T = view(5.0, 0.1);
  const auto window = bordersSeen(camera(), T, 0.5, random);
  PoseHints hints;
  hints.prior = PosePrior{T, spreadOf(0.02, 0.005).cwiseAbs2().asDiagonal()};
  const auto alone = estimator.estimate(window, camera()).estimate.value();
  const auto both = estimator.estimate(window, camera(), hints).estimate.value();
  EXPECT_LT(both.yaw_sigma_rad, 0.005);
  EXPECT_LT(both.yaw_sigma_rad, alone.yaw_sigma_rad);
}

TEST(PartialView, WithoutEnoughBordersThereIsAReason) {
  const WindowPoseEstimator estimator{PoseParams{}};
  std::mt19937 random(5);
  const auto T = view(1.5, 0.2);
  const auto whole = bordersSeen(camera(), T, 0.3, random);
  PoseHints hints;
  hints.prior = PosePrior{T, spreadOf(0.1, 0.05).cwiseAbs2().asDiagonal()};
  const auto alone = estimator.estimate(partly(whole, kNoBottom), camera());
  EXPECT_EQ(alone.reject, PoseReject::kBadCorners);
  EXPECT_EQ(alone.detail, "3 of 4 sides in view: bottom not seen; no pose from this image alone");
  const auto one = estimator.estimate(partly(whole, kOne), camera(), hints);
  EXPECT_EQ(one.reject, PoseReject::kBadCorners);
  EXPECT_NE(one.detail.find("too few even with a prior pose"), std::string::npos) << one.detail;
}

TEST(PartialView, BadBordersAndBadPriorsAreRefused) {
  const WindowPoseEstimator estimator{PoseParams{}};
  std::mt19937 random(6);
  const auto T = view(1.5, 0.2);
  const auto good = partly(bordersSeen(camera(), T, 0.3, random), kSides);
  PoseHints hints;
  hints.prior = PosePrior{T, spreadOf(0.1, 0.05).cwiseAbs2().asDiagonal()};
  ASSERT_TRUE(estimator.estimate(good, camera(), hints).estimate);
  for (const Eigen::Vector2d& end : {Eigen::Vector2d(kNaN, 0), Eigen::Vector2d(1e30, 5), good.edges[1].b}) {
    auto bad = good;
    bad.edges[1].a = end;
    EXPECT_EQ(estimator.estimate(bad, camera(), hints).reject, PoseReject::kBadCorners) << end.transpose();
  }
  auto rolled = hints;
  rolled.gravity = GravityPrior{{1.0, -0.2, 0.0}, 0.02};
  EXPECT_EQ(estimator.estimate(good, camera(), rolled).reject, PoseReject::kBadCorners);
  for (const double variance : {0.0, -1.0, kNaN}) {
    auto unusable = hints;
    unusable.prior->covariance.setConstant(variance);
    EXPECT_FALSE(estimator.estimate(good, camera(), unusable).estimate) << variance;
  }
}

TEST(PosePrior, ResidualSlopes) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int trial = 0; trial < 50; ++trial) {
    const auto T = view(3.0, unit(random));
    Matrix6d root = Matrix6d::Identity();
    for (int i = 0; i < 36; ++i) root(i / 6, i % 6) += 0.3 * unit(random);
    const PosePrior prior{T, root * root.transpose()};
    Vector6d off;
    for (int i = 0; i < 6; ++i) off(i) = (trial % 2 ? 0.8 : 1e-6) * unit(random);
    const auto at = moved(T, off);
    const auto prediction = priorResidual(prior, at);
    for (int k = 0; k < 6; ++k) {
      const Vector6d h = 1e-6 * Vector6d::Unit(k);
      const Vector6d numeric =
          (priorResidual(prior, moved(at, h)).residual - priorResidual(prior, moved(at, -h)).residual) / 2e-6;
      EXPECT_LT((numeric - prediction.by_pose.col(k)).norm(), 1e-5) << k;
    }
  }
}

}  // namespace window_ingress::estimation::partial_view_test
