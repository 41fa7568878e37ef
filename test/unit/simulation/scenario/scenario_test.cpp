#include "simulation/scenario/scenario.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

#include "refusal.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::simulation::scenario_test {

const std::string kSource = WINDOW_INGRESS_SOURCE_DIR;

class ScenarioFile : public testing::Test {
 protected:
  test::TemporaryFolder folder_;
  const std::string file_ = folder_.path / "scenario.yaml";

  Scenario read(const std::string& text, std::uint32_t seed = 1) {
    return loadScenario(folder_.write("scenario.yaml", text), seed);
  }
  std::string error(const std::string& text) {
    return test::refusalOf([&] { read(text); });
  }
};

TEST_F(ScenarioFile, ReadsNumbersGroupsAndLists) {
  const Scenario scenario = read(
      "time_limit_sec: 12\nstart: {off_axis_rad: 0.2, hovering: false}\nwindow: {frame: {r: 9}}\n"
      "decoys:\n  - {y_m: 3}\n  - {y_m: -3, frame: {g: 7}}\n");
  EXPECT_DOUBLE_EQ(scenario.time_limit_sec, 12.0);
  EXPECT_DOUBLE_EQ(scenario.start.off_axis_rad, 0.2);
  EXPECT_FALSE(scenario.start.hovering);
  EXPECT_EQ(scenario.window.frame.r, 9);
  EXPECT_EQ(scenario.window.frame.g, WindowParams().frame.g);
  ASSERT_EQ(scenario.decoys.size(), 2u);
  EXPECT_EQ(scenario.decoys[1].frame.g, 7);
  EXPECT_DOUBLE_EQ(scenario.start.distance_m, StartParams().distance_m);
}

TEST_F(ScenarioFile, DrawsRangesFromTheSeedEachKeyForItself) {
  const std::string one = "start: {off_axis_rad: [-0.5, 0.5]}\n";
  const std::string two =
      "camera: {noise_grey: [1, 3]}\nstart: {distance_m: [3, 5], off_axis_rad: [-0.5, 0.5]}\n";
  double least = 1.0, most = -1.0;
  std::set<double> values;
  for (std::uint32_t seed = 0; seed < 300; ++seed) {
    const double drawn = read(one, seed).start.off_axis_rad;
    EXPECT_DOUBLE_EQ(drawn, read(two, seed).start.off_axis_rad) << "another range must not change it";
    least = std::min(least, drawn);
    most = std::max(most, drawn);
    values.insert(drawn);
  }
  EXPECT_GE(least, -0.5);
  EXPECT_LE(most, 0.5);
  EXPECT_LT(least, -0.47);
  EXPECT_GT(most, 0.47);
  EXPECT_EQ(values.size(), 300u);
}

TEST_F(ScenarioFile, AValueMayBeAskedForByItsPlaceInTheRange) {
  folder_.write("scenario.yaml",
                "start: {distance_m: [3, 5], off_axis_rad: [-0.5, 0.5]}\nhouse: {texture_seed: [1, 10]}\n"
                "faults:\n  one_of:\n    - []\n    - [{unit: odom, kind: slide, slide_mps: [0, 2]}]\n");
  const Scenario drawn = loadScenario(file_, 7);
  for (const double quantile : {0.0, 0.25, 1.0}) {
    const Scenario asked = loadScenario(file_, 7,
                                        {{"start/distance_m", quantile},
                                         {"house/texture_seed", quantile},
                                         {"faults", 1.0},
                                         {"faults[0]/slide_mps", quantile}});
    EXPECT_DOUBLE_EQ(asked.start.distance_m, 3.0 + 2.0 * quantile);
    EXPECT_EQ(asked.house.texture_seed, quantile == 0.0 ? 1 : quantile == 1.0 ? 10 : 3);
    ASSERT_EQ(asked.faults.size(), 1u);
    EXPECT_DOUBLE_EQ(asked.faults[0].slide_mps, 2.0 * quantile);
    EXPECT_EQ(asked.start.off_axis_rad, drawn.start.off_axis_rad) << "what is not asked for is drawn as ever";
  }
  EXPECT_TRUE(test::says(test::refusalOf([&] {
                           loadScenario(file_, 7, {{"start/distance", 0.5}});
                         }),
                         "start/distance: has no range to draw from"));
  EXPECT_TRUE(test::says(test::refusalOf([&] {
                           loadScenario(file_, 7, {{"faults[0]/kind", 0.5}});
                         }),
                         "faults[0]/kind: has no range to draw from"));
}

