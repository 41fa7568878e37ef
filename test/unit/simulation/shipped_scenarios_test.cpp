#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "simulation/camera/reference_image.hpp"
#include "simulation/scenario/scenario.hpp"
#include "simulation/world.hpp"
#include "view.hpp"
#include "window_ingress/geometry/opening.hpp"

namespace window_ingress::simulation::shipped_scenarios_test {

const std::string kFolder = std::string(WINDOW_INGRESS_SOURCE_DIR) + "/config/scenarios/";

std::vector<std::string> shippedNames() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(kFolder))
    names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

Scenario load(const std::string& name, std::uint32_t seed) {
  return loadScenario(kFolder + name + ".yaml", seed);
}

// The camera's image from the start, but facing the window.
cv::Mat firstImage(Scenario scenario, std::uint32_t seed) {
  scenario.start.heading_rad = 0.0;
  scenario.camera.width_px = 160;
  scenario.camera.height_px = 120;
  World world(scenario, seed);
  while (true) {
    world.advance();
    if (const auto frame = world.takeFrame()) return frame->image.clone();
  }
}

// Part of a rendered image of the scene, facing the wall, without the sensor model.
double brightness(const Scenario& scenario, double y_m, double z_m) {
  const cv::Mat image = views::photograph(buildScene(scenario), views::lookAt({-3, 0, 0}, {0, 0, 0}));
  const auto camera = geometry::PinholeCamera::fromFieldOfView(320, 240, 1.0);
  const int u = static_cast<int>(camera.cx - camera.fx * y_m / 3.0);
  const int v = static_cast<int>(camera.cy - camera.fy * z_m / 3.0);
  return views::grey(image(cv::Rect(u - 12, v - 12, 24, 24)));
}

TEST(ShippedScenarios, LoadForSeedsUpTo200) {
  EXPECT_GE(shippedNames().size(), 18u);
  for (const auto& name : shippedNames())
    for (std::uint32_t seed = 1; seed <= 200; seed += 4)
      EXPECT_NO_THROW(load(name, seed)) << name << " " << seed;
}

TEST(ShippedScenarios, BeginWithACommentOnWhatTheyAreForAndStandInTheDocumentation) {
  std::ifstream page(std::string(WINDOW_INGRESS_SOURCE_DIR) + "/doc/scenarios.md");
  const std::string text((std::istreambuf_iterator<char>(page)), {});
  for (const auto& name : shippedNames()) {
    std::ifstream file(kFolder + name + ".yaml");
    std::string first, second;
    std::getline(file, first);
    std::getline(file, second);
    EXPECT_EQ(first.substr(0, 2), "# ") << name;
    EXPECT_EQ(text.find("| `" + name + ".yaml` |") == std::string::npos, false) << name;
  }
}

TEST(ShippedScenarios, AreImagesNeitherBlackNorSaturated) {
  for (const auto& name : shippedNames()) {
    const cv::Mat image = firstImage(load(name, 3), 3);
    cv::Mat grey;
    cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
    EXPECT_GT(cv::mean(grey)[0], 22.0) << name;
    EXPECT_LT(cv::mean(grey)[0], 215.0) << name;
    EXPECT_LT(cv::countNonZero(grey > 252), 0.05 * static_cast<double>(grey.total())) << name;
    cv::Scalar mean, spread;
    cv::meanStdDev(grey, mean, spread);
    EXPECT_GT(spread[0], 6.0) << name;
  }
}

TEST(ShippedScenarios, LowContrastHasRoomAndWallAlike) {
  double difference = 0.0;
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    const Scenario scenario = load("low_contrast", seed);
    const double one = brightness(scenario, 0.0, 0.0) - brightness(scenario, 1.0, 0.0);
    EXPECT_NEAR(one, 0.0, 10.0) << "the plaster's own spots, seed " << seed;
    difference += one / 4.0;
  }
  EXPECT_NEAR(difference, 0.0, 5.0);
  EXPECT_GT(brightness(Scenario(), 1.0, 0.0), brightness(Scenario(), -0.3, 0.0) + 40.0);
}

TEST(ShippedScenarios, BacklitIsBrighterInsideThanTheWall) {
  for (std::uint32_t seed = 1; seed <= 2; ++seed) {
    const Scenario scenario = load("backlit", seed);
    EXPECT_GT(brightness(scenario, 0.0, 0.0), brightness(scenario, 1.0, 0.0) + 50.0) << seed;
    EXPECT_GT(brightness(scenario, -0.45, -0.35), brightness(scenario, 1.0, 0.0) + 20.0) << "the room itself";
  }
}

TEST(ShippedScenarios, ThePosterShowsWhatTheReferenceImageShows) {
  const Scenario scenario = load("poster_only", 1);
  ASSERT_FALSE(scenario.window.present);
  geometry::Quadrilateral corners;
  const cv::Mat reference = referenceImage(scenario, &corners);
  const auto camera = scenario.camera.model();
  const double distance_m = camera.fx * scenario.window.width_m / (corners[1].x() - corners[0].x());
  cv::Mat poster;
  Renderer(buildScene(scenario), camera).render(views::lookAt({-distance_m, 0, 0}, {0, 0, 0}), poster);
  const cv::Point first(static_cast<int>(corners[0].x()) - 12, static_cast<int>(corners[0].y()) - 12);
  const cv::Point last(static_cast<int>(corners[2].x()) + 12, static_cast<int>(corners[2].y()) + 12);
  const cv::Rect part(first, last);
  const double difference = cv::norm(reference(part), poster(part), cv::NORM_L1) / (3.0 * part.area());
  EXPECT_LT(difference, 18.0);
  Scenario closed = scenario;
  closed.posters.clear();
  Renderer(buildScene(closed), camera).render(views::lookAt({-distance_m, 0, 0}, {0, 0, 0}), poster);
  EXPECT_GT(cv::norm(reference(part), poster(part), cv::NORM_L1) / (3.0 * part.area()), 2.0 * difference);
}

TEST(ShippedScenarios, TheReferenceShowsTheOpenTargetWhateverIsThereByNow) {
  const Scenario open = load("nominal", 4);
  const cv::Mat expected = referenceImage(open, nullptr);
  Scenario absent = open, closed = open, foggy = open;
  absent.window.present = false;
  closed.window.closed_by = "board";
  foggy.house.daylight.fog_m = 8.0;
  for (const Scenario& scenario : {absent, closed, foggy})
    EXPECT_EQ(cv::norm(expected, referenceImage(scenario, nullptr), cv::NORM_INF), 0.0);
}

}  // namespace window_ingress::simulation::shipped_scenarios_test
