/// Parameters of what stands in the world; see `Scenario`.
#pragma once

#include <string>

#include "simulation/scenario/window_params.hpp"

namespace window_ingress::simulation {

/// The house with all around it swings to and fro in the odometry frame, as one does that hangs from a crane
/// or floats. It does not turn.
struct SwayParams {
  double amplitude_m = 0.0;    ///< furthest from its resting place [m]; 0: it stands still
  double period_sec = 4.0;     ///< of a full swing [s]
  double direction_rad = 0.0;  ///< of the swing: 0 along the wall, pi/2 along the window's normal [rad]
  double phase_rad = 0.0;      ///< at the start; 0: through its resting place [rad]
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("amplitude_m", self.amplitude_m, 0.0, 1.0);
    field("period_sec", self.period_sec, 0.5, 60.0);
    field("direction_rad", self.direction_rad, -3.15, 3.15);
    field("phase_rad", self.phase_rad, -3.15, 3.15);
  }
};

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

/// The house around the window, and the room behind it.
struct HouseParams {
  std::string wall_texture = "plaster";  ///< what the front wall is made of
  ColourParams wall{226, 214, 190};      ///< of the front wall
  double wall_thickness_m = 0.24;        ///< of the wall behind the frame [m]
  double width_m = 11.0;                 ///< of the front wall, the target at its middle [m]
  double eaves_m = 3.1;                  ///< height of the front wall [m]
  double room_depth_m = 5.0;             ///< free depth behind the wall [m]
  double room_light =
      0.38;  ///< brightness of the room beside full daylight; its back wall gets 1.149 times this
  std::string room_texture = "plaster";  ///< of the room's walls
  ColourParams room{205, 200, 180};      ///< of the room's walls
  std::string furniture = "some";        ///< in the room, none of it in the way
  bool back_window = false;              ///< a glazed window in the room's back wall, and daylight behind it
  LightParams daylight;                  ///< its keys stand among those of the house
  int texture_seed = 1;                  ///< seed of the patterns on all surfaces
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field.choice("wall_texture", self.wall_texture, {"plaster", "brick", "siding", "stone", "paint"});
    field.group("wall", self.wall);
    field("wall_thickness_m", self.wall_thickness_m, 0.05, 1.0);
    field("width_m", self.width_m, 2.0, 40.0);
    field("eaves_m", self.eaves_m, 1.5, 12.0);
    field("room_depth_m", self.room_depth_m, 2.0, 15.0);
    field("room_light", self.room_light, 0.0, 1.5);
    field.choice("room_texture", self.room_texture, {"plaster", "brick", "siding", "stone", "paint"});
    field.group("room", self.room);
    field.choice("furniture", self.furniture, {"none", "some", "full"});
    field("back_window", self.back_window);
    LightParams::visit(self.daylight, field);
    field("texture_seed", self.texture_seed, 0, 1000000);
  }
};

}  // namespace window_ingress::simulation