TEST(Scenario, TheVehicleMayBeToldOfAnotherMounting) {
  CameraParams camera;
  EXPECT_EQ(camera.toldT_base_camera().matrix(), camera.T_base_camera().matrix());
  camera.told_yaw_error_rad = 0.02;
  camera.told_pitch_error_rad = -0.01;
  const Eigen::AngleAxisd turn(camera.T_base_camera().linear() *
                               camera.toldT_base_camera().linear().transpose());
  EXPECT_NEAR(turn.angle(), std::hypot(0.02, 0.01), 1e-4);
}

TEST_F(ScenarioFile, DrawsWholeNumbersWithBothEnds) {
  std::set<int> values;
  for (std::uint32_t seed = 0; seed < 60; ++seed)
    values.insert(read("window: {frame: {r: [3, 5]}}", seed).window.frame.r);
  EXPECT_EQ(values, (std::set<int>{3, 4, 5}));
}

TEST_F(ScenarioFile, DrawsOneOfSeveralValuesOfAnyKind) {
  const std::string text =
      "start: {distance_m: {one_of: [3, [5, 6]]}, hovering: {one_of: [true, false]}}\n"
      "house: {wall_texture: {one_of: [plaster, brick]}}\n"
      "posters: {one_of: [[], [{y_m: 2}]]}\n"
      "window: {frame: {one_of: [{r: 1}, {r: 2}]}}\n";
  std::set<std::string> textures;
  std::set<std::size_t> posters;
  std::set<int> reds;
  std::set<bool> hovering;
  bool fixed = false, ranged = false;
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    const Scenario scenario = read(text, seed);
    fixed = fixed || scenario.start.distance_m == 3.0;
    ranged = ranged || (scenario.start.distance_m > 5.0 && scenario.start.distance_m < 6.0);
    textures.insert(scenario.house.wall_texture);
    posters.insert(scenario.posters.size());
    reds.insert(scenario.window.frame.r);
    hovering.insert(scenario.start.hovering);
  }
  EXPECT_TRUE(fixed && ranged);
  EXPECT_EQ(textures, (std::set<std::string>{"plaster", "brick"}));
  EXPECT_EQ(posters, (std::set<std::size_t>{0, 1}));
  EXPECT_EQ(reds, (std::set<int>{1, 2}));
  EXPECT_EQ(hovering.size(), 2u);
}

TEST_F(ScenarioFile, ABadOptionIsAnErrorWhateverTheSeed) {
  for (std::uint32_t seed = 0; seed < 8; ++seed)
    for (const char* text :
         {"start: {distance_m: {one_of: [3, 500]}}", "start: {one_of: [{distance_m: 3}, {distanse_m: 4}]}",
          "decoys: {one_of: [[], [{y_m: 3, colour: 1}]]}", "vehicle: {one_of: [crisp, zeppelin]}"})
      EXPECT_THROW(read(text, seed), InputError) << text;
  EXPECT_TRUE(test::says(error("start: {distance_m: {one_of: []}}"), "at least one value"));
  EXPECT_TRUE(test::says(error("start: {distance_m: {one_of: 3}}"), "at least one value"));
}

TEST_F(ScenarioFile, ReadsFaultsAndDrawsThem) {
  const std::string text =
      "faults:\n  - {unit: {one_of: [odom, imu]}, kind: off, at_sec: [2, 9]}\n  - {unit: cmd_vel, kind: "
      "stuck}\n";
  std::set<std::string> units;
  std::set<double> times;
  for (std::uint32_t seed = 0; seed < 30; ++seed) {
    const Scenario scenario = read(text, seed);
    ASSERT_EQ(scenario.faults.size(), 2u);
    EXPECT_EQ(scenario.faults[0].kind, "off");
    units.insert(scenario.faults[0].unit);
    times.insert(scenario.faults[0].at_sec);
  }
  EXPECT_EQ(units.size(), 2u);
  EXPECT_EQ(times.size(), 30u);
  EXPECT_TRUE(test::says(error("faults: [{unit: clock, kind: garbage}]"), "clock garbage"));
}

