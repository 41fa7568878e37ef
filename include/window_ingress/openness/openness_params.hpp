#pragma once

namespace window_ingress::openness {

/// What is called open, and how sure that must be; see `OpennessJudge`.
struct OpennessParams {
  double max_depth_closed_m =
      0.35;  ///< a surface up to this far behind the front border closes the opening [m]
  double min_depth_behind_m =
      0.7;  ///< what is seen through an open window lies at least this far behind its border [m]
  double max_depth_behind_m = 10.0;  ///< deeper than any room: what lies beyond is a mirror image or dirt on
                                     ///< the lens, and proves nothing [m]
  double reveal_depth_m = 0.4;       ///< depth of the opening's inner faces, which close nothing [m]
  double sure_log_odds = 6.0;  ///< log odds of open against closed at which the opening is called either

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
