// config/sim.yaml describes the same vehicle and camera as the scenarios.
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <cmath>

#include "simulation/scenario/scenario.hpp"

namespace window_ingress::simulation::sim_config_test {

constexpr double kRounded = 0.005;

class SimConfig : public testing::Test {
 protected:
  const YAML::Node vehicle_ = YAML::LoadFile(WINDOW_INGRESS_SOURCE_DIR "/config/sim.yaml")["vehicle"];
  const Scenario scenario_ = loadScenario(WINDOW_INGRESS_SOURCE_DIR "/config/scenarios/nominal.yaml", 1);
  double said(const char* name) const { return vehicle_[name].as<double>(); }
};

TEST_F(SimConfig, BodyIsThatOfTheNominalScenario) {
  EXPECT_DOUBLE_EQ(said("half_length_m"), scenario_.vehicle.half_length_m);
  EXPECT_DOUBLE_EQ(said("half_width_m"), scenario_.vehicle.half_width_m);
  EXPECT_DOUBLE_EQ(said("half_height_m"), scenario_.vehicle.half_height_m);
}

TEST_F(SimConfig, CameraIsThatOfTheNominalScenario) {
  const geometry::PinholeCamera camera = scenario_.camera.model();
  EXPECT_DOUBLE_EQ(said("camera_forward_m"), scenario_.camera.x_m);
  EXPECT_NEAR(said("horizontal_fov_rad"), 2.0 * std::atan(camera.width / (2.0 * camera.fx)), kRounded);
  EXPECT_NEAR(said("vertical_fov_rad"), 2.0 * std::atan(camera.height / (2.0 * camera.fy)), kRounded);
}

TEST_F(SimConfig, SaysNothingElse) { EXPECT_EQ(vehicle_.size(), 6u); }

}  // namespace window_ingress::simulation::sim_config_test
