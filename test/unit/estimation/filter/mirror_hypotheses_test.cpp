#include "estimation/filter/mirror_hypotheses.hpp"

#include <gtest/gtest.h>

#include "../pose_fixtures.hpp"

namespace window_ingress::estimation::mirror_hypotheses_test {

using namespace fixtures;

const auto kLens = camera();
const SizeEstimate kKnown{kOpening};
const YawBias kNoBias{0.0, 0.005};

Eigen::Isometry3d cameraAt(const Eigen::Vector3d& position) {
  return geometry::makePose(geometry::R_optical_flu().transpose(), position);
}

Eigen::Isometry3d windowAt(double distance_m, double yaw_rad) {
  return geometry::makePose(geometry::yawRotation(yaw_rad), {distance_m, 0, 0});
}

ImageMeasurement seen(const Eigen::Isometry3d& T_odom_camera, const Eigen::Isometry3d& T_odom_window) {
  std::mt19937 random(1);
  return ImageMeasurement::make(bordersSeen(kLens, T_odom_camera.inverse() * T_odom_window, 0.5, random),
                                kLens, {})
      .value();
}

double weightsOf(const MirrorHypotheses& beliefs) {
  double sum = 0.0;
  for (const auto& h : beliefs.hypotheses()) sum += std::exp(h.log_weight);
  return sum;
}

TEST(MirrorHypotheses, FarAwayBothMirrorImagesLiveFromEitherStart) {
  const auto T = cameraAt({0, 0, 0});
  const auto image = seen(T, windowAt(8.0, 0.25));
  const FilterView view{image, image, kLens, T};
  for (const double started : {0.25, -0.25}) {
    MirrorHypotheses beliefs{FilterParams{}};
    ASSERT_TRUE(beliefs.start(windowAt(8.0, started), kKnown, kNoBias, view));
    ASSERT_EQ(beliefs.hypotheses().size(), 2u);
    EXPECT_NEAR(weightsOf(beliefs), 1.0, 1e-12);
    EXPECT_NEAR(beliefs.hypotheses()[0].window.state().yaw(), 0.25, 0.1);
    EXPECT_NEAR(beliefs.hypotheses()[1].window.state().yaw(), -0.25, 0.1);
    EXPECT_FALSE(beliefs.areUnambiguous());
  }
}

TEST(MirrorHypotheses, ParallaxKillsTheMirrorImage) {
  MirrorHypotheses beliefs{FilterParams{}};
  const auto window = windowAt(8.0, 0.25);
  Eigen::Vector3d position(0, 0, 0);
  const auto first = seen(cameraAt(position), window);
  ASSERT_TRUE(beliefs.start(window, kKnown, kNoBias, {first, first, kLens, cameraAt(position)}));
  int images = 0;
  for (; images < 40 && beliefs.hypotheses().size() == 2; ++images) {
    position.y() += 0.1;
    const auto image = seen(cameraAt(position), window);
    const FilterView view{image, image, kLens, cameraAt(position)};
    EXPECT_TRUE(beliefs.apply(view, 0.1, 0.1));
    EXPECT_NEAR(weightsOf(beliefs), 1.0, 1e-12);
  }
  EXPECT_LT(images, 40);
  EXPECT_GE(images, 2) << "no single image decides";
  EXPECT_TRUE(beliefs.areUnambiguous());
  EXPECT_NEAR(beliefs.hypotheses()[0].window.state().yaw(), 0.25, 0.05);
}

TEST(MirrorHypotheses, AnOutlierChangesNothing) {
  MirrorHypotheses beliefs{FilterParams{}};
  const auto T = cameraAt({0, 0, 0});
  const auto image = seen(T, windowAt(3.0, 0.3));
  ASSERT_TRUE(beliefs.start(windowAt(3.0, 0.3), kKnown, kNoBias, {image, image, kLens, T}));
  const auto before = beliefs.hypotheses()[0].window.state().values;
  auto moved = windowAt(3.0, 0.3);
  moved.translation().y() += 0.5;
  const auto outlier = seen(T, moved);
  const FilterView view{outlier, outlier, kLens, T};
  EXPECT_FALSE(beliefs.apply(view, 0.1, 0.0));
  EXPECT_EQ(beliefs.hypotheses()[0].window.state().values, before);
}

TEST(MirrorHypotheses, AStartThatDoesNotExplainTheImageChangesNothing) {
  MirrorHypotheses beliefs{FilterParams{}};
  const auto T = cameraAt({0, 0, 0});
  auto leaning = windowAt(3.0, 0.3);
  leaning.linear() = leaning.linear() * geometry::rotationFromEuler({0.5, 0, 0});
  const auto image = seen(T, leaning);
  EXPECT_FALSE(beliefs.start(leaning, kKnown, kNoBias, {image, image, kLens, T}));
  EXPECT_TRUE(beliefs.empty());
}

}  // namespace window_ingress::estimation::mirror_hypotheses_test
