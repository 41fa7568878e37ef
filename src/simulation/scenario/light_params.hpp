#pragma once

#include "simulation/scenario/colour_params.hpp"

namespace window_ingress::simulation {

/// The light outdoors: sun, sky and fog.
struct LightParams {
  double sun_azimuth_rad = 0.6;  ///< where the sun stands, from the outward normal towards the left; beyond
                                 ///< pi/2: behind the house [rad]
  double sun_elevation_rad = 0.85;    ///< how high the sun stands [rad]
  double sun = 0.5;                   ///< brightness that the sun adds to a face square to it
  double ambient = 0.55;              ///< brightness of a face in shadow
  double sky = 1.0;                   ///< brightness of the sky itself
  ColourParams light{255, 255, 255};  ///< of the light outdoors
  double fog_m = 0.0;                 ///< distance at which 5 % of all contrast is left; 0: no fog [m]
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("sun_azimuth_rad", self.sun_azimuth_rad, -3.15, 3.15);
    field("sun_elevation_rad", self.sun_elevation_rad, 0.0, 1.5);
    field("sun", self.sun, 0.0, 1.5);
    field("ambient", self.ambient, 0.0, 1.5);
    field("sky", self.sky, 0.0, 1.5);
    field.group("light", self.light);
    field("fog_m", self.fog_m, 0.0, 10000.0);
  }
};

}  // namespace window_ingress::simulation
