#include "adapters/markers/window_markers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

#include "adapters/conversions/msg_conversion.hpp"
#include "adapters/markers/marker_colours.hpp"
#include "adapters/markers/marker_sketch.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::adapters::window_markers_test {

using visualization_msgs::Marker;

Eigen::Vector3d at(const geometry_msgs::Point& p) { return {p.x, p.y, p.z}; }

estimation::FilteredWindow trustedWindow() {
  estimation::FilteredWindow window;
  window.T_odom_window = geometry::makePose(geometry::yawRotation(0.5), Eigen::Vector3d(4, 1, 1.5));
  window.covariance.diagonal() << 0.04, 0.01, 0.0025, 1e-6, 1e-6, 0.0004;
  window.sign_trusted = true;
  window.size.size = {1.2, 1.0};
  return window;
}

estimation::FilteredWindow openWindow(double weight) {
  estimation::FilteredWindow window = trustedWindow();
  window.sign_trusted = false;
  window.hypothesis_weight = weight;
  window.alternative.emplace();
  window.alternative->T_odom_window =
      geometry::makePose(geometry::yawRotation(-0.3), Eigen::Vector3d(4, 1, 1.5));
  window.alternative->covariance = window.covariance;
  return window;
}

std::map<std::string, Marker> byName(const visualization_msgs::MarkerArray& markers) {
  std::map<std::string, Marker> found;
  for (const Marker& marker : markers.markers) {
    EXPECT_EQ(found.count(marker.ns), 0u) << marker.ns << " replaces itself";
    found[marker.ns] = marker;
  }
  return found;
}

std::map<std::string, Marker> drawn(const estimation::FilteredWindow& window) {
  return byName(windowMarkers(window, "yaw +3.0", ros::Time(5.0), "odom"));
}

TEST(WindowMarkers, TheBorderIsThatOfTheOpeningClosed) {
  const estimation::FilteredWindow window = trustedWindow();
  const Marker border = drawn(window).at("window");
  ASSERT_EQ(border.points.size(), 5u);
  for (int i = 0; i < 5; ++i) {
    const Eigen::Vector3d corner =
        window.T_odom_window * geometry::openingCorners(window.size.size)[static_cast<std::size_t>(i % 4)];
    EXPECT_NEAR((at(border.points[static_cast<std::size_t>(i)]) - corner).norm(), 0.0, 1e-9);
  }
}

TEST(WindowMarkers, TheArrowShowsTheWayThrough) {
  const estimation::FilteredWindow window = trustedWindow();
  const Marker arrow = drawn(window).at("window: way through");
  const Eigen::Vector3d along = at(arrow.points[1]) - at(arrow.points[0]);
  EXPECT_NEAR(along.normalized().dot(window.T_odom_window.linear().col(0)), 1.0, 1e-9);
  EXPECT_NEAR((at(arrow.points[0]) - window.T_odom_window.translation()).norm(), 0.0, 1e-9);
}

TEST(WindowMarkers, TheFanSpansThreeStandardDeviationsOfTheHeading) {
  const estimation::FilteredWindow window = trustedWindow();
  const Marker fan = drawn(window).at("window: heading, 3 sigma");
  double widest_rad = 0.0;
  for (const auto& point : fan.points) {
    const Eigen::Vector3d p = window.T_odom_window.inverse() * at(point);
    EXPECT_NEAR(p.z(), 0.0, 1e-9) << "the fan lies flat";
    widest_rad = std::max(widest_rad, std::abs(std::atan2(p.y(), p.x())));
  }
  EXPECT_NEAR(widest_rad, 3.0 * 0.02, 1e-9);
}

TEST(WindowMarkers, TheEllipsoidIsThatOfTheCentre) {
  const Marker ellipsoid = drawn(trustedWindow()).at("window: centre, 3 sigma");
  const Eigen::Vector3d scale = toEigen(ellipsoid.scale);
  EXPECT_NEAR(scale.maxCoeff(), 2.0 * 3.0 * 0.2, 1e-9);
  EXPECT_NEAR(scale.minCoeff(), 2.0 * 3.0 * 0.05, 1e-9);
}

