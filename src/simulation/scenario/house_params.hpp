/// Parameters of the house, its windows and decoys; see `Scenario`.
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
  bool present = true;              ///< false: solid wall in place of the window
  double width_m = 1.2;             ///< inner width of the opening [m]
  double height_m = 1.0;            ///< inner height of the opening [m]
  double sill_m = 1.0;              ///< height of the opening's lower border above the ground [m]
  double frame_width_m = 0.07;      ///< visible width of the frame; 0: a bare hole in the wall [m]
  double frame_depth_m = 0.02;      ///< protrusion of the frame, at least 2 mm; ignored without a frame [m]
  ColourParams frame{225, 95, 20};  ///< colour of the frame
  ColourParams reveal{205, 200, 190};  ///< colour of the opening's inner faces
  std::string surround = "none";   ///< board below, folded shutters at both sides, or beam above the frame
  std::string closed_by = "none";  ///< what closes it (solid; `T_odom_window` stays valid); none: open
  double dirt = 0.0;               ///< part of the window's glass that is covered by dirt; 0: clean
  std::string bars = "none";       ///< bars in front of a closed window
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
  /// Distance of the wall's face behind the plane x = 0 of the window frame [m].
  double wallFront() const { return frame_width_m > 0.0 ? std::max(frame_depth_m, kMinFrameDepth_m) : 0.0; }
  bool isOpen() const { return present && closed_by == "none"; }
  /// Whether the room is visible through the window: it is open, or of clear glass.
  bool showsRoom() const { return isOpen() || (present && closed_by == "glass"); }
};

/// A window that is not the target.
struct DecoyParams {
  double y_m = 2.6;             ///< horizontal position of its centre, to the left of the target's centre [m]
  double z_m = 0.0;             ///< height of its centre above the target's centre [m]
  double width_m = 1.0;         ///< inner width [m]
  double height_m = 1.0;        ///< inner height [m]
  double frame_width_m = 0.06;  ///< visible width of its frame; 0: no frame [m]
  ColourParams frame{240, 240, 235};       ///< colour of its frame
  std::string surround = "none";           ///< surround, as for the target
  std::string closed_by = "tinted_glass";  ///< what closes it; none: an open, but wrong way into the room
  std::string bars = "vertical";           ///< bars in front of a closed decoy
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
  bool showsRoom() const { return closed_by == "none" || closed_by == "glass"; }
};

/// A closed door in the front wall.
struct DoorParams {
  double y_m = -3.5;            ///< horizontal position of its centre, to the left of the target's centre [m]
  double width_m = 0.95;        ///< inner width [m]
  double height_m = 2.05;       ///< height of its opening above the ground [m]
  double frame_width_m = 0.08;  ///< visible width of its frame [m]
  ColourParams frame{240, 240, 235};  ///< colour of its frame
  ColourParams leaf{70, 85, 100};     ///< colour of its leaf
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
  double y_m = -1.9;       ///< horizontal position of its centre, to the left of the target's centre [m]
  double z_m = 0.1;        ///< height of its centre above the target's centre [m]
  double width_m = 0.7;    ///< width including the border [m]
  double height_m = 0.9;   ///< height including the border [m]
  double border_m = 0.05;  ///< width of its border [m]
  ColourParams border{30, 60, 150};  ///< colour of the border
  std::string look = "picture";      ///< print: an image, the view through an open window, or a chessboard
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

/// The house swings in the odometry frame with all its surroundings, as if it hung from a crane or floated.
/// It does not turn.
struct SwayParams {
  double amplitude_m = 0.0;  ///< largest distance of the house from its resting place; 0: it stands still [m]
  double period_sec = 4.0;   ///< period of the swing [s]
  double direction_rad = 0.0;  ///< direction of the swing: 0 along the wall, pi/2 along the normal [rad]
  double phase_rad = 0.0;      ///< phase of the swing at the start; 0: through the resting place [rad]
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
  double sun_azimuth_rad = 0.6;     ///< azimuth of the sun, from the outward normal towards the left; beyond
                                    ///< pi/2 it stands behind the house [rad]
  double sun_elevation_rad = 0.85;  ///< elevation of the sun [rad]
  double sun = 0.5;                 ///< brightness that the sun adds to a face perpendicular to it
  double ambient = 0.55;            ///< brightness of a face in shadow
  double sky = 1.0;                 ///< brightness of the sky
  ColourParams light{255, 255, 255};  ///< colour of the light outdoors
  double fog_m = 0.0;                 ///< distance at which 5 % of the contrast is left; 0: no fog [m]
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
  std::string wall_texture = "plaster";  ///< material of the front wall
  ColourParams wall{226, 214, 190};      ///< colour of the front wall
  double wall_thickness_m = 0.24;        ///< thickness of the wall behind the frame [m]
  double width_m = 11.0;                 ///< width of the front wall, centred on the target [m]
  double eaves_m = 3.1;                  ///< height of the front wall [m]
  double room_depth_m = 5.0;             ///< free depth behind the wall [m]
  double room_light = 0.38;  ///< brightness relative to full daylight; the back wall gets 1.149 times this
  std::string room_texture = "plaster";  ///< material of the room's walls
  ColourParams room{205, 200, 180};      ///< colour of the room's walls
  std::string furniture = "some";        ///< furniture in the room, all of it out of the way
  bool back_window = false;              ///< a glazed window with daylight in the room's back wall
  LightParams daylight;                  ///< in a scenario file these keys are keys of the house
  int texture_seed = 1;                  ///< seed of all surface patterns
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
