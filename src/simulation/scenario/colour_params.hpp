#pragma once

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

}  // namespace window_ingress::simulation
