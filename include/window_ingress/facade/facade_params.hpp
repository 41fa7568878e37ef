#pragma once

namespace window_ingress::facade {

struct FacadeParams {
  bool enabled = true;                 ///< windows are remembered, and the target is told from its neighbours
  double corner_sigma_px = 3.0;        ///< of a corner as a search sees it [px]
  double range_sigma = 0.3;            ///< of a distance that rests on the size looked for, as part of it
  double wall_sigma_m = 0.15;          ///< how far windows lie before or behind the plane of the target [m]
  double drift_m_per_sqrt_sec = 0.02;  ///< of the odometry between two sights [m/sqrt(s)]
  double max_deviation = 3.5;          ///< furthest that a sight lies from the window it belongs to [sigmas]
  int confirmations = 3;               ///< images that must show a window before it has a number
  double forget_sec = 2.0;             ///< one that has none yet is forgotten when unseen for so long [s]
  int settled_updates = 15;            ///< of the filter, after which the window followed is the target
  double release_sec = 8.0;       ///< in view and not seen for so long, the target is no target any more [s]
  double next_release_sec = 1.5;  ///< the same for one that nobody chose, the next best after another [s]
  double likeness_margin = 0.2;   ///< another window is the target if it is more like the reference by this
  double click_m = 1.0;           ///< furthest beside a window that a click on it may be [m]
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("enabled", self.enabled);
    field("corner_sigma_px", self.corner_sigma_px, 0.1, 50.0);
    field("range_sigma", self.range_sigma, 0.01, 2.0);
    field("wall_sigma_m", self.wall_sigma_m, 0.0, 5.0);
    field("drift_m_per_sqrt_sec", self.drift_m_per_sqrt_sec, 0.0, 1.0);
    field("max_deviation", self.max_deviation, 1.0, 10.0);
    field("confirmations", self.confirmations, 1, 100);
    field("forget_sec", self.forget_sec, 0.0, 600.0);
    field("settled_updates", self.settled_updates, 1, 1000);
    field("release_sec", self.release_sec, 0.1, 600.0);
    field("next_release_sec", self.next_release_sec, 0.1, 600.0);
    field("likeness_margin", self.likeness_margin, 0.01, 1.0);
    field("click_m", self.click_m, 0.05, 10.0);
  }
};

}  // namespace window_ingress::facade