TEST_F(ScenarioFile, AVehicleMayBeNamedByItsProfileAlone) {
  EXPECT_EQ(read("vehicle: external", 1).vehicle.profile, "external");
  EXPECT_TRUE(test::says(error("vehicle: zeppelin"), "profile = zeppelin is not one of default"));
  std::set<std::string> profiles;
  for (std::uint32_t seed = 0; seed < 30; ++seed)
    profiles.insert(read("vehicle: {one_of: [crisp, {mass_kg: 2}]}", seed).vehicle.profile);
  EXPECT_EQ(profiles, (std::set<std::string>{"crisp", "default"}));
}

// It would be a collision before the flight begins.
TEST_F(ScenarioFile, AStartInTheRoofIsRefusedByName) {
  const std::string house = "house: {eaves_m: 2.5}\nwindow: {sill_m: 0.8, height_m: 1.0}\n";
  const auto start = [&](double distance_m, double height_m) {
    return error(house + "start: {off_axis_rad: 0.9, distance_m: " + std::to_string(distance_m) +
                 ", height_offset_m: " + std::to_string(height_m) + "}\n");
  };
  EXPECT_TRUE(test::says(start(1.0, 1.2), "start/height_offset_m: starts in the roof"));
  EXPECT_EQ(start(1.0, 0.9), "") << "below it";
  EXPECT_EQ(start(2.0, 1.2), "") << "before it";
}

TEST_F(ScenarioFile, AKeyMayNotStandTwice) {
  EXPECT_EQ(error("start:\n  distance_m: 4\n  distance_m: 5\n"),
            file_ + ":3: start/distance_m: is given twice");
  EXPECT_TRUE(test::says(error("house: {}\nhouse: {}\n"), ":2: house: is given twice"));
  EXPECT_TRUE(test::says(error("? {a: 1}\n: 2\n"), ":1: a key must be a word"));
}

TEST_F(ScenarioFile, NamesFileLineAndKeyOfEveryKindOfFault) {
  EXPECT_EQ(error("start:\n  distance_m: 500\ndecoys:\n  - {y_m: far, colour: 1}\n"),
            file_ + ":2: start/distance_m = 500 is not within 0.8 .. 15\n" + file_ +
                ":4: decoys[0]/y_m: must be a number, not 'far'\n" + file_ +
                ":4: decoys[0]/colour: unknown key; there is y_m, z_m, width_m, height_m, "
                "frame_width_m, frame, surround, closed_by, bars; see doc/scenarios.md");
  EXPECT_EQ(error("start:\n  distance_m: 500\n"),
            file_ + ":2: start/distance_m = 500 is not within 0.8 .. 15");
  EXPECT_EQ(error("start:\n  distance_m: [1, 500]\n"),
            file_ + ":2: start/distance_m = 500 is not within 0.8 .. 15");
  EXPECT_TRUE(
      test::says(error("start:\n  distance_m: [5, 3]\n"), ":2: start/distance_m: the range's first end"));
  EXPECT_TRUE(
      test::says(error("start:\n  distance_m: [5]\n"), ":2: start/distance_m: a range must have two ends"));
  EXPECT_TRUE(test::says(error("start:\n  distance_m: far\n"), ":2: start/distance_m: must be a number"));
  EXPECT_TRUE(test::says(error("start:\n  distance_m: .nan\n"), "not within"));
  EXPECT_TRUE(test::says(error("start:\n  distance_m: [.nan, 2]\n"), "not within"));
  EXPECT_TRUE(test::says(error("camera: {width_px: 1.5}"), "must be a whole number"));
  EXPECT_TRUE(test::says(error("start:\n  distanse_m: 4\n"),
                         ":2: start/distanse_m: unknown key; did you mean 'distance_m'?"));
  EXPECT_TRUE(
      test::says(error("decoys:\n  - {y_m: 1}\n  - {colour: 1}\n"), ":3: decoys[1]/colour: unknown key"));
  EXPECT_TRUE(test::says(error("decoys: 3\n"), "must be a list"));
  EXPECT_TRUE(test::says(error("start: 3\n"), "must be a mapping"));
  EXPECT_TRUE(test::says(error("- 1\n"), "must be a mapping"));
  EXPECT_TRUE(test::says(error(""), "must be a mapping"));
  EXPECT_TRUE(test::says(error("start: [\n"), "not valid yaml"));
  EXPECT_EQ(error("house: {wall_texture: straw}")
                .find(file_ + ":1: house/wall_texture = straw is not one of plaster"),
            0u);
  EXPECT_TRUE(test::says(error("window: {sill_m: 2.5}"), "reaches above house/eaves_m"));
}

