#pragma once

#include <string>

namespace window_ingress::simulation {

/// Motion of the air, in the window's axes, and the wall's effect on the vehicle.
struct WindParams {
  double x_mps = 0.0;               ///< wind outside, towards the wall [m/s]
  double y_mps = 0.0;               ///< wind outside, to the left of somebody who looks at the window [m/s]
  double z_mps = 0.0;               ///< wind outside, up [m/s]
  std::string gusts = "none";       ///< turbulence: none, or the Dryden model of MIL-F-8785C at low altitude
  double wind_20ft_mps = 5.0;       ///< wind at 20 feet, which sets the strength of Dryden's gusts [m/s]
  double inside_part = 0.1;         ///< part of wind and gusts that is left in the room
  double draught_mps = 0.0;         ///< draught through the opening into the room; negative: out of it [m/s]
  double wall_push_mps2 = 0.0;      ///< acceleration towards the wall for a vehicle that touches it [m/s^2]
  double wall_push_length_m = 0.3;  ///< gap to the wall at which the push has fallen to 37 % [m]
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("x_mps", self.x_mps, -15.0, 15.0);
    field("y_mps", self.y_mps, -15.0, 15.0);
    field("z_mps", self.z_mps, -5.0, 5.0);
    field.choice("gusts", self.gusts, {"none", "dryden"});
    field("wind_20ft_mps", self.wind_20ft_mps, 0.0, 25.0);
    field("inside_part", self.inside_part, 0.0, 1.0);
    field("draught_mps", self.draught_mps, -10.0, 10.0);
    field("wall_push_mps2", self.wall_push_mps2, -5.0, 5.0);
    field("wall_push_length_m", self.wall_push_length_m, 0.02, 3.0);
  }
};

}  // namespace window_ingress::simulation
