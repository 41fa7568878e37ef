#pragma once

#include <string>

namespace window_ingress::estimation {

/// Parameters of `FramesCheck`: whether camera mounting and odometry's velocity are what they are said to be.
struct FramesParams {
  double mounting_prior_rad = 0.35;  ///< how far the camera may be turned, before anything is seen [rad]
  double max_mounting_rad = 0.07;    ///< a camera turned by more than this is a fault [rad]
  double certain_sigmas = 2.5;       ///< by which it must be certain
  double max_size_error = 0.1;       ///< relative error of a size called known, beyond which it is a fault
  double image_spacing_m = 0.05;     ///< images nearer to each other than this are not looked at [m]
  double way_segment_m = 0.25;       ///< velocity is compared with the way in pieces of this length [m]
  double least_way_m = 0.5;          ///< nothing is said of the velocity before this way [m]
  double max_velocity_error = 0.3;   ///< relative misfit of way and velocity, beyond which it is a fault

  double max_attitude_gap_rad =
      0.35;  ///< between "up" of imu and of odometry, beyond which it is a fault [rad]

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("mounting_prior_rad", self.mounting_prior_rad, 0.05, 0.5);
    field("max_mounting_rad", self.max_mounting_rad, 0.01, 0.5);
    field("certain_sigmas", self.certain_sigmas, 1.0, 10.0);
    field("max_size_error", self.max_size_error, 0.01, 1.0);
    field("image_spacing_m", self.image_spacing_m, 0.0, 1.0);
    field("way_segment_m", self.way_segment_m, 0.05, 2.0);
    field("least_way_m", self.least_way_m, 0.1, 10.0);
    field("max_velocity_error", self.max_velocity_error, 0.1, 2.0);
    field("max_attitude_gap_rad", self.max_attitude_gap_rad, 0.05, 1.5);
  }
};

/// What the first metres have shown of the frames.
struct FramesVerdict {
  enum State {
    kOpen,  ///< not seen enough
    kGood,
    kWrong
  };
  State state = kOpen;
  std::string what;  ///< names the mismatch, or what is still to be seen

  bool operator==(const FramesVerdict& other) const { return state == other.state && what == other.what; }
};

}  // namespace window_ingress::estimation
