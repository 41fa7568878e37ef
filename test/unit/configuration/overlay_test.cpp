#include "window_ingress/configuration/overlay.hpp"

#include <gtest/gtest.h>

#include <string>

#include "refusal.hpp"
#include "window_ingress/parameters/fields.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::configuration::overlay_test {

class OverlayFile : public testing::Test {
 protected:
  test::TemporaryFolder folder_;
  const std::string file_ = folder_.path / "overlay.yaml";

  Overlay read(const std::string& text) { return readOverlay(folder_.write("overlay.yaml", text)); }
  std::string error(const std::string& text) {
    return test::refusalOf([&] { read(text); });
  }
};

TEST_F(OverlayFile, TellsTheVehicleToPoseAndNavigation) {
  const Overlay overlay = read("vehicle: {half_width_m: 0.45, half_height_m: 0.2}\n");
  EXPECT_DOUBLE_EQ(overlay.ingress_navigator.navigator.vehicle.half_width_m, 0.45);
  EXPECT_DOUBLE_EQ(overlay.homography_pose.tracker.needed.width_m, 1.0);
  EXPECT_DOUBLE_EQ(overlay.homography_pose.tracker.needed.height_m, 0.5);
  EXPECT_EQ(overlay.given, (std::set<std::string>{"vehicle/half_width_m", "vehicle/half_height_m"}));
}

TEST_F(OverlayFile, WithoutAFileEverythingIsAtItsDefault) {
  const Overlay overlay = readOverlay("");
  EXPECT_TRUE(overlay.given.empty());
  EXPECT_DOUBLE_EQ(overlay.homography_pose.tracker.needed.width_m, 0.6);
}

// Forms that earlier versions accepted as --params, and silently as config:=.
TEST_F(OverlayFile, RefusesSectionsWithoutTheirNode) {
  EXPECT_EQ(error("navigator: {vehicle: {half_width_m: 0.45}}\n"),
            file_ + ":1: navigator: unknown key; did you mean 'ingress_navigator: {navigator: ..}'?");
  EXPECT_EQ(error("detector: {min_score: 0.5}\n"),
            file_ + ":1: detector: unknown key; did you mean 'window_detector: {detector: ..}'?");
  EXPECT_EQ(error("reference: {picture: a.png}\n"),
            file_ + ":1: reference: unknown key; did you mean 'window_detector: {reference: ..}'?");
}

TEST_F(OverlayFile, RefusesSlipsOfThePenByName) {
  EXPECT_EQ(error("ingres_navigator: {rate_hz: 40}\n"),
            file_ + ":1: ingres_navigator: unknown key; did you mean 'ingress_navigator'?");
  EXPECT_EQ(error("world: {}\nvehicle:\n  half_widht_m: 0.3\n"),
            file_ + ":3: vehicle/half_widht_m: unknown key; did you mean 'half_width_m'?");
  EXPECT_EQ(error("ingress_navigator: {navigator: {limits: {speed: 1}}}\n"),
            file_ + ":1: ingress_navigator/navigator/limits/speed: unknown key; did you mean 'speed_mps'?");
  EXPECT_EQ(error("unheard_of: 1\n"), file_ +
                                          ":1: unheard_of: unknown key; there is vehicle, window_detector, "
                                          "homography_pose, ingress_navigator, setpoint_guard, world");
  EXPECT_EQ(error("vehicle: {camera_pose: [0.1, 0, 0, 0, 0, 0]}\n"),
            file_ +
                ":1: vehicle/camera_pose: unknown key; it is an argument of the launch files: "
                "camera_pose:=..");
  EXPECT_TRUE(test::says(error("vehicle: {propellers: 4}\n"),
                         "there is half_length_m, half_width_m, half_height_m, "));
}

// Without its group a field's name is ambiguous.
TEST_F(OverlayFile, NamesAllKeysThatAreCalledSo) {
  const std::string said = error("ingress_navigator: {navigator: {speed_mps: 0.4}}\n");
  for (const char* group : {"limits", "approach", "commit"})
    EXPECT_TRUE(test::says(said, formatted("'ingress_navigator: {navigator: {%s: {speed_mps: ..}}}'", group)))
        << said;
}

TEST_F(OverlayFile, SaysWhereTheVehicleIsNow) {
  EXPECT_EQ(error("ingress_navigator: {navigator: {vehicle: {half_width_m: 0.3}}}\n"),
            file_ +
                ":1: ingress_navigator/navigator/vehicle: unknown key; it is now 'vehicle: {..}', at the "
                "level of the node names, once for all nodes");
  EXPECT_TRUE(
      test::says(error("homography_pose: {tracker: {fit: {vehicle_width_m: 0.6}}}\n"), "half_width_m"));
}

TEST_F(OverlayFile, SaysWhatBecameOfFormerKeys) {
  const std::pair<const char*, const char*> formers[] = {
      {"homography_pose: {stamps: {max_age_sec: 1.0}}", "; it is now 'vehicle: {stamps: {..}}'"},
      {"window_detector: {image_is_rectified: true}", "; it is now 'vehicle: {image_is_rectified: ..}'"},
      {"ingress_navigator: {odom_frame: map}", "; it is now 'vehicle: {odom_frame: ..}'"},
      {"homography_pose: {filter: {gate_squares: 30}}", "gate_squares: unknown key; it is now 'nis_gate'"}};
  for (const auto& [yaml, text] : formers)
    EXPECT_TRUE(test::says(error(yaml + std::string("\n")), text)) << error(yaml + std::string("\n"));
  Overlay overlay;
  for (const std::string& key : parameters::keysOf(parameters::fieldsOf(overlay))) {
    const bool has_its_own = key.rfind("vehicle", 0) == 0 || key.rfind("world", 0) == 0;
    EXPECT_TRUE(has_its_own || parameters::didYouMean(key, {}).empty()) << key << " is still read";
  }
}

TEST_F(OverlayFile, RefusesANodeThatHoldsNoMapping) {
  EXPECT_EQ(error("ingress_navigator: 5\n"),
            file_ + ":1: ingress_navigator: must be a mapping of keys to values, not '5'");
}

TEST_F(OverlayFile, ShippedOnesAreGood) {
  for (const char* name : {"sim", "ardupilot"}) {
    const std::string file = std::string(WINDOW_INGRESS_SOURCE_DIR "/config/") + name + ".yaml";
    EXPECT_FALSE(readOverlay(file).given.empty()) << name;
  }
}

}  // namespace window_ingress::configuration::overlay_test
