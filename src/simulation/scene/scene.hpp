#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "simulation/scenario/scenario.hpp"
#include "simulation/scene/obstacle_collision.hpp"
#include "simulation/surfaces/mesh.hpp"

namespace window_ingress::simulation {

/// An object at distance d keeps exp(-d density) of its contrast; the rest is the fog's colour.
struct Fog {
  Eigen::Vector3d colour;  ///< red, green, blue, 0..1
  double density_per_m;
};

/// A clear pane in the front wall: shows the room behind it and reflects the scene in front.
struct Pane {
  double x_m;                  ///< window frame
  Eigen::AlignedBox2d face_m;  ///< y and z
};

/// Visible surfaces and obstacles, in the axes of the target's window frame.
///
/// The plane x = 0 is the front of the target's frame. The rectangle `Scenario::opening()` in this plane is
/// the frame's inner border: `T_odom_window` and `opening()` always describe this *front inner border*. The
/// wall begins `WindowParams::wallFront()` behind the plane and is `wall_thickness_m` thick; the opening's
/// inner faces run from x = 0 to the wall's back.
struct Scene {
  Mesh mesh;
  std::vector<Obstacle> obstacles;
  double opening_depth_m = 0.0;  ///< depth at which the opening ends in the room
  double ground_z_m = 0.0;
  std::optional<geometry::OpeningSize> opening;  ///< empty without a target; a target may also be closed
  bool other_clear_holes = false;                ///< the room is also visible through other windows
  std::uint32_t texture_seed = 0;
  std::optional<Fog> fog;
  std::vector<Pane> panes;  ///< all in one plane
};

Scene buildScene(const Scenario& scenario);

}  // namespace window_ingress::simulation
