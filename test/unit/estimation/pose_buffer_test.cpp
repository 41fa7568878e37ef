#include "window_ingress/estimation/pose_buffer.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::estimation::pose_buffer_test {

using geometry::makePose;
using geometry::yawOf;
using geometry::yawRotation;

TEST(PoseBuffer, InterpolatesPositionAndRotation) {
  PoseBuffer buffer;
  EXPECT_FALSE(buffer.at(1.0));
  ASSERT_TRUE(buffer.add(1.0, makePose(yawRotation(3.0), {0, 0, 0})));
  ASSERT_TRUE(buffer.add(1.1, makePose(yawRotation(-3.0), {1, 2, 3})));
  const auto pose = buffer.at(1.025);
  ASSERT_TRUE(pose);
  EXPECT_LT((pose->translation() - Eigen::Vector3d(0.25, 0.5, 0.75)).norm(), 1e-12);
  EXPECT_NEAR(yawOf(pose->linear()), 3.0 + 0.25 * (2 * M_PI - 6.0), 1e-9) << "the short way round";
  EXPECT_TRUE(buffer.at(1.0)->isApprox(makePose(yawRotation(3.0), {0, 0, 0})));
  EXPECT_TRUE(buffer.at(1.1)->isApprox(makePose(yawRotation(-3.0), {1, 2, 3})));
}

TEST(PoseBuffer, ExtrapolatesOnlyAsFarAsAllowed) {
  PoseBuffer buffer;
  buffer.add(1.0, makePose(yawRotation(0), {0, 0, 0}));
  buffer.add(2.0, makePose(yawRotation(0), {1, 0, 0}));
  EXPECT_FALSE(buffer.at(2.01));
  EXPECT_FALSE(buffer.at(0.99));
  EXPECT_EQ(buffer.at(2.01, 0.05)->translation().x(), 1.0);
  EXPECT_EQ(buffer.at(0.99, 0.05)->translation().x(), 0.0);
  EXPECT_FALSE(buffer.at(2.06, 0.05));
}

TEST(PoseBuffer, JumpBackInTimeClears) {
  PoseBuffer buffer;
  buffer.add(10.0, makePose(yawRotation(0), {1, 0, 0}));
  EXPECT_TRUE(buffer.add(5.0, makePose(yawRotation(0), {2, 0, 0})));
  EXPECT_FALSE(buffer.at(10.0));
  EXPECT_EQ(buffer.at(5.0)->translation().x(), 2.0);
}

TEST(PoseBuffer, NothingIsKnownWithinALongGap) {
  PoseBuffer buffer;
  buffer.add(1.0, makePose(yawRotation(0), {0, 0, 0}));
  buffer.add(1.25, makePose(yawRotation(0), {1, 0, 0}));
  buffer.add(2.25, makePose(yawRotation(1), {2, 0, 0}));
  EXPECT_TRUE(buffer.at(1.1, 0.05)) << "five a second are enough";
  EXPECT_FALSE(buffer.at(1.7, 0.05)) << "where it was in between is a guess";
  EXPECT_EQ(buffer.at(1.28, 0.05)->translation().x(), 1.0);
  EXPECT_EQ(buffer.at(2.22, 0.05)->translation().x(), 2.0);
  EXPECT_EQ(buffer.at(2.25)->translation().x(), 2.0);
}

TEST(PoseBuffer, ALateSampleIsNoJumpBackInTime) {
  PoseBuffer buffer;
  for (int i = 0; i < 10; ++i) buffer.add(1.0 + 0.02 * i, makePose(yawRotation(0), {0.02 * i, 0, 0}));
  EXPECT_FALSE(buffer.add(1.17, makePose(yawRotation(0), {0.17, 0, 0})));
  ASSERT_TRUE(buffer.at(1.05));
  EXPECT_NEAR(buffer.at(1.05)->translation().x(), 0.05, 1e-12);
}

TEST(PoseBuffer, IsBoundedInSpanAndCount) {
  PoseBuffer by_span, by_count;
  for (int i = 0; i < 100; ++i) by_span.add(0.1 * i, Eigen::Isometry3d::Identity());
  for (int i = 0; i < 1500; ++i) by_count.add(0.001 * i, Eigen::Isometry3d::Identity());
  EXPECT_FALSE(by_span.at(7.75));
  EXPECT_TRUE(by_span.at(8.05));
  EXPECT_FALSE(by_count.at(0.4955));
  EXPECT_TRUE(by_count.at(0.5045));
  by_span.clear();
  EXPECT_TRUE(by_span.empty());
}

TEST(PoseBuffer, RefusesWhatIsNotAPose) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  PoseBuffer buffer;
  EXPECT_FALSE(buffer.add(nan, Eigen::Isometry3d::Identity()));
  EXPECT_FALSE(buffer.add(1.0, makePose(yawRotation(0), {nan, 0, 0})));
  EXPECT_FALSE(buffer.add(1.0, makePose(1.1 * yawRotation(0), {0, 0, 0})));
  EXPECT_TRUE(buffer.empty());
  EXPECT_TRUE(buffer.add(1.0, Eigen::Isometry3d::Identity()));
  EXPECT_FALSE(buffer.add(1.0, Eigen::Isometry3d::Identity())) << "a repeated stamp";
  EXPECT_FALSE(buffer.at(nan));
}

}  // namespace window_ingress::estimation::pose_buffer_test
