/// Parameters of the house with its windows, and of what only looks like one; see `Scenario`.
#pragma once

#include <algorithm>
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

/// The target: a rectangular window with a coloured frame, open unless `closed_by` says otherwise.
struct WindowParams {
  bool present = true;    ///< false: the wall is closed where the window would be
  double width_m = 1.2;   ///< of the opening, inside its frame [m]
  double height_m = 1.0;  ///< of the opening, inside its frame [m]
  double sill_m = 1.0;    ///< lower border of the opening above the ground [m]
  double frame_width_m =
      0.07;  ///< visible width of the frame around the opening; 0: a bare hole in the wall [m]
  double frame_depth_m =
      0.02;  ///< how far the frame stands out of the wall, 2 mm at least; not used without a frame [m]
  ColourParams frame{225, 95, 20};     ///< of the frame
  ColourParams reveal{205, 200, 190};  ///< inner faces of the opening
  std::string surround =
      "none";  ///< what is around the frame: a board below, folded shutters at both sides, a beam above
  std::string closed_by =
      "none";         ///< none: open; else what closes it: solid, but `T_odom_window` tells its pose as ever
  double dirt = 0.0;  ///< part of its glass that specks of dirt cover; 0: clean
  std::string bars = "none";  ///< in front of what closes it
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("present", self.present);
    field("width_m", self.width_m, 0.3, 4.0);
    field("height_m", self.height_m, 0.3, 3.0);
    field("sill_m", self.sill_m, 0.1, 5.0);
    field("frame_width_m", self.frame_width_m, 0.0, 0.3);
    field("frame_depth_m", self.frame_depth_m, 0.0, 0.1);
    field.group("frame", self.frame);
    field.group("reveal", self.reveal);
    field.choice("surround", self.surround, {"none", "sill", "shutters", "lintel"});
    field.choice("closed_by", self.closed_by,
                 {"none", "glass", "tinted_glass", "curtain", "blinds", "shutter", "board"});
    field("dirt", self.dirt, 0.0, 0.3);
    field.choice("bars", self.bars, {"none", "vertical", "cross"});
  }
  static constexpr double kMinFrameDepth_m = 0.002;
  /// How far the wall's face lies behind the plane x = 0 of the window frame [m].
  double wallFront() const { return frame_width_m > 0.0 ? std::max(frame_depth_m, kMinFrameDepth_m) : 0.0; }
  bool isOpen() const { return present && closed_by == "none"; }
  /// The room is seen through it: it is open, or of clear glass.
  bool showsRoom() const { return isOpen() || (present && closed_by == "glass"); }
};

/// A window that is no target.
struct DecoyParams {
  double y_m = 2.6;                        ///< centre, to the left of the target's centre [m]
  double z_m = 0.0;                        ///< centre, above the target's centre [m]
  double width_m = 1.0;                    ///< inside its frame [m]
  double height_m = 1.0;                   ///< inside its frame [m]
  double frame_width_m = 0.06;             ///< visible width of its frame; 0: none [m]
  ColourParams frame{240, 240, 235};       ///< of its frame
  std::string surround = "none";           ///< as of the target
  std::string closed_by = "tinted_glass";  ///< none: an open way into the same room, and the wrong one
  std::string bars = "vertical";           ///< in front of what closes it
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("y_m", self.y_m, -20.0, 20.0);
    field("z_m", self.z_m, -5.0, 5.0);
    field("width_m", self.width_m, 0.2, 4.0);
    field("height_m", self.height_m, 0.2, 3.0);
    field("frame_width_m", self.frame_width_m, 0.0, 0.3);
    field.group("frame", self.frame);
    field.choice("surround", self.surround, {"none", "sill", "shutters", "lintel"});
    field.choice("closed_by", self.closed_by,
                 {"none", "glass", "tinted_glass", "curtain", "blinds", "shutter", "board"});
    field.choice("bars", self.bars, {"none", "vertical", "cross"});
  }
  bool isOpen() const { return closed_by == "none"; }
  bool showsRoom() const { return isOpen() || closed_by == "glass"; }
};

/// A closed door in the front wall.
struct DoorParams {
  double y_m = -3.5;                  ///< centre, to the left of the target's centre [m]
  double width_m = 0.95;              ///< inside its frame [m]
  double height_m = 2.05;             ///< inside its frame, above the ground [m]
  double frame_width_m = 0.08;        ///< visible width of its frame [m]
  ColourParams frame{240, 240, 235};  ///< of its frame
  ColourParams leaf{70, 85, 100};     ///< of its leaf
  bool glazed = true;                 ///< with a pane in its upper half
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("y_m", self.y_m, -20.0, 20.0);
    field("width_m", self.width_m, 0.6, 3.0);
    field("height_m", self.height_m, 1.5, 4.0);
    field("frame_width_m", self.frame_width_m, 0.01, 0.3);
    field.group("frame", self.frame);
    field.group("leaf", self.leaf);
    field("glazed", self.glazed);
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
  std::string look = "picture";      ///< printed: an image, the view through an open window, a chessboard
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("y_m", self.y_m, -20.0, 20.0);
    field("z_m", self.z_m, -5.0, 5.0);
    field("width_m", self.width_m, 0.1, 4.0);
    field("height_m", self.height_m, 0.1, 3.0);
    field("border_m", self.border_m, 0.0, 0.3);
    field.group("border", self.border);
    field.choice("look", self.look, {"picture", "window", "chessboard"});
  }
};

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
