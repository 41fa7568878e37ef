/// A scenario as its camera shows it, for pictures.
#pragma once

#include <opencv2/core.hpp>

#include "command_line.hpp"
#include "simulation/world.hpp"

namespace window_ingress::tools {

/// Viewpoint; 0 m: the scenario's.
struct ViewOptions {
  double distance_m = 0.0, off_axis_rad = 0.0;

  void describe(OptionList& add) {
    add("distance", distance_m, "distance from the window [m]; 0: as in the scenario");
    add("off-axis", off_axis_rad, "with --distance: angle off the window's axis [rad]");
  }
  void check() const {
    if (!(distance_m >= 0.0)) throw InputError("--distance: needs metres, above 0");
    if (off_axis_rad != 0.0 && distance_m == 0.0) throw InputError("--off-axis needs --distance");
  }
};

/// Image from the start or another viewpoint, looking at the window.
inline cv::Mat photograph(simulation::Scenario scenario, std::uint32_t seed, const ViewOptions& view) {
  constexpr double kSettling_sec = 0.4, kGivesUp_sec = 10.0;  // until the camera has seen the scene
  scenario.start.heading_rad = 0.0;
  if (view.distance_m > 0.0) {
    scenario.start.distance_m = view.distance_m;
    scenario.start.off_axis_rad = view.off_axis_rad;
    scenario.start.height_offset_m = 0.0;
  }
  simulation::World world(scenario, seed);
  cv::Mat image;
  while (image.empty() || world.timeSec() < kSettling_sec) {
    world.advance();
    if (image.empty() && world.timeSec() > kGivesUp_sec)
      throw InputError("the scenario's camera gives no image");
    if (const auto frame = world.takeFrame()) image = frame->image.clone();
  }
  return image;
}

}  // namespace window_ingress::tools