// The area of the wall equals its outline minus the opening: the wall covers no part of the opening.
TEST(WindowMarkers, TheWallLeavesTheOpeningFree) {
  const Marker wall = drawn(trustedWindow()).at("wall");
  double area_m2 = 0.0;
  const Eigen::Isometry3d T_window_odom = trustedWindow().T_odom_window.inverse();
  Eigen::Vector3d reach = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i + 2 < wall.points.size(); i += 3) {
    const Eigen::Vector3d a = at(wall.points[i]), b = at(wall.points[i + 1]), c = at(wall.points[i + 2]);
    area_m2 += 0.5 * (b - a).cross(c - a).norm();
    for (const Eigen::Vector3d& p : {a, b, c}) reach = reach.cwiseMax((T_window_odom * p).cwiseAbs());
  }
  EXPECT_NEAR(reach.x(), 0.0, 1e-9) << "in the window's plane";
  EXPECT_NEAR(area_m2, 4.0 * reach.y() * reach.z() - 1.2 * 1.0, 1e-9);
}

TEST(WindowMarkers, TrustedIsGreenWithAWallAndWithoutASecondWindow) {
  const auto markers = drawn(trustedWindow());
  EXPECT_FLOAT_EQ(markers.at("window").color.g, colourOf(kTrustedRgb).g);
  EXPECT_EQ(markers.at("wall").action, Marker::ADD);
  EXPECT_EQ(markers.at("mirrored window").action, Marker::DELETE);
  EXPECT_EQ(markers.at("mirrored window: way through").action, Marker::DELETE);
  EXPECT_EQ(markers.at("window: text").text, "yaw +3.0");
}

TEST(WindowMarkers, WhileTheSignIsOpenBothAreShownAndNoWall) {
  const auto markers = drawn(openWindow(0.6));
  EXPECT_FLOAT_EQ(markers.at("window").color.r, colourOf(kOpenRgb).r);
  EXPECT_EQ(markers.at("wall").action, Marker::DELETE);
  const Marker& other = markers.at("mirrored window");
  EXPECT_EQ(other.action, Marker::ADD);
  EXPECT_FLOAT_EQ(other.color.b, colourOf(kMirroredRgb).b);
  EXPECT_LT(other.color.a, 1.0F);
  EXPECT_GT(other.color.a, drawn(openWindow(0.95)).at("mirrored window").color.a)
      << "the less likely, the fainter";
  const Eigen::Vector3d way = at(markers.at("mirrored window: way through").points[1]) -
                              at(markers.at("mirrored window: way through").points[0]);
  EXPECT_NEAR(std::atan2(way.y(), way.x()), -0.3, 1e-9);
  EXPECT_NE(markers.at("window: text").text.find("60.0 : 40.0 %"), std::string::npos);
}

TEST(WindowMarkers, NothingThatIsNotFiniteIsDrawn) {
  estimation::FilteredWindow window = trustedWindow();
  window.T_odom_window.translation().x() = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [name, marker] : drawn(window)) EXPECT_EQ(marker.action, Marker::DELETE) << name;
  window = trustedWindow();
  window.covariance.setConstant(-1.0);
  const auto markers = drawn(window);
  EXPECT_EQ(markers.at("window").action, Marker::ADD);
  for (const auto& point : markers.at("window: heading, 3 sigma").points) EXPECT_TRUE(at(point).allFinite());
}

TEST(OpeningPolygon, HasTheCornersOfTheOpening) {
  const estimation::FilteredWindow window = trustedWindow();
  const auto polygon = openingPolygon(window.T_odom_window, window.size.size, ros::Time(5.0), "odom").polygon;
  ASSERT_EQ(polygon.points.size(), 4u);
  const Eigen::Vector3d corner = window.T_odom_window * geometry::openingCorners(window.size.size)[2];
  EXPECT_NEAR(polygon.points[2].x, corner.x(), 1e-5);
  EXPECT_NEAR(polygon.points[2].z, corner.z(), 1e-5);
}

}  // namespace window_ingress::adapters::window_markers_test
