#pragma once

namespace window_ingress::facade {

/// The windows of the facade: which of them is the target.
struct FacadeParams {
  bool enabled = true;  ///< remember the windows of the facade and tell the target from its neighbours
  double release_sec =
      8.0;  ///< a target that nobody chose, should be in view and is not seen for this long is given up [s]
  double distance_margin = 0.2;  ///< a window becomes the target in place of another one if its Bhattacharyya
                                 ///< distance from the reference is smaller by this
  double odom_drift_m_per_sqrt_sec = 0.01;  // not in `visit`: config/vehicle.yaml says it

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("enabled", self.enabled);
    field("release_sec", self.release_sec, 0.1, 600.0);
    field("distance_margin", self.distance_margin, 0.01, 1.0);
  }
};

}  // namespace window_ingress::facade
