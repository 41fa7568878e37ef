#include <gtest/gtest.h>

#include <cmath>

#include "../view.hpp"
#include "simulation/scene/scene.hpp"

namespace window_ingress::simulation::scene_light_test {

using Eigen::Vector3d;

Scenario sunFrom(double azimuth_rad, double elevation_rad) {
  Scenario scenario;
  scenario.house.daylight.sun_azimuth_rad = azimuth_rad;
  scenario.house.daylight.sun_elevation_rad = elevation_rad;
  scenario.house.eaves_m = 6.0;  // no shadow of the eaves on the window
  return scenario;
}

double area(const Polygon& polygon) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    sum += (polygon[i].position - polygon[0].position).cross(polygon[i + 1].position - polygon[0].position);
  return 0.5 * sum.norm();
}

TEST(Split, PartsHaveTheAreaOfTheWholeAndLieOnTheirSides) {
  const Polygon square{{{0, 0, 0}, {0, 0}}, {{1, 0, 0}, {1, 0}}, {{1, 1, 0}, {1, 1}}, {{0, 1, 0}, {0, 1}}};
  for (int i = 0; i < 200; ++i) {
    const double angle = 0.05 * i, offset = -0.5 + 0.01 * i;
    const HalfSpace half{{std::cos(angle), std::sin(angle), 0}, offset};
    const auto [within, beyond] = split(square, half);
    EXPECT_NEAR(area(within) + area(beyond), 1.0, 1e-9) << i;
    for (const auto& corner : within) EXPECT_LE(half.beyond(corner.position), 1e-8);
    for (const auto& corner : beyond) EXPECT_GE(half.beyond(corner.position), -1e-8);
    for (const auto& corner : within) EXPECT_TRUE(corner.uv.isApprox(corner.position.head<2>(), 1e-9));
  }
  EXPECT_TRUE(split(square, {Vector3d::UnitX(), 0.0}).first.empty()) << "a border is no area";
  EXPECT_TRUE(split(square, {Vector3d::UnitX(), 1.0}).second.empty());
}

TEST(Split, AMeshCutsItsFacesWhereTheSunEnds) {
  Lighting light{Vector3d::UnitZ(), 0.5, 0.25};
  light.region = {{Vector3d::UnitX(), 0.3}};
  Mesh mesh(light);
  mesh.addQuad(Vector3d::Zero(), Vector3d::UnitX(), Vector3d::UnitY(), {});
  const auto& vertices = mesh.batches().begin()->second;
  ASSERT_EQ(vertices.size(), 8u);
  for (std::size_t i = 0; i < 8; i += 4) {
    const double middle = 0.25 * (vertices[i].position[0] + vertices[i + 1].position[0] +
                                  vertices[i + 2].position[0] + vertices[i + 3].position[0]);
    EXPECT_EQ(vertices[i].colour[0] > 100, middle < 0.3) << middle;
  }
}

TEST(Sunlight, FallsOnTheSideOfTheOpeningAcrossFromTheSun) {
  for (const double azimuth_rad : {0.8, -0.8}) {
    const Scene scene = buildScene(sunFrom(azimuth_rad, 0.6));
    const double right = views::greyAt(scene, {-1.5, 0.4, 0}, {0.15, -0.6, 0.0});
    const double left = views::greyAt(scene, {-1.5, -0.4, 0}, {0.15, 0.6, 0.0});
    EXPECT_GT(azimuth_rad * (right - left), 20.0 * std::abs(azimuth_rad)) << right << " " << left;
  }
}

TEST(Sunlight, ReachesTheSillAsFarAsTheJambLetsIt) {
  for (const double side : {1.0, -1.0}) {
    const Scene scene = buildScene(sunFrom(0.7 * side, 0.8));
    const Vector3d from(-1.0, 0.0, 1.2);
    // At a depth x the jamb's shadow is x tan(azimuth) wide.
    const double edge_m = 0.6 - 0.2 * std::tan(0.7);
    const double shaded = views::greyAt(scene, from, {0.2, side * (edge_m + 0.03), -0.5});
    const double lit = views::greyAt(scene, from, {0.2, side * (edge_m - 0.03), -0.5});
    const double far_side = views::greyAt(scene, from, {0.2, side * -0.55, -0.5});
    EXPECT_GT(lit, shaded + 30.0) << side;
    EXPECT_NEAR(lit, far_side, 3.0) << side;
  }
}

