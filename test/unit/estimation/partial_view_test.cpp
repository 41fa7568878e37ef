/// Poses from a partly visible window near its plane: four borders without corners, but no fewer.
#include <gtest/gtest.h>

#include <limits>

#include "pose_fixtures.hpp"

namespace window_ingress::estimation::partial_view_test {

using namespace fixtures;

const double kNaN = std::numeric_limits<double>::quiet_NaN();

/// The parts of the borders between the fractions `from` and `to` of their length, without corners.
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

constexpr std::array<bool, 4> kAll{true, true, true, true}, kNoBottom{true, true, false, true},
    kSides{false, true, false, true};

TEST(PartialView, FourBordersAreEnoughThoughNoCornerIsSeen) {
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

TEST(PartialView, WithoutEnoughBordersThereIsAReason) {
  const WindowPoseEstimator estimator{PoseParams{}};
  std::mt19937 random(5);
  const auto T = view(1.5, 0.2);
  const auto whole = bordersSeen(camera(), T, 0.3, random);
  const auto three = estimator.estimate(partly(whole, kNoBottom), camera());
  EXPECT_EQ(three.reject, PoseReject::kBadCorners);
  EXPECT_EQ(three.detail, "3 of 4 sides in view: bottom not seen; no pose from this image alone");
  const auto two = estimator.estimate(partly(whole, kSides), camera());
  EXPECT_EQ(two.reject, PoseReject::kBadCorners);
  EXPECT_EQ(two.detail, "2 of 4 sides in view: top, bottom not seen; no pose from this image alone");
}

TEST(PartialView, BadBordersAreRefused) {
  const WindowPoseEstimator estimator{PoseParams{}};
  std::mt19937 random(6);
  const auto T = view(1.5, 0.2);
  const auto good = partly(bordersSeen(camera(), T, 0.3, random), kAll);
  ASSERT_TRUE(estimator.estimate(good, camera()).estimate);
  for (const Eigen::Vector2d& end : {Eigen::Vector2d(kNaN, 0), Eigen::Vector2d(1e30, 5), good.edges[1].b}) {
    auto bad = good;
    bad.edges[1].a = end;
    EXPECT_EQ(estimator.estimate(bad, camera()).reject, PoseReject::kBadCorners) << end.transpose();
  }
  const GravityPrior rolled{{1.0, -0.2, 0.0}, 0.02};
  EXPECT_EQ(estimator.estimate(good, camera(), {rolled}).reject, PoseReject::kBadCorners);
}

}  // namespace window_ingress::estimation::partial_view_test
