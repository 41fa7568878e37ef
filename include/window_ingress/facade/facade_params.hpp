#pragma once

namespace window_ingress::facade {

/// Choice of the target among the windows of the facade.
struct FacadeParams {
  bool enabled = true;  ///< remember the windows of the facade and distinguish the target from its neighbours
  double release_sec = 8.0;      ///< a target not chosen by the operator is given up if its place was in view
                                 ///< this long without it [s]
  double distance_margin = 0.2;  ///< a window replaces the target if its Bhattacharyya distance to the
                                 ///< reference is smaller by this
  double odom_drift_m_per_sqrt_sec = 0.01;  // not in `visit`: config/vehicle.yaml says it

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("enabled", self.enabled);
    field("release_sec", self.release_sec, 0.1, 600.0);
    field("distance_margin", self.distance_margin, 0.01, 1.0);
  }
};

}  // namespace window_ingress::facade
