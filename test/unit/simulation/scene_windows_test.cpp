#include <gtest/gtest.h>

#include "edge_fit.hpp"
#include "simulation/random_stream.hpp"
#include "simulation/scene/scene.hpp"
#include "simulation/world.hpp"
#include "view.hpp"
#include "window_ingress/geometry/opening.hpp"

namespace window_ingress::simulation::scene_windows_test {

using Eigen::Vector3d;

std::string touchedBy(const Scene& scene, const Vector3d& position, const Vector3d& half_extents) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = position;
  for (const auto& obstacle : scene.obstacles)
    if (touches(pose, half_extents, obstacle.box)) return obstacle.name;
  return "";
}

Scenario manyWindows() {
  Scenario scenario;
  scenario.house.furniture = "full";
  scenario.window.surround = "sill";
  scenario.decoys.resize(3);
  scenario.decoys[0].closed_by = "none";
  scenario.decoys[0].y_m = 2.0;
  scenario.decoys[1].y_m = -2.0;
  scenario.decoys[1].bars = "cross";
  scenario.decoys[2].y_m = 4.2;
  scenario.decoys[2].closed_by = "shutter";
  scenario.doors.emplace_back();
  return scenario;
}

// Sheets that only a gap would reveal: within the wall, and behind the house.
Scene withSheets(Scene scene, const Scenario& scenario, const Vector3d& colour) {
  scene.mesh.setLighting({Vector3d::UnitZ(), 0.0, 1.0});
  const double within_m = 0.5 * (scenario.window.wallFront() + scene.opening_depth_m);
  const double bottom_m = scene.ground_z_m + 0.02;
  for (const auto& [right_m, left_m] : {std::pair(-1.4, -0.65), {0.65, 1.4}})
    scene.mesh.addQuad({within_m, left_m, bottom_m}, {0, right_m - left_m, 0}, {0, 0, 3.0},
                       {Texture::kPlain, colour});
  scene.mesh.addQuad({30, 60, -40}, {0, -120, 0}, {0, 0, 80}, {Texture::kPlain, colour});
  scene.mesh.addQuad({-1, -60, -40}, {60, 0, 0}, {0, 0, 80}, {Texture::kPlain, colour});
  return scene;
}

TEST(SceneIsClosed, NothingShinesThroughWallFrameRevealOrRoom) {
  RandomStream random(3, "views");
  for (int view = 0; view < 9; ++view) {
    Scenario scenario = manyWindows();
    scenario.window.frame_width_m = view % 3 == 0 ? 0.0 : 0.07;
    scenario.house.daylight.sun_azimuth_rad = random.uniform(-1.2, 1.2);
    scenario.house.daylight.sun_elevation_rad = random.uniform(0.2, 1.2);
    const double distance_m = random.uniform(0.5, 2.0), bearing_rad = random.uniform(-0.5, 0.5);
    const Vector3d from(-distance_m * std::cos(bearing_rad), distance_m * std::sin(bearing_rad),
                        random.uniform(-0.3, 0.3));
    const auto pose = views::lookAt(from, {0.1, 0, 0});
    const Scene scene = buildScene(scenario);
    const cv::Mat green = views::photograph(withSheets(scene, scenario, {0, 255, 0}), pose, 0.9);
    const cv::Mat magenta = views::photograph(withSheets(scene, scenario, {255, 0, 255}), pose, 0.9);
    EXPECT_EQ(cv::norm(green, magenta, cv::NORM_INF), 0.0) << "view " << view;
  }
}

TEST(SceneIsClosed, TheSheetsWouldBeSeenThroughAHole) {
  Scenario scenario = manyWindows();
  const auto pose = views::lookAt({-1.5, 0, 0}, {0, 0, 0});
  Scene empty = buildScene(scenario);
  empty.mesh = Mesh(Lighting{});
  const cv::Mat image = views::photograph(withSheets(empty, scenario, {0, 255, 0}), pose);
  EXPECT_EQ(image.at<cv::Vec3b>(10, 10), cv::Vec3b(0, 255, 0));
}

TEST(BareHole, IsFreeUpToItsBordersInThePlaneOfTheWall) {
  Scenario scenario;
  scenario.window.frame_width_m = 0.0;
  scenario.window.frame_depth_m = 0.05;
  const Scene scene = buildScene(scenario);
  EXPECT_DOUBLE_EQ(scene.opening_depth_m, scenario.house.wall_thickness_m);
  const Vector3d plug(0.1, 0.5 * scenario.window.width_m - 1e-6, 0.5 * scenario.window.height_m - 1e-6);
  for (double x = -2.0; x < 2.0; x += 0.05) EXPECT_EQ(touchedBy(scene, {x, 0, 0}, plug), "") << x;
  for (const Vector3d& aside :
       {Vector3d(0.1, 0.001, 0), Vector3d(0.1, -0.001, 0), Vector3d(0.1, 0, 0.001), Vector3d(0.1, 0, -0.001)})
    EXPECT_EQ(touchedBy(scene, aside, plug), "wall");
  EXPECT_EQ(touchedBy(scene, {-0.101, 0.3, 0}, plug), "") << "the wall begins at x = 0, not before";
  EXPECT_EQ(touchedBy(scene, {-0.099, 0.3, 0}, plug), "wall");
}

