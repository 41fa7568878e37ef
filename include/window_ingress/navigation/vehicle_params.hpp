/// Properties of the vehicle (config/vehicle.yaml).
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

namespace window_ingress::navigation {

/// Frame names that messages must carry.
struct FrameNames {
  std::string odom = "odom";       ///< frame_id of the odometry
  std::string base = "base_link";  ///< frame of the vehicle's body: child_frame_id of the odometry

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("odom_frame", self.odom);
    field("base_frame", self.base);
  }
};

/// How old and how far ahead of the clock a message may be.
struct StampLimits {
  double max_age_sec = 0.5;     ///< messages older than this are refused [s]
  double max_future_sec = 0.2;  ///< messages further ahead of the clock than this are refused [s]

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("max_age_sec", self.max_age_sec, 0.01, 60.0);
    field("max_future_sec", self.max_future_sec, 0.0, 0.5);
  }
};

/// Where the camera sits, and what a level vehicle sees through it.
struct CameraInBody {
  double forward_m = 0.1;  ///< distance of the camera ahead of the body's centre; tf overrides it [m]
  double horizontal_fov_rad = 1.39;  ///< horizontal field of view of the camera; camera_info overrides it
                                     ///< [rad]
  double vertical_fov_rad = 1.12;    ///< vertical field of view of the camera; camera_info overrides it [rad]
  double pixel_rad = 0.0018;  ///< angle of one pixel at the image centre, 1 / focal length; camera_info
                              ///< overrides it [rad]

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("camera_forward_m", self.forward_m, -1.0, 1.0);
    field("horizontal_fov_rad", self.horizontal_fov_rad, 0.3, 2.8);
    field("vertical_fov_rad", self.vertical_fov_rad, 0.3, 2.8);
    field("pixel_rad", self.pixel_rad, 1e-4, 0.1);
  }
};

/// Body, camera, odometry and response of the vehicle; one copy for all nodes.
struct VehicleParams {
  double half_length_m = 0.25;  ///< half the body's length, forward, propellers included [m]
  double half_width_m = 0.25;   ///< half the body's width, sideways, propellers included [m]
  double half_height_m = 0.12;  ///< half the body's height, propellers and legs included [m]
  double margin_m = 0.05;  ///< extra distance on each side between body and opening, on top of all errors [m]
  CameraInBody camera;
  double exposure_sec = 0.004;      ///< longest exposure of an image; limits the yaw rate of the search
                                    ///< (blur) [s]
  bool image_is_rectified = false;  ///< images are rectified: P of camera_info is used, not K and D
  double response_sec = 0.3;  ///< time from a setpoint until the velocity follows it, latency included [s]
  double braking_mps2 = 1.2;  ///< deceleration that can be relied upon [m/s^2]
  double odom_drift_m_per_sqrt_sec = 0.01;  ///< random walk of odometry's position over time [m/sqrt(s)]
  FrameNames frames;
  StampLimits stamps;
  std::optional<double> climb_response_sec;  ///< up and down; measured in flight, no parameter

  /// Response time of each axis: forward, sideways, up [s].
  Eigen::Vector3d responsesSec() const {
    return {response_sec, response_sec, climb_response_sec.value_or(response_sec)};
  }

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("half_length_m", self.half_length_m, 0.02, 2.0);
    field("half_width_m", self.half_width_m, 0.02, 2.0);
    field("half_height_m", self.half_height_m, 0.02, 2.0);
    field("margin_m", self.margin_m, 0.0, 1.0);
    CameraInBody::visit(self.camera, field);
    field("exposure_sec", self.exposure_sec, 0.0, 0.5);
    field("image_is_rectified", self.image_is_rectified);
    field("response_sec", self.response_sec, 0.05, 2.0);
    field("braking_mps2", self.braking_mps2, 0.2, 10.0);
    field("odom_drift_m_per_sqrt_sec", self.odom_drift_m_per_sqrt_sec, 0.0, 1.0);
    FrameNames::visit(self.frames, field);
    field.group("stamps", self.stamps);
  }
};

}  // namespace window_ingress::navigation
