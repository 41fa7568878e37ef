/// Clear panes: how much they reflect, where reflections seem to stand, and that they are solid.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../view.hpp"
#include "simulation/scene/glazing.hpp"
#include "simulation/scene/scene.hpp"
#include "simulation/world.hpp"

namespace window_ingress::simulation::glass_test {

using Eigen::Vector3d;

constexpr double kPane_m = 0.09;  // behind the front of a frame of 0.02 m

Scenario glazed(const std::string& closed_by = "glass") {
  Scenario scenario;
  scenario.window.closed_by = closed_by;
  return scenario;
}

Scenario glazedBeforeBlackRoom() {
  Scenario scenario = glazed();
  scenario.house.room_light = scenario.house.daylight.sun = 0.0;
  scenario.window.reveal = {0, 0, 0};
  return scenario;
}

// Fresnel's law in terms of the angles of incidence and refraction.
double byAngles(double incidence) {
  const double within = std::asin(std::sin(incidence) / 1.52);
  const double across = std::pow(std::sin(incidence - within) / std::sin(incidence + within), 2);
  const double along = std::pow(std::tan(incidence - within) / std::tan(incidence + within), 2);
  return across / (1.0 + across) + along / (1.0 + along);
}

TEST(PaneReflectance, FollowsFresnelForTwoFaces) {
  for (double incidence = 0.05; incidence < 1.5; incidence += 0.05)
    EXPECT_NEAR(paneReflectance(std::cos(incidence)), byAngles(incidence), 1e-9) << incidence;
  EXPECT_NEAR(paneReflectance(1.0), 0.082, 1e-3) << "4 % a face";
  EXPECT_EQ(paneReflectance(0.0), 1.0);
}

TEST(MirrorAt, ExchangesFrontAndBack) {
  const Vector3d point(-3.0, 0.4, 1.2);
  EXPECT_TRUE((mirrorAt(kPane_m) * point).isApprox(Vector3d(3.0 + 2 * kPane_m, 0.4, 1.2)));
  EXPECT_TRUE((mirrorAt(kPane_m) * mirrorAt(kPane_m)).isApprox(Eigen::Isometry3d::Identity()));
  EXPECT_TRUE(mirrorAt(kPane_m).inverse().isApprox(mirrorAt(kPane_m)));
}

// A pane adds its reflection, and removes the same share of the room's light.
TEST(ClearPane, ShowsTheRoomLessWhatItMirrors) {
  Scenario scenario;
  scenario.house.room_light = 1.0;
  const Scene open = buildScene(scenario);
  scenario.window.closed_by = "glass";
  const Scene closed = buildScene(scenario);
  for (const double y_m : {0.0, 2.0, 5.0}) {
    const Vector3d from(-2.0, y_m, 0.0), at(kPane_m, 0.0, 0.0), sight = (at - from).normalized();
    const Vector3d back(-sight.x(), sight.y(), sight.z());
    const double part = paneReflectance(sight.x());
    const double room = views::greyAt(open, from, at), garden = views::greyAt(open, at, at + back);
    EXPECT_NEAR(views::greyAt(closed, from, at), (1.0 - part) * room + part * garden, 2.0) << y_m;
    EXPECT_GT(part * std::abs(garden - room), 2.5) << "else this shows nothing, " << y_m;
  }
}

TEST(ClearPane, MirrorsMoreOfTheSkyAtASlant) {
  Scenario scenario = glazedBeforeBlackRoom();
  scenario.house.room = {0, 0, 0};
  scenario.house.furniture = "none";
  const Scene scene = buildScene(scenario);
  double before = 0.0;
  for (const double y_m : {0.0, 3.0, 5.0}) {
    const Vector3d from(-2.0, y_m, -1.2);  // from below, so that it reflects the sky
    const double grey = views::greyAt(scene, from, {kPane_m, 0, 0.3});
    EXPECT_GT(grey, before + 3.0) << y_m;
    before = grey;
  }
}

// A red post in front of the house, visible only as a reflection: at its virtual image behind the pane.
cv::Point2d mirroredPost(const Vector3d& post, const Vector3d& from) {
  Scenario scenario = glazedBeforeBlackRoom();
  Scene scene = buildScene(scenario);
  const auto pose = views::lookAt(from, {kPane_m, 0, 0});
  const cv::Mat without = views::photograph(scene, pose);
  scene.mesh.setLighting({Vector3d::UnitZ(), 0.0, 1.0});
  scene.mesh.addBox({post - Vector3d(0.1, 0.1, 0.1), post + Vector3d(0.1, 0.1, 0.1)},
                    {Texture::kPlain, Vector3d(255, 0, 255)});
  const cv::Mat with = views::photograph(scene, pose);
  cv::Mat difference, grey;
  cv::absdiff(with, without, difference);
  cv::cvtColor(difference, grey, cv::COLOR_BGR2GRAY);
  const cv::Moments moments = cv::moments(grey > 2, true);
  EXPECT_GT(moments.m00, 10.0) << "it is mirrored";
  return {moments.m10 / moments.m00, moments.m01 / moments.m00};
}

TEST(ClearPane, MirrorsThingsWhereTheirVirtualImageStandsAsTheCameraMoves) {
  const Vector3d post(-7.0, 0.6, 0.3);
  const auto camera = geometry::PinholeCamera::fromFieldOfView(320, 240, 1.0);
  for (const Vector3d& from : {Vector3d(-2.0, 0.0, 0.0), {-2.0, -0.5, 0.1}, {-1.2, 0.4, -0.1}, {-4, 0, 0}}) {
    const Vector3d image(2.0 * kPane_m - post.x(), post.y(), post.z());
    const auto expected = camera.project(views::lookAt(from, {kPane_m, 0, 0}) * image);
    ASSERT_TRUE(expected);
    const cv::Point2d seen = mirroredPost(post, from);
    EXPECT_NEAR(seen.x, expected->x(), 1.0) << from.transpose();
    EXPECT_NEAR(seen.y, expected->y(), 1.0) << from.transpose();
  }
}

TEST(ClearPane, ChangesNothingOutsideOfItself) {
  const auto pose = views::lookAt({-3.0, 1.0, 0.0}, {0, 0, 0});
  const auto camera = geometry::PinholeCamera::fromFieldOfView(320, 240, 1.0);
  const cv::Mat open = views::photograph(buildScene(Scenario()), pose);
  cv::Mat difference, changed;
  cv::absdiff(open, views::photograph(buildScene(glazed()), pose), difference);
  cv::cvtColor(difference, changed, cv::COLOR_BGR2GRAY);
  ASSERT_GT(cv::countNonZero(changed > 2), 500);
  double left_px = 1e9, right_px = -1e9;
  for (const double y_m : {0.6, -0.6}) {
    const auto corner = camera.project(pose * Vector3d(kPane_m, y_m, 0.0));
    left_px = std::min(left_px, corner->x()), right_px = std::max(right_px, corner->x());
  }
  for (int u = 0; u < changed.cols; ++u) {
    if (u > left_px - 1.5 && u < right_px + 1.5) continue;
    ASSERT_EQ(cv::countNonZero(changed.col(u)), 0) << "column " << u;
  }
}

TEST(ClearPane, LooksTheSameMultisampledInRowsAndInFog) {
  Scenario scenario = glazed();
  scenario.decoys.emplace_back().closed_by = "glass";
  scenario.house.daylight.fog_m = 30.0;
  const Scene scene = buildScene(scenario);
  const auto camera = geometry::PinholeCamera::fromFieldOfView(320, 240, 1.2);
  const auto pose = views::lookAt({-2.5, 1.5, 0.0}, {0, 1.0, 0});
  cv::Mat whole, rows(240, 320, CV_8UC3), fine;
  Renderer renderer(scene, camera);
  renderer.render(pose, whole);
  for (int first = 0; first < 240; first += 60) renderer.renderRows(pose, {first, first + 60}, rows);
  EXPECT_LT(cv::norm(whole, rows, cv::NORM_L1) / (3.0 * static_cast<double>(whole.total())), 0.05);
  Renderer(scene, camera, Antialiasing::kMultisampling).render(pose, fine);
  EXPECT_LT(cv::norm(whole, fine, cv::NORM_L1) / (3.0 * static_cast<double>(whole.total())), 0.8);
}

TEST(ClearPane, DirtIsSeenOnItAndMovesWithIt) {
  Scenario dirty = glazed();
  dirty.window.dirt = 0.1;
  EXPECT_TRUE(faultsOf(dirty).empty());
  for (const double y_m : {-1.0, 0.0, 1.5}) {
    const auto pose = views::lookAt({-1.5, y_m, 0.0}, {0, 0, 0});
    cv::Mat difference, grey;
    cv::absdiff(views::photograph(buildScene(dirty), pose), views::photograph(buildScene(glazed()), pose),
                difference);
    cv::cvtColor(difference, grey, cv::COLOR_BGR2GRAY);
    const auto camera = geometry::PinholeCamera::fromFieldOfView(320, 240, 1.0);
    std::vector<cv::Point> corners;
    for (const auto& [y, z] : {std::pair(0.6, 0.5), {-0.6, 0.5}, {-0.6, -0.5}, {0.6, -0.5}}) {
      const auto corner = camera.project(pose * Vector3d(kPane_m, y, z));
      corners.emplace_back(static_cast<int>(corner->x()), static_cast<int>(corner->y()));
    }
    const double part = cv::countNonZero(grey > 12) / cv::contourArea(corners);
    EXPECT_GT(part, 0.05) << y_m;
    EXPECT_LT(part, 0.3) << y_m;
  }
  dirty.window.closed_by = "none";
  EXPECT_EQ(faultsOf(dirty),
            std::vector<std::string>{"window/dirt: only glass can be dirty; set closed_by: glass"});
}

TEST(ClearPane, IsSolidThoughTheRoomIsSeenThroughIt) {
  const Scene scene = buildScene(glazed());
  ASSERT_EQ(scene.panes.size(), 1u);
  EXPECT_DOUBLE_EQ(scene.panes[0].x_m, kPane_m);
  const auto touched = [&](double x_m) {
    for (const auto& obstacle : scene.obstacles)
      if (obstacle.box.exteriorDistance(Vector3d(x_m, 0.1, 0.1)) < 0.01) return obstacle.name;
    return std::string();
  };
  EXPECT_EQ(touched(kPane_m), "glass");
  EXPECT_EQ(touched(kPane_m - 0.05), "");
  EXPECT_FALSE(glazed().window.isOpen());
  const double open = views::greyAt(buildScene(Scenario()), {-2, 0, 0}, {3, 0.3, 0.2}),
               closed = views::greyAt(scene, {-2, 0, 0}, {3, 0.3, 0.2});
  EXPECT_NEAR(closed, open, 0.15 * open + 20.0);
}

}  // namespace window_ingress::simulation::glass_test