TEST(BareHole, IsSeenWhereTheOpeningIsTold) {
  Scenario scenario;
  scenario.window.frame_width_m = 0.0;
  scenario.window.reveal = {0, 0, 0};
  scenario.house.wall = {255, 255, 255};
  scenario.house.wall_texture = "paint";
  scenario.house.room_light = scenario.house.daylight.sun = 0.0;
  scenario.house.daylight.ambient = 0.9;
  const Scene scene = buildScene(scenario);
  const auto camera = geometry::PinholeCamera::fromFieldOfView(640, 480, 1.2);
  Renderer renderer(scene, camera);
  for (const double y_m : {-1.5, 0.0, 1.2}) {
    const auto pose = views::lookAt({-3.0, y_m, 0.3}, {0, 0, 0});
    cv::Mat image, grey;
    renderer.render(pose, image);
    cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
    const auto expected = geometry::projectOpening(camera, pose, scenario.opening());
    const auto measured = test::fitCorners(grey, *expected, 5, [](const Eigen::Vector2d& p) { return p; });
    ASSERT_TRUE(measured) << y_m;
    for (int i = 0; i < 4; ++i) EXPECT_LT(((*measured)[i] - (*expected)[i]).norm(), 0.12) << y_m << " " << i;
  }
}

TEST(ClosedWindow, IsSolidButItsPoseIsTold) {
  for (const char* closed_by : {"glass", "tinted_glass", "curtain", "blinds", "shutter", "board"}) {
    Scenario scenario;
    scenario.window.closed_by = closed_by;
    const Scene scene = buildScene(scenario);
    EXPECT_EQ(touchedBy(scene, {0.1, 0, 0}, {0.1, 0.1, 0.1}), closed_by);
    EXPECT_EQ(touchedBy(scene, {-0.15, 0, 0}, {0.1, 0.1, 0.1}), "") << "nothing stands before the frame";
    ASSERT_TRUE(scene.opening);
    EXPECT_DOUBLE_EQ(scene.opening->width_m, scenario.window.width_m);
  }
}

TEST(ClosedWindow, AFlightIntoItIsACollisionWithWhatClosesIt) {
  Scenario scenario;
  scenario.start.distance_m = 1.5;
  scenario.camera.width_px = 64;
  scenario.camera.height_px = 48;
  scenario.window.closed_by = "glass";
  World world(scenario, 1);
  while (world.timeSec() < 8.0 && world.referee().judge(Claim::kNone).outcome == Outcome::kRunning) {
    world.command({world.T_odom_window().linear() * Vector3d(0.8, 0, 0), 0.0});
    world.advance();
  }
  const Verdict verdict = world.referee().judge(Claim::kPassed);
  EXPECT_EQ(verdict.outcome, Outcome::kCollision) << verdict.reason;
  EXPECT_EQ(verdict.reason.rfind("touched glass at", 0), 0u) << verdict.reason;
}

TEST(OpenDecoy, IsAWayThroughTheWallAndTheOthersAreNot) {
  const Scenario scenario = manyWindows();
  const Scene scene = buildScene(scenario);
  const Vector3d small(0.1, 0.1, 0.1);
  for (double x = -1.0; x < 1.5; x += 0.1) EXPECT_EQ(touchedBy(scene, {x, 2.0, 0}, small), "") << x;
  EXPECT_EQ(touchedBy(scene, {0.1, -2.0, 0}, small), "wall");
  EXPECT_EQ(touchedBy(scene, {0.0, -3.5, -0.5}, {0.05, 0.1, 0.1}), "wall");
  EXPECT_TRUE(scene.other_clear_holes);
}

TEST(Scene, WaysThroughTheTargetStayFreeOfSurroundAndFurniture) {
  for (const char* surround : {"none", "sill", "shutters", "lintel"}) {
    Scenario scenario;
    scenario.window.surround = surround;
    scenario.house.furniture = "full";
    const Scene scene = buildScene(scenario);
    const Vector3d plug(0.1, 0.5 * scenario.window.width_m - 1e-6, 0.5 * scenario.window.height_m - 1e-6);
    for (double x = -2.0; x < 2.5; x += 0.05) EXPECT_EQ(touchedBy(scene, {x, 0, 0}, plug), "") << surround;
  }
}

TEST(Scenario, RefusesWindowsThatCoverEachOther) {
  Scenario scenario;
  scenario.posters.emplace_back().y_m = 0.5;
  EXPECT_EQ(faultsOf(scenario), std::vector<std::string>{"posters[0]: overlaps the window"});
  scenario.window.present = false;
  EXPECT_TRUE(faultsOf(scenario).empty());
  scenario = Scenario();
  scenario.decoys.resize(2);
  EXPECT_EQ(faultsOf(scenario), std::vector<std::string>{"decoys[1]: overlaps decoys[0]"});
  scenario.decoys.resize(1);
  scenario.decoys[0].closed_by = "none";
  scenario.decoys[0].y_m = 5.2;
  EXPECT_EQ(faultsOf(scenario).size(), 1u);
  scenario = Scenario();
  scenario.window.bars = "cross";
  EXPECT_EQ(faultsOf(scenario).size(), 1u);
}

}  // namespace window_ingress::simulation::scene_windows_test