TEST(Sunlight, TheEavesShadowOfTheWallGoesOnInsideTheOpening) {
  Scenario scenario = sunFrom(0.0, 0.8);
  scenario.house.eaves_m = 1.0 + 0.9 + 0.46 * std::tan(0.8);  // ends 0.1 m below the top of the opening
  const Scene scene = buildScene(scenario);
  const double above = views::greyAt(scene, {-2, 2.0, 0.4}, {0.02, 1.5, 0.47});
  const double below = views::greyAt(scene, {-2, 2.0, 0.2}, {0.02, 1.5, 0.33});
  EXPECT_GT(below, above + 30.0);
}

TEST(Sunlight, FromBehindTheHouseLeavesWallAndGroundInTheShade) {
  const Scene front = buildScene(sunFrom(0.4, 0.7)), back = buildScene(sunFrom(2.8, 0.7));
  const Vector3d wall(0.02, 1.5, 0.2), ground(-1.5, 0.5, -1.49);
  EXPECT_GT(views::greyAt(front, {-3, 1, 0}, wall), views::greyAt(back, {-3, 1, 0}, wall) + 30.0);
  EXPECT_GT(views::greyAt(front, {-3, 1, 0}, ground), views::greyAt(back, {-3, 1, 0}, ground) + 30.0);
}

TEST(Sunlight, MakesAPatchOnTheFloorOfTheRoomBelowTheOpening) {
  const Scene scene = buildScene(sunFrom(0.0, 0.8));
  const double slope = std::tan(0.8);
  const double near_m = 1.0 / slope + 0.15, beyond_m = 2.0 / slope + 0.3;
  const Vector3d from(-1.0, 0, 0.3);
  const double patch = views::greyAt(scene, from, {near_m + 0.1, 0.0, -1.49});
  EXPECT_GT(patch, views::greyAt(scene, {-0.6, 0, 0.3}, {beyond_m, 0.0, -1.49}) + 20.0);
}

// The lawn is one large face that extends behind the camera. Its near part must keep its colour.
TEST(Fog, IsThinNearTheCamera) {
  Scenario scenario;
  const Eigen::Vector3d eye(-12.0, 0.0, 0.0), lawn(-10.5, 0.0, -scenario.windowCentreHeight());
  const auto greenness = [&](double fog_m) {
    scenario.house.daylight.fog_m = fog_m;
    const cv::Mat image = views::photograph(buildScene(scenario), views::lookAt(eye, lawn), 0.3);
    const cv::Scalar mean = cv::mean(image);
    return mean[1] - 0.5 * (mean[0] + mean[2]);
  };
  const double clear = greenness(0.0), in_fog = greenness(10.0);
  ASSERT_GT(clear, 10.0);
  EXPECT_GT(in_fog, 0.4 * clear) << "at 2 m, 0.05^(2/10) = 0.55 of the contrast is left";
  EXPECT_LT(in_fog, 0.7 * clear);
}

TEST(Fog, TakesContrastWithDistanceButNotInTheRoom) {
  Scenario scenario;
  const auto contrast = [&](double distance_m) {
    const Scene scene = buildScene(scenario);
    const double frame = views::greyAt(scene, {-distance_m, 0, 0}, {0, 0.635, 0});
    const double wall = views::greyAt(scene, {-distance_m, 0, 0}, {0.02, 0.85, 0});
    return std::abs(frame - wall);
  };
  const double clear = contrast(4.0);
  scenario.house.daylight.fog_m = 10.0;
  EXPECT_NEAR(contrast(4.0) / clear, std::exp(std::log(0.05) * 0.4), 0.04);
  EXPECT_NEAR(contrast(1.5) / clear, std::exp(std::log(0.05) * 0.15), 0.04);
  const double inside = views::greyAt(buildScene(scenario), {-0.5, 0, 0}, {5.2, -0.5, 0.3});
  EXPECT_LT(inside, 100.0) << "five metres of room would be white";
}

}  // namespace window_ingress::simulation::scene_light_test
