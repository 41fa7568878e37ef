#pragma once

namespace window_ingress::estimation {

/// Parameters of `WindowPoseEstimator`. Sizes are those of the opening's front inner border.
struct PoseParams {
  double opening_width_m = 1.2;       ///< inner width of the opening [m]
  double opening_height_m = 1.0;      ///< inner height of the opening [m]
  double scale_sigma = 0.0;           ///< relative spread of both together; 0: their scale is known [-]
  double aspect_sigma = 0.0;          ///< relative spread of width over height; 0: it is known [-]
  double systematic_sigma_px = 0.15;  ///< error of a corner that does not average out: lens, sill, blur [px]
  double systematic_turn = 0.4;       ///< its part that turns a border; the rest shifts it as a whole [-]
  double unknown_corner_sigma_px = 1.0;  ///< taken where an observation brings no usable covariance [px]
  double max_reprojection_rms_px = 3.0;  ///< worst fit that is believed, root mean square per coordinate [px]
  double min_side_px = 4.0;              ///< shortest side of the quadrilateral [px]
  double min_corner_angle_rad = 0.15;  ///< flattest corner: interior angles stay this far from 0 and pi [rad]
  double min_range_m = 0.3;            ///< nearest window [m]
  double max_range_m = 20.0;           ///< furthest window [m]
  double max_tilt_rad = 0.7;        ///< window's up against gravity, or against the camera's without it [rad]
  double max_yaw_rad = 1.4;         ///< steepest view [rad]
  double trusted_yaw_sigmas = 3.0;  ///< sign trusted from |yaw| > this times sigma_u on
  double trusted_log_likelihood_ratio = 6.2;  ///< and from this evidence on: one wrong in 500

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("opening_width_m", self.opening_width_m, 0.1, 10.0);
    field("opening_height_m", self.opening_height_m, 0.1, 10.0);
    field("scale_sigma", self.scale_sigma, 0.0, 2.0);
    field("aspect_sigma", self.aspect_sigma, 0.0, 2.0);
    field("systematic_sigma_px", self.systematic_sigma_px, 0.001, 10.0);
    field("systematic_turn", self.systematic_turn, 0.0, 1.0);
    field("unknown_corner_sigma_px", self.unknown_corner_sigma_px, 0.01, 20.0);
    field("max_reprojection_rms_px", self.max_reprojection_rms_px, 0.1, 50.0);
    field("min_side_px", self.min_side_px, 1.0, 200.0);
    field("min_corner_angle_rad", self.min_corner_angle_rad, 0.01, 1.0);
    field("min_range_m", self.min_range_m, 0.05, 10.0);
    field("max_range_m", self.max_range_m, 0.5, 200.0);
    field("max_tilt_rad", self.max_tilt_rad, 0.05, 1.5);
    field("max_yaw_rad", self.max_yaw_rad, 0.1, 1.55);
    field("trusted_yaw_sigmas", self.trusted_yaw_sigmas, 1.0, 10.0);
    field("trusted_log_likelihood_ratio", self.trusted_log_likelihood_ratio, 1.0, 50.0);
  }
};

}  // namespace window_ingress::estimation
