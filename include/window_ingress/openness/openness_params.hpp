#pragma once

namespace window_ingress::openness {

/// What counts as open, and how certain that must be. How much of the opening must be seen open is not a
/// parameter: see `openness_judge.cpp`.
struct OpennessParams {
  double max_depth_closed_m = 0.35;  ///< a surface up to this far behind the border closes the opening [m]
  double min_depth_behind_m = 0.7;   ///< least depth behind the border of what is seen through an open window
                                     ///< [m]
  double max_depth_behind_m = 10.0;  ///< anything deeper than this is a mirror image or dirt on the lens and
                                     ///< proves nothing [m]
  double reveal_depth_m = 0.4;       ///< depth of the opening's inner faces, which do not count as closed [m]
  double sure_log_odds = 6.0;        ///< log odds at which the opening counts as open or closed

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("max_depth_closed_m", self.max_depth_closed_m, 0.0, 2.0);
    field("min_depth_behind_m", self.min_depth_behind_m, 0.1, 5.0);
    field("max_depth_behind_m", self.max_depth_behind_m, 2.0, 1000.0);
    field("reveal_depth_m", self.reveal_depth_m, 0.0, 2.0);
    field("sure_log_odds", self.sure_log_odds, 0.5, 100.0);
  }
};

}  // namespace window_ingress::openness
