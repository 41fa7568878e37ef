#pragma once

namespace window_ingress::estimation {

/// Known data of the window, and limits for accepted poses. Sizes are those of the opening's front inner
/// border.
struct PoseParams {
  double opening_width_m = 1.2;       ///< inner width of the opening [m]
  double opening_height_m = 1.0;      ///< inner height of the opening [m]
  double scale_sigma = 0.0;           ///< relative standard deviation of the opening's scale; 0: known
  double aspect_sigma = 0.0;          ///< relative standard deviation of width over height; 0: known
  double systematic_sigma_px = 0.15;  ///< standard deviation of a corner's systematic error (lens, sill,
                                      ///< blur), which does not average out from one place [px]
  double max_range_m = 20.0;          ///< poses of windows further away than this are refused [m]

  // Not in `visit`: changed by surveys and tests.
  double min_range_m = 0.3;              // [m]
  double max_reprojection_rms_px = 3.0;  // per coordinate [px]
  double max_tilt_rad = 0.7;  // of the window's up against gravity, or against the camera's without it [rad]
  double max_yaw_rad = 1.4;   // [rad]

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("opening_width_m", self.opening_width_m, 0.1, 10.0);
    field("opening_height_m", self.opening_height_m, 0.1, 10.0);
    field("scale_sigma", self.scale_sigma, 0.0, 2.0);
    field("aspect_sigma", self.aspect_sigma, 0.0, 2.0);
    field("systematic_sigma_px", self.systematic_sigma_px, 0.001, 10.0);
    field("max_range_m", self.max_range_m, 0.5, 200.0);
  }
};

}  // namespace window_ingress::estimation
