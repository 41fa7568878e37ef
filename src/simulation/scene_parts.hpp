/// Parts of which `buildScene` makes a world. All take and give coordinates of the target's window frame.
#pragma once

#include <vector>

#include "window_ingress/simulation/scene.hpp"

namespace window_ingress::simulation {

/// An upright rectangle in a plane of constant x [m].
struct Rectangle {
  double right_m, left_m, bottom_m, top_m;  // y from right to left, z from bottom to top
  static Rectangle around(double y_m, double z_m, double width_m, double height_m) {
    return {y_m - 0.5 * width_m, y_m + 0.5 * width_m, z_m - 0.5 * height_m, z_m + 0.5 * height_m};
  }
  Rectangle grown(double by_m) const {
    return {right_m - by_m, left_m + by_m, bottom_m - by_m, top_m + by_m};
  }
  bool contains(double y_m, double z_m) const {
    return y_m > right_m && y_m < left_m && z_m > bottom_m && z_m < top_m;
  }
};

Surface painted(const ColourParams& colour, Texture texture = Texture::kPlain);
Eigen::AlignedBox3d box(double x0, double x1, const Rectangle& face);

/// The face of a wall at `x_m` towards the outside (or towards the room), with holes. Cut along the lines of
/// all holes, so that no vertex lies on another's side: no cracks. What lies above `shadow_z_m` gets no sun.
void addWallFace(Mesh& mesh, double x_m, bool outside, const Rectangle& wall,
                 const std::vector<Rectangle>& holes, const Surface& surface, double shadow_z_m);
/// Four bars around an opening from x0 to x1, without their inner faces.
void addFrame(Mesh& mesh, const Rectangle& opening, double width_m, double x0, double x1,
              const Surface& surface);
/// The inner faces of an opening from x0 to x1.
void addReveal(Mesh& mesh, const Rectangle& opening, double x0, double x1, const Surface& surface);
/// What is solid around an opening between x0 and x1, up to the outer rectangle.
void addSolidAround(std::vector<Obstacle>& obstacles, const std::string& name, const Rectangle& opening,
                    const Rectangle& outer, double x0, double x1);

Rectangle frontWall(const Scenario& scenario);
Rectangle targetOpening(const Scenario& scenario);
Rectangle roomWalls(const Scenario& scenario);

void addFront(const Scenario& scenario, Scene& scene);
void addTarget(const Scenario& scenario, Scene& scene);
void addDecoy(const Scenario& scenario, const DecoyParams& decoy, Scene& scene);
void addPoster(const Scenario& scenario, const PosterParams& poster, Scene& scene);
void addRoof(const Scenario& scenario, Scene& scene);
void addGarden(Scene& scene);
void addSky(Scene& scene);
void addRoom(const Scenario& scenario, Scene& scene);

}  // namespace window_ingress::simulation
