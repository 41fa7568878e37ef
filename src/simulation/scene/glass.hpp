#pragma once

#include <Eigen/Geometry>

namespace window_ingress::simulation {

/// A clear pane in the front wall: shows the room behind it and mirrors what is before it.
struct Pane {
  double x_m;                  ///< window frame
  Eigen::AlignedBox2d face_m;  ///< y and z
};

/// Part of the light that a pane of window glass mirrors, both faces together: Fresnel's law for light
/// without polarisation, and all that goes to and fro between the faces.
double paneReflectance(double cos_incidence);

/// In front of the plane and behind it change places.
Eigen::Isometry3d mirrorAt(double x_m);

}  // namespace window_ingress::simulation
