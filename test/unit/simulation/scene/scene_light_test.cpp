#include <gtest/gtest.h>

#include <cmath>
#include <vector>

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

// The vertices of a unit square that the sun lights within the half space only.
std::vector<Vertex> squareCutBy(const HalfSpace& half) {
  Lighting light{Vector3d::UnitZ(), 0.5, 0.25};
  light.region = {half};
  Mesh mesh(light);
  mesh.addPolygon({{{0, 0, 0}, {0, 0}}, {{1, 0, 0}, {1, 0}}, {{1, 1, 0}, {1, 1}}, {{0, 1, 0}, {0, 1}}}, {});
  return mesh.batches().begin()->second;
}

Vector3d positionOf(const Vertex& vertex) {
  return {vertex.position[0], vertex.position[1], vertex.position[2]};
}

bool isLit(const Vertex& vertex) { return vertex.colour[0] > 100; }

double areaOf(const std::vector<Vertex>& vertices) {
  double sum = 0.0;
  for (std::size_t i = 0; i < vertices.size(); i += 4) {
    const Vector3d origin = positionOf(vertices[i]), across = positionOf(vertices[i + 2]) - origin;
    const Vector3d a = positionOf(vertices[i + 1]) - origin, b = positionOf(vertices[i + 3]) - origin;
    sum += 0.5 * (a.cross(across) + across.cross(b)).norm();
  }
  return sum;
}

TEST(Split, PartsHaveTheAreaOfTheWholeAndLieOnTheirSides) {
  for (int i = 0; i < 200; ++i) {
    const double angle = 0.05 * i, offset = -0.5 + 0.01 * i;
    const HalfSpace half{{std::cos(angle), std::sin(angle), 0}, offset};
    const auto vertices = squareCutBy(half);
    EXPECT_NEAR(areaOf(vertices), 1.0, 1e-6) << i;
    for (const auto& vertex : vertices) {
      EXPECT_LE(half.beyond(positionOf(vertex)) * (isLit(vertex) ? 1.0 : -1.0), 1e-6) << i;
      EXPECT_NEAR(vertex.uv[0], vertex.position[0], 1e-6);
      EXPECT_NEAR(vertex.uv[1], vertex.position[1], 1e-6);
    }
  }
  for (const double border : {0.0, 1.0}) {
    const auto vertices = squareCutBy({Vector3d::UnitX(), border});
    EXPECT_EQ(vertices.size(), 4u) << "a border is no area";
    EXPECT_EQ(isLit(vertices.front()), border > 0.5);
  }
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
