#pragma once

namespace window_ingress::openness {

/// What is called open, and how sure it must be; see `OpennessJudge`.
struct OpennessParams {
  double max_depth_closed_m = 0.35;  ///< a surface that far behind the front border still closes it [m]
  double min_depth_behind_m = 0.7;   ///< what is seen must lie that far behind for an open way [m]
  double max_depth_behind_m = 10.0;  ///< deeper than any room: mirrored, or stuck to the lens [m]
  double border_sigma_px = 0.4;      ///< of a border beyond its own covariance, in each image [px]
  double position_sigma_m = 0.02;    ///< of the odometry's position at an image [m]
  double min_baseline_m = 0.12;      ///< between two images that are compared [m]
  double max_border_misfit = 0.05;   ///< of the corners against the filtered window, part of its size
  double max_sigmas = 3.0;           ///< by which a point may leave the way of anything that stands still
  double max_unsteady = 0.3;         ///< part of the points that may do so
  int min_points = 5;                ///< that a verdict rests on
  double max_log_odds = 4.0;         ///< that one stretch of the flight may bring
  double sure_log_odds = 6.0;        ///< at which it is called open or closed
  double min_open_share = 0.5;       ///< of the middle that the vehicle needs: seen to be open
  double reveal_depth_m = 0.4;       ///< of the opening's inner faces, which close nothing [m]

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("max_depth_closed_m", self.max_depth_closed_m, 0.0, 2.0);
    field("min_depth_behind_m", self.min_depth_behind_m, 0.1, 5.0);
    field("max_depth_behind_m", self.max_depth_behind_m, 2.0, 1000.0);
    field("border_sigma_px", self.border_sigma_px, 0.0, 10.0);
    field("position_sigma_m", self.position_sigma_m, 0.0, 1.0);
    field("min_baseline_m", self.min_baseline_m, 0.01, 2.0);
    field("max_border_misfit", self.max_border_misfit, 0.005, 0.5);
    field("max_sigmas", self.max_sigmas, 1.0, 10.0);
    field("max_unsteady", self.max_unsteady, 0.0, 1.0);
    field("min_points", self.min_points, 3, 100);
    field("max_log_odds", self.max_log_odds, 0.5, 50.0);
    field("sure_log_odds", self.sure_log_odds, 0.5, 100.0);
    field("min_open_share", self.min_open_share, 0.0, 1.0);
    field("reveal_depth_m", self.reveal_depth_m, 0.0, 2.0);
  }
};

}  // namespace window_ingress::openness