TEST(Scenario, MissingFileSaysSo) {
  EXPECT_TRUE(test::says(test::refusalOf([] { loadScenario("/nowhere/world.yaml", 1); }),
                         "/nowhere/world.yaml: cannot be read"));
}

TEST(Scenario, StartPoseHasTheDistanceBearingAndHeadingAsked) {
  Scenario scenario;
  scenario.start.distance_m = 4.0;
  scenario.start.off_axis_rad = 0.5;
  scenario.start.height_offset_m = 0.3;
  scenario.start.odom_yaw_rad = 2.0;
  const Eigen::Vector3d at = scenario.startPoseInWindow().translation();
  EXPECT_NEAR(at.head<2>().norm(), 4.0, 1e-12);
  EXPECT_LT(at.x(), 0.0) << "outside is x < 0";
  EXPECT_GT(at.y(), 0.0) << "a positive bearing is left of the axis";
  const Eigen::Vector3d window_in_base = scenario.startPoseInWindow().inverse() * Eigen::Vector3d::Zero();
  EXPECT_NEAR(window_in_base.y(), 0.0, 1e-12) << "without a heading of its own it faces the window";
  EXPECT_NEAR(window_in_base.z(), -0.3, 1e-12);
  scenario.start.heading_rad = 0.4;
  EXPECT_LT((scenario.startPoseInWindow().inverse() * Eigen::Vector3d::Zero()).y(), 0.0)
      << "turned left, the window is to the right";
  EXPECT_NEAR(geometry::yawOf(scenario.startPoseInOdom().linear()), 2.0, 1e-12);
  scenario.startAt(geometry::makePose(geometry::yawRotation(-1.3), {20.0, -7.0, 9.0}));
  const Eigen::Isometry3d start = scenario.startPoseInOdom();
  EXPECT_NEAR(geometry::yawOf(start.linear()), -1.3, 1e-12);
  EXPECT_NEAR((start.translation() - Eigen::Vector3d(20.0, -7.0, scenario.windowCentreHeight() + 0.3)).norm(),
              0.0, 1e-12)
      << "its height is that above the window's centre";
  EXPECT_NEAR(
      (scenario.T_odom_window() * scenario.startPoseInWindow().translation() - start.translation()).norm(),
      0.0, 1e-9);
  EXPECT_NEAR(scenario.T_odom_window().translation().z(), scenario.windowCentreHeight(), 1e-12);
}

TEST(Scenario, CameraLooksForwardAndDownWhenPitched) {
  CameraParams camera;
  EXPECT_TRUE(
      (camera.T_base_camera().linear() * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitX(), 1e-12));
  EXPECT_TRUE((camera.T_base_camera().linear() * Eigen::Vector3d::UnitX())
                  .isApprox(-Eigen::Vector3d::UnitY(), 1e-12));
  camera.pitch_rad = 0.3;
  EXPECT_LT((camera.T_base_camera().linear() * Eigen::Vector3d::UnitZ()).z(), -0.2);
  camera.yaw_rad = 0.3;
  EXPECT_GT((camera.T_base_camera().linear() * Eigen::Vector3d::UnitZ()).y(), 0.2);
}

