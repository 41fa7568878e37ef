/// Parameters of a house that does not stand still; see `Scenario`.
#pragma once

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

}  // namespace window_ingress::simulation
