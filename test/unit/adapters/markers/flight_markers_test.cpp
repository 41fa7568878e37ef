#include "adapters/markers/flight_markers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <random>

#include "adapters/conversions/msg_conversion.hpp"
#include "adapters/markers/marker_colours.hpp"
#include "adapters/markers/marker_sketch.hpp"
#include "navigation_samples.hpp"
#include "window_ingress/navigation/commit_criterion.hpp"

namespace window_ingress::adapters::flight_markers_test {

using navigation::State;
using visualization_msgs::Marker;

Eigen::Vector3d at(const geometry_msgs::Point& p) { return {p.x, p.y, p.z}; }

struct Scene {
  navigation::NavigatorOutput output;
  navigation::NavigatorInput input = test::inputAt({-4.0, 0.2, 1.5}, 10.0);
  FlightTrail trail;
  navigation::NavigatorParams params;

  std::map<std::string, Marker> drawn() const {
    std::map<std::string, Marker> found;
    const auto all = flightMarkers(output, input, trail, params, ros::Time(10.0), "odom");
    for (const Marker& marker : all.markers) {
      EXPECT_EQ(found.count(marker.ns), 0u) << marker.ns << " replaces itself";
      found[marker.ns] = marker;
    }
    return found;
  }
};

TEST(FlightMarkers, TheVehicleHasItsTrueSizeAndTheColourOfItsState) {
  Scene scene;
  scene.output.state = State::kCommit;
  const Marker box = scene.drawn().at("vehicle");
  EXPECT_DOUBLE_EQ(box.scale.x, 2.0 * scene.params.vehicle.half_length_m);
  EXPECT_DOUBLE_EQ(box.scale.y, 2.0 * scene.params.vehicle.half_width_m);
  EXPECT_DOUBLE_EQ(box.scale.z, 2.0 * scene.params.vehicle.half_height_m);
  EXPECT_DOUBLE_EQ(box.pose.position.x, -4.0);
  EXPECT_FLOAT_EQ(box.color.r, colourOf(State::kCommit).r);
}

TEST(FlightMarkers, TheSetpointIsTheWayOfTheNextSecond) {
  Scene scene;
  scene.output.setpoint.velocity_odom_mps = Eigen::Vector3d(0.6, -0.3, 0.1);
  scene.output.setpoint.yaw_rate_radps = 0.4;
  const auto markers = scene.drawn();
  const Marker& arrow = markers.at("setpoint");
  EXPECT_NEAR((at(arrow.points[1]) - at(arrow.points[0]) - Eigen::Vector3d(0.6, -0.3, 0.1)).norm(), 0.0,
              1e-9);
  const Marker& turn = markers.at("setpoint: turn");
  const Eigen::Vector3d centre = scene.input.vehicle->T_odom_base.translation();
  const Eigen::Vector3d nose = at(turn.points.back()) - centre;
  EXPECT_NEAR(std::atan2(nose.y(), nose.x()), 0.4, 1e-9);
}

TEST(FlightMarkers, StandingStillThereIsNoArrow) {
  const auto markers = Scene().drawn();
  EXPECT_EQ(markers.at("setpoint").action, Marker::DELETE);
  EXPECT_EQ(markers.at("setpoint: turn").action, Marker::DELETE);
}

TEST(FlightMarkers, TheStateAndItsReasonAreReadable) {
  Scene scene;
  scene.output.state = State::kHold;
  scene.output.reason = "odometry 0.41 s old, and a text that goes on for longer than one line may be";
  const std::string text = scene.drawn().at("state").text;
  EXPECT_EQ(text.rfind("HOLD\nodometry 0.41 s old", 0), 0u) << text;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 30u);
}

TEST(FlightMarkers, TheFunnelIsShownOnlyWhileTheSignIsTrusted) {
  Scene scene;
  for (const char* name : {"funnel", "commit line"})
    EXPECT_EQ(scene.drawn().at(name).action, Marker::ADD) << name;
  scene.input.target->sign_trusted = false;
  for (const char* name : {"funnel", "commit line"})
    EXPECT_EQ(scene.drawn().at(name).action, Marker::DELETE) << name;
  scene.input.target.reset();
  EXPECT_EQ(scene.drawn().at("funnel").action, Marker::DELETE);
}

TEST(FlightMarkers, TheFunnelHasNoFacesThatWouldTakeTheClicksForWindowsBehindIt) {
  for (const auto& [name, marker] : Scene().drawn()) EXPECT_NE(marker.type, Marker::TRIANGLE_LIST) << name;
  EXPECT_EQ(Scene().drawn().at("funnel").points.size(), 2u * (4u + 4u + 4u))
      << "two lengths and the outer rim";
}

TEST(FlightMarkers, TheCommitLineIsARectangleAtTheCommitDistance) {
  Scene scene;
  const auto sections = funnelOf(*scene.input.vehicle, *scene.input.target, scene.params);
  const Marker line = scene.drawn().at("commit line");
  ASSERT_EQ(line.points.size(), 8u);
  for (const auto& point : line.points) {
    EXPECT_NEAR(at(point).x(), -sections[1].distance_m, 1e-9);
    EXPECT_NEAR(std::abs(at(point).y()), sections[1].half_width_m, 1e-9);
    EXPECT_NEAR(std::abs(at(point).z() - 1.5), sections[1].half_height_m, 1e-9);
  }
}

