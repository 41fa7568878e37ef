/// Parameters of what stands in the world; see `Scenario`.
#pragma once

#include <string>

#include "simulation/scenario/colour_params.hpp"
#include "simulation/scenario/light_params.hpp"
#include "simulation/scenario/window_params.hpp"

namespace window_ingress::simulation {

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
