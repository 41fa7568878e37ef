#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "simulation/scenario/scenario.hpp"
#include "simulation/scene/obstacle_collision.hpp"
#include "simulation/surfaces/mesh.hpp"

namespace window_ingress::simulation {

/// What is seen at a depth d keeps exp(-d density) of its contrast; the rest is the fog's own colour.
struct Fog {
  Eigen::Vector3d colour;  ///< red, green, blue, 0..1
  double density_per_m;
};

/// A clear pane in the front wall: shows the room behind it and mirrors what is before it.
struct Pane {
  double x_m;                  ///< window frame
  Eigen::AlignedBox2d face_m;  ///< y and z
};

/// What is to be seen and what is in the way, in the axes of the target's window frame.
///
/// The plane x = 0 is the front of the target's frame, and the rectangle `Scenario::opening()` in it is the
/// frame's inner border: this *front inner border* is what `T_odom_window` and `opening()` describe
/// everywhere. The wall begins `WindowParams::wallFront()` behind it and ends at `wall_thickness_m` behind
/// that; the inner faces of the opening run from x = 0 to there.
struct Scene {
  Mesh mesh;
  std::vector<Obstacle> obstacles;
  double opening_depth_m = 0.0;  ///< where the opening ends in the room
  double ground_z_m = 0.0;
  std::optional<geometry::OpeningSize> opening;  ///< nothing without a target; may be closed all the same
  bool other_clear_holes = false;                ///< the room is seen through other windows too
  std::uint32_t texture_seed = 0;
  std::optional<Fog> fog;
  std::vector<Pane> panes;  ///< all in one plane
};

Scene buildScene(const Scenario& scenario);

/// The world as it was when the operator photographed the target: there, open, with nothing over it, in clear
/// air.
Scenario asPhotographed(const Scenario& scenario);

}  // namespace window_ingress::simulation