TEST(FlightMarkers, WithoutOdometryThereIsNothingToShow) {
  Scene scene;
  scene.input.vehicle.reset();
  EXPECT_TRUE(scene.drawn().empty());
}

TEST(FlightMarkers, ASpoiltTargetIsNotDrawn) {
  Scene scene;
  scene.input.target->T_odom_window.translation().y() = std::numeric_limits<double>::quiet_NaN();
  const auto markers = scene.drawn();
  EXPECT_EQ(markers.at("vehicle").action, Marker::ADD);
  for (const auto& point : markers.at("funnel").points) EXPECT_TRUE(at(point).allFinite());
}

// The drawn funnel equals the navigator's: a vehicle just inside the drawn wall is in the funnel, one just
// outside is not.
TEST(Funnel, IsTheOneThatTheNavigatorFliesBy) {
  navigation::NavigatorParams params;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> share(0.0, 1.0), side(-1.0, 1.0);
  for (int round = 0; round < 300; ++round) {
    params.approach.funnel_slope = 0.3 + share(random);
    params.vehicle.odom_drift_m_per_sqrt_sec = 0.0;
    navigation::TargetEstimate target = test::targetAtOrigin(10.0);
    target.covariance.setZero();
    target.opening = {0.9 + share(random), 0.8 + share(random)};
    const auto sections = funnelOf(test::vehicleAt({-4.0, 0.0, 1.5}, 10.0), target, params);
    ASSERT_EQ(sections.size(), 3u);
    const double along = share(random);
    const double distance_m =
        sections[1].distance_m + along * (sections[2].distance_m - sections[1].distance_m);
    const double wall_m =
        sections[1].half_width_m + along * (sections[2].half_width_m - sections[1].half_width_m);
    for (const double factor : {0.95, 1.05}) {
      navigation::CommitCriterionInput input;
      input.opening = target.opening;
      input.relative.position_window_m =
          Eigen::Vector3d(-distance_m, std::copysign(factor * wall_m, side(random)), 0.0);
      const navigation::CommitCriterion criterion = navigation::evaluateCommitCriterion(input, params);
      const double line_moved_m = criterion.commit_distance_m - sections[1].distance_m;
      if (line_moved_m * params.approach.funnel_slope > 0.04 * wall_m)
        continue;  // off the axis it is further out
      EXPECT_EQ(criterion.fullness < 1.0, factor < 1.0) << "round " << round << ", " << criterion.fullness;
    }
  }
}

TEST(Funnel, OfAnOpeningTooSmallIsNone) {
  navigation::TargetEstimate target = test::targetAtOrigin(10.0);
  target.opening = {0.5, 0.5};
  EXPECT_TRUE(funnelOf(test::vehicleAt({-4.0, 0.0, 1.5}, 10.0), target, {}).empty());
}

TEST(FlightTrail, KeepsPlacesApartAndEveryChangeOfState) {
  FlightTrail trail;
  for (int i = 0; i < 100; ++i) trail.add({0.001 * i, 0, 0}, State::kSearch);
  EXPECT_EQ(trail.places().size(), 2u);
  trail.add({0.0991, 0, 0}, State::kAlign);
  EXPECT_EQ(trail.places().size(), 3u);
  EXPECT_EQ(trail.places().back().state, State::kAlign);
  trail.add({std::numeric_limits<double>::quiet_NaN(), 0, 0}, State::kAlign);
  EXPECT_EQ(trail.places().size(), 3u);
  trail.clear();
  EXPECT_TRUE(trail.places().empty());
}

TEST(FlightTrail, StaysBoundedAndStillReachesFromStartToEnd) {
  FlightTrail trail;
  for (int i = 0; i < 100000; ++i) trail.add({0.05 * i, 0, 0}, State::kApproach);
  EXPECT_LE(trail.places().size(), 2000u);
  EXPECT_GE(trail.places().size(), 900u);
  EXPECT_DOUBLE_EQ(trail.places().front().position_odom_m.x(), 0.0);
  EXPECT_GT(trail.places().back().position_odom_m.x(), 4950.0);
}

TEST(FlightTrail, IsDrawnInTheColoursOfItsStatesUpToTheVehicle) {
  Scene scene;
  scene.trail.add({-6, 0, 1}, State::kSearch);
  scene.trail.add({-5, 0, 1}, State::kAlign);
  scene.output.state = State::kApproach;
  const Marker line = scene.drawn().at("way flown");
  ASSERT_EQ(line.points.size(), 3u);
  EXPECT_FLOAT_EQ(line.colors[0].r, colourOf(State::kSearch).r);
  EXPECT_FLOAT_EQ(line.colors[2].g, colourOf(State::kApproach).g);
  EXPECT_DOUBLE_EQ(line.points[2].x, -4.0);
}

}  // namespace window_ingress::adapters::flight_markers_test
