/// Parameters of what stands in the world; see `Scenario`.
#pragma once

#include <string>

namespace window_ingress::simulation {

/// Colour of a surface in white light, 0..255.
struct ColourParams {
  int r = 200;  ///< red
  int g = 200;  ///< green
  int b = 200;  ///< blue
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("r", self.r, 0, 255);
    field("g", self.g, 0, 255);
    field("b", self.b, 0, 255);
  }
};

/// The target: an open rectangular window with a coloured frame.
struct WindowParams {
  bool present = true;                 ///< false: the wall is closed where the window would be
  double width_m = 1.2;                ///< of the opening, inside its frame [m]
  double height_m = 1.0;               ///< of the opening, inside its frame [m]
  double sill_m = 1.0;                 ///< lower border of the opening above the ground [m]
  double frame_width_m = 0.07;         ///< visible width of the frame around the opening [m]
  double frame_depth_m = 0.02;         ///< how far the frame stands out of the wall [m]
  ColourParams frame{225, 95, 20};     ///< of the frame
  ColourParams reveal{205, 200, 190};  ///< inner faces of the opening
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("present", self.present);
    field("width_m", self.width_m, 0.3, 4.0);
    field("height_m", self.height_m, 0.3, 3.0);
    field("sill_m", self.sill_m, 0.1, 5.0);
    field("frame_width_m", self.frame_width_m, 0.01, 0.3);
    field("frame_depth_m", self.frame_depth_m, 0.0, 0.1);
    field.group("frame", self.frame);
    field.group("reveal", self.reveal);
  }
};

/// A window that is no target: other colour, and closed by glass.
struct DecoyParams {
  double y_m = 2.6;                   ///< centre, to the left of the target's centre [m]
  double z_m = 0.0;                   ///< centre, above the target's centre [m]
  double width_m = 1.0;               ///< inside its frame [m]
  double height_m = 1.0;              ///< inside its frame [m]
  double frame_width_m = 0.06;        ///< visible width of its frame [m]
  ColourParams frame{240, 240, 235};  ///< of its frame
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("y_m", self.y_m, -20.0, 20.0);
    field("z_m", self.z_m, -5.0, 5.0);
    field("width_m", self.width_m, 0.2, 4.0);
    field("height_m", self.height_m, 0.2, 3.0);
    field("frame_width_m", self.frame_width_m, 0.01, 0.3);
    field.group("frame", self.frame);
  }
};

/// A printed rectangle on the wall.
struct PosterParams {
  double y_m = -1.9;                 ///< centre, to the left of the target's centre [m]
  double z_m = 0.1;                  ///< centre, above the target's centre [m]
  double width_m = 0.7;              ///< with its border [m]
  double height_m = 0.9;             ///< with its border [m]
  double border_m = 0.05;            ///< width of its border [m]
  ColourParams border{30, 60, 150};  ///< of its border
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("y_m", self.y_m, -20.0, 20.0);
    field("z_m", self.z_m, -5.0, 5.0);
    field("width_m", self.width_m, 0.1, 4.0);
    field("height_m", self.height_m, 0.1, 3.0);
    field("border_m", self.border_m, 0.0, 0.3);
    field.group("border", self.border);
  }
};

/// The house around the window, the room behind it, the light.
struct HouseParams {
  std::string wall_texture = "plaster";  ///< plaster or brick
  ColourParams wall{226, 214, 190};      ///< of the front wall
  double wall_thickness_m = 0.24;        ///< of the wall behind the frame [m]
  double width_m = 11.0;                 ///< of the front wall, the target at its middle [m]
  double eaves_m = 3.1;                  ///< height of the front wall [m]
  double room_depth_m = 5.0;             ///< free depth behind the wall [m]
  double room_light = 0.38;              ///< brightness of the room beside full daylight
  double sun_azimuth_rad = 0.6;     ///< where the sun stands, from the outward normal towards the left [rad]
  double sun_elevation_rad = 0.85;  ///< how high the sun stands [rad]
  double sun = 0.5;                 ///< brightness that the sun adds to a face square to it
  double ambient = 0.55;            ///< brightness of a face in shadow
  int texture_seed = 1;             ///< seed of the patterns on all surfaces
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field.choice("wall_texture", self.wall_texture, {"plaster", "brick"});
    field.group("wall", self.wall);
    field("wall_thickness_m", self.wall_thickness_m, 0.05, 1.0);
    field("width_m", self.width_m, 2.0, 40.0);
    field("eaves_m", self.eaves_m, 1.5, 12.0);
    field("room_depth_m", self.room_depth_m, 2.0, 15.0);
    field("room_light", self.room_light, 0.0, 1.5);
    field("sun_azimuth_rad", self.sun_azimuth_rad, -1.5, 1.5);
    field("sun_elevation_rad", self.sun_elevation_rad, 0.0, 1.5);
    field("sun", self.sun, 0.0, 1.5);
    field("ambient", self.ambient, 0.0, 1.5);
    field("texture_seed", self.texture_seed, 0, 1000000);
  }
};

}  // namespace window_ingress::simulation