TEST(Scenario, ALensHasTheCoefficientsOfItsModel) {
  Scenario scenario;
  CameraParams& camera = scenario.camera;
  camera.k4 = 0.01;
  camera.horizontal_fov_rad = 2.618;
  EXPECT_EQ(faultsOf(scenario).size(), 2u);
  camera.lens = "equidistant";
  EXPECT_TRUE(faultsOf(scenario).empty());
  const auto model = camera.model();
  EXPECT_EQ(model.model, geometry::LensModel::kEquidistant);
  EXPECT_EQ(model.distortion[3], 0.01);
  EXPECT_DOUBLE_EQ(model.fx, 640 / 2.618);
  camera.p1 = 0.01;
  EXPECT_EQ(faultsOf(scenario).size(), 1u);
}

TEST(Scenario, FaultsOfAnImpossibleWorldAreListed) {
  EXPECT_TRUE(faultsOf(Scenario()).empty());
  Scenario scenario;
  scenario.wind.x_mps = std::numeric_limits<double>::infinity();
  scenario.posters.emplace_back().width_m = -1.0;
  const auto faults = faultsOf(scenario);
  ASSERT_EQ(faults.size(), 2u);
  EXPECT_TRUE(test::says(faults[0], "posters[0]/width_m"));
  scenario = Scenario();
  scenario.start.height_offset_m = -2.9;
  EXPECT_EQ(faultsOf(scenario).size(), 1u);
}

// Collects the required rows for each section of the documentation.
class DocumentedKeys {
 public:
  explicit DocumentedKeys(std::string section) : section_(std::move(section)) {}
  template <typename Number>
  void operator()(const std::string& name, const Number& value, double minimum, double maximum) {
    std::ostringstream start, limits, standard;
    start << "| `" << name << "` |";
    limits << "| " << minimum << " … " << maximum;
    standard << "| " << value << " |";
    expectRow(start.str(), {limits.str(), standard.str()});
  }
  template <typename Value>
  void operator()(const std::string& name, const Value&) {
    expectRow("| `" + name + "` |", {});
  }
  void choice(const std::string& name, const std::string& value, const std::vector<std::string>& allowed) {
    std::vector<std::string> parts = allowed;
    parts.push_back("| " + value + " |");
    expectRow("| `" + name + "` |", parts);
  }
  template <typename Params>
  void group(const std::string& name, const Params& params) {
    if constexpr (std::is_same_v<Params, ColourParams>) {
      const auto text = [](int c) { return std::to_string(c); };
      expectRow("| `" + name + "` |",
                {"{r: " + text(params.r) + ", g: " + text(params.g) + ", b: " + text(params.b) + "}"});
    } else {
      DocumentedKeys inner("## `" + name + "`");
      Params::visit(params, inner);
    }
  }
  template <typename Params>
  void list(const std::string& name, const std::vector<Params>&) {
    const Params item;
    group(name, item);
  }

 private:
  void expectRow(const std::string& start, const std::vector<std::string>& parts) {
    static const std::string text = [] {
      std::ifstream file(kSource + "/doc/scenarios.md");
      return std::string(std::istreambuf_iterator<char>(file), {});
    }();
    const auto from = text.find("\n" + section_ + "\n");
    ASSERT_NE(from, std::string::npos) << "doc/scenarios.md has no section " << section_;
    const std::string section = text.substr(from, text.find("\n## ", from + 1) - from);
    const auto at = section.find("\n" + start);
    ASSERT_NE(at, std::string::npos) << "doc/scenarios.md, " << section_ << ", lacks the row " << start;
    const std::string row = section.substr(at + 1, section.find('\n', at + 1) - at - 1);
    for (const auto& part : parts) EXPECT_TRUE(test::says(row, part)) << row << " must say " << part;
    EXPECT_EQ(row.find("|  |", row.size() - 4), std::string::npos) << row << " does not say what it means";
  }

  std::string section_;
};

TEST(Scenario, EveryKeyStandsInTheDocumentationWithItsDefaultAndLimits) {
  DocumentedKeys keys("## Top level");
  const Scenario scenario;
  Scenario::visit(scenario, keys);
  DocumentedKeys colour("## `colour`");
  const ColourParams grey;
  ColourParams::visit(grey, colour);
}

}  // namespace window_ingress::simulation::scenario_test
