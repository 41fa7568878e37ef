#include "adapters/markers/marker_sketch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "adapters/conversions/msg_conversion.hpp"
#include "adapters/markers/marker_colours.hpp"

namespace window_ingress::adapters::marker_sketch_test {

using visualization_msgs::Marker;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
const std_msgs::ColorRGBA kColour = colourOf(0x4080c0, 0.5);

MarkerSketch sketch() { return {ros::Time(12.5), "odom"}; }

TEST(MarkerSketch, EveryShapeCarriesFrameStampLifetimeAndColour) {
  MarkerSketch all = sketch();
  const Eigen::Vector3d p(1, 2, 3), q(2, 2, 3), r(1, 3, 3);
  all.line("line", {p, q}, kColour);
  all.strokes("strokes", {p, q}, kColour);
  all.surface("surface", {p, q, r}, kColour);
  all.arrow("arrow", p, q, kColour);
  all.box("box", Eigen::Isometry3d::Identity(), {0.1, 0.2, 0.3}, kColour);
  all.ellipsoid("ellipsoid", p, Eigen::Matrix3d::Identity(), 3.0, kColour);
  ASSERT_EQ(all.markers().markers.size(), 6u);
  for (const Marker& marker : all.markers().markers) {
    EXPECT_EQ(marker.header.frame_id, "odom") << marker.ns;
    EXPECT_EQ(marker.header.stamp, ros::Time(12.5)) << marker.ns;
    EXPECT_EQ(marker.action, Marker::ADD) << marker.ns;
    EXPECT_DOUBLE_EQ(marker.lifetime.toSec(), MarkerSketch::kLifetimeSec) << marker.ns;
    EXPECT_FLOAT_EQ(marker.color.a, 0.5F) << marker.ns;
    EXPECT_FLOAT_EQ(marker.color.b, 0xc0 / 255.0F) << marker.ns;
    EXPECT_NEAR(std::hypot(std::hypot(marker.pose.orientation.x, marker.pose.orientation.y),
                           std::hypot(marker.pose.orientation.z, marker.pose.orientation.w)),
                1.0, 1e-9)
        << marker.ns;
  }
}

TEST(MarkerSketch, TheBoxIsAsLargeAsItsHalfExtentsTwice) {
  MarkerSketch one = sketch();
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = Eigen::Vector3d(4, 5, 6);
  one.box("box", T, {0.25, 0.2, 0.0}, kColour);
  const Marker& box = one.markers().markers.front();
  EXPECT_DOUBLE_EQ(box.scale.x, 0.5);
  EXPECT_DOUBLE_EQ(box.scale.y, 0.4);
  EXPECT_GT(box.scale.z, 0.0) << "rviz refuses a scale of zero";
  EXPECT_DOUBLE_EQ(box.pose.position.y, 5.0);
}

// The unit sphere, scaled and turned as rviz does it, lies on the surface x' C^-1 x = 9.
TEST(MarkerSketch, TheEllipsoidIsTheSurfaceOfThreeStandardDeviations) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int round = 0; round < 200; ++round) {
    Eigen::Matrix3d root;
    for (int i = 0; i < 9; ++i) root(i) = normal(random);
    const Eigen::Matrix3d covariance = root * root.transpose() + 1e-3 * Eigen::Matrix3d::Identity();
    MarkerSketch one = sketch();
    one.ellipsoid("ellipsoid", {1, 2, 3}, covariance, 3.0, kColour);
    const Marker& marker = one.markers().markers.front();
    const auto pose = fromMsg(marker.pose);
    ASSERT_TRUE(pose) << pose.reason;
    const Eigen::Vector3d unit = Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
    const Eigen::Vector3d half = 0.5 * toEigen(marker.scale);
    const Eigen::Vector3d x = pose.value->linear() * half.cwiseProduct(unit);
    EXPECT_NEAR(x.dot(covariance.inverse() * x), 9.0, 1e-6);
  }
}

TEST(MarkerSketch, WhatCannotBeDrawnIsTakenAway) {
  MarkerSketch none = sketch();
  const Eigen::Vector3d p(1, 2, 3), bad(kNan, 0, 0);
  Eigen::Isometry3d infinite = Eigen::Isometry3d::Identity();
  infinite.translation().x() = std::numeric_limits<double>::infinity();
  none.line("line", {p}, kColour);
  none.line("NaN", {p, bad}, kColour);
  none.strokes("strokes", {}, kColour);
  none.surface("surface", {p, p}, kColour);
  none.arrow("arrow", p, bad, kColour);
  none.arrow("no length", p, p, kColour);
  none.box("box", infinite, {1, 1, 1}, kColour);
  none.ellipsoid("ellipsoid", p, Eigen::Matrix3d::Constant(kNan), 3.0, kColour);
  none.text("text", p, "");
  none.gone("gone");
  EXPECT_EQ(none.markers().markers.size(), 10u);
  for (const Marker& marker : none.markers().markers) EXPECT_EQ(marker.action, Marker::DELETE) << marker.ns;
}

TEST(MarkerSketch, ALineMayHaveAColourAPoint) {
  MarkerSketch one = sketch();
  const Eigen::Vector3d p(1, 2, 3), q(2, 2, 3);
  one.line("line", {p, q}, {colourOf(0xff0000), colourOf(0x00ff00)});
  const Marker& line = one.markers().markers.front();
  ASSERT_EQ(line.colors.size(), line.points.size());
  EXPECT_FLOAT_EQ(line.colors[1].g, 1.0F);
  EXPECT_GT(line.color.a, 0.0F) << "rviz draws nothing where the marker's own alpha is zero";
}

TEST(MarkerSketch, AllGoneEmptiesTheDisplay) {
  const auto markers = allGone(ros::Time(3.0), "odom");
  ASSERT_EQ(markers.markers.size(), 1u);
  EXPECT_EQ(markers.markers.front().action, Marker::DELETEALL);
  EXPECT_EQ(markers.markers.front().header.frame_id, "odom");
}

TEST(Wrapped, BreaksBetweenWordsOnly) {
  EXPECT_EQ(wrapped("", 10), "");
  EXPECT_EQ(wrapped("one two three", 7), "one two\nthree");
  EXPECT_EQ(wrapped("unbreakable", 3), "unbreakable");
  EXPECT_EQ(wrapped("  a   b ", 10), "a b");
}

TEST(Wrapped, KeepsEveryWordAndEveryLineShort) {
  std::mt19937 random(3);
  for (int round = 0; round < 200; ++round) {
    std::string text, plain;
    for (int word = 0; word < 12; ++word) text += std::string(1 + random() % 8, 'x') + " ";
    text.pop_back();
    std::string broken = wrapped(text, 15), line;
    std::istringstream lines(broken);
    while (std::getline(lines, line)) EXPECT_LE(line.size(), 15u);
    for (char& c : broken) c = c == '\n' ? ' ' : c;
    EXPECT_EQ(broken, text);
  }
}

}  // namespace window_ingress::adapters::marker_sketch_test
