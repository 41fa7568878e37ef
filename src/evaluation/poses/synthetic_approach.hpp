#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "simulation/random_stream.hpp"
#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/estimation/filter_params.hpp"
#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::evaluation {

/// Configuration faults, unknown to the code under test.
struct FrameFaults {
  Eigen::Vector3d mounting_rad = Eigen::Vector3d::Zero();  ///< the camera is turned about the body's x, y, z
  std::string mounting_axes = "right";  ///< right; optical: an identity; left, right_side, behind
  std::string twist = "body";           ///< body; world, swapped (x and y), ned (y and z mirrored)
  bool mirrored_odometry = false;       ///< x and y of the position exchanged
};

/// A path through points in the window's frame at nearly constant speed.
struct ApproachScript {
  std::vector<Eigen::Vector3d> waypoints_m;  ///< of the vehicle; x < 0 in front of the window
  double speed_mps = 0.6;
  double wait_sec = 0.5;  ///< wait at the first point
  double image_rate_hz = 20.0;
  double sway_rad = 0.03;  ///< amplitude of the true roll and pitch
  geometry::OpeningSize opening{1.2, 1.0};
};

/// From `distance_m` and `off_axis_rad` onto the axis, then in, up to `end_m` in front of the plane.
ApproachScript ontoAxisAndIn(double distance_m, double off_axis_rad, double height_m, double end_m);

/// An approach without images: simulated odometry, attitude estimator and ideal border detector, with random
/// errors as stated in `FilterParams` (drift in place and heading, jitter, systematic errors of attitude and
/// of corners) and white noise of each border sample. For Monte Carlo: about 10,000 images a second.
class SyntheticApproach {
 public:
  SyntheticApproach(std::uint32_t seed, const ApproachScript& script, const estimation::FilterParams& errors,
                    const FrameFaults& faults = {});

  static constexpr double kSampleSigmaPx = 0.5;  ///< of each border sample, one per pixel
  static constexpr double kOdometryRateHz = 50.0;

  /// \return false at the end of the path
  bool advance();

  double timeSec() const { return time_sec_; }
  double flownM() const { return flown_m_; }
  const geometry::PinholeCamera& camera() const { return camera_; }
  const Eigen::Isometry3d& T_base_camera() const { return T_base_camera_; }  ///< as configured
  /// Odometry as reported, since the last image up to this one.
  struct Odometry {
    double stamp_sec;
    Eigen::Isometry3d T_odom_base;
    Eigen::Vector3d velocity_odom_mps;  ///< computed as if the twist were in body axes
  };
  const std::vector<Odometry>& odometry() const { return odometry_; }
  const detection::WindowObservation& window() const { return window_; }
  bool isInView() const { return in_view_; }  ///< all corners are in view; otherwise there is no observation

  /// Truth, now.
  Eigen::Isometry3d T_odom_window() const { return T_odom_world_; }
  const Eigen::Vector3d& positionM() const { return position_m_; }  ///< window frame
  double relativeYawRad() const { return -heading_rad_; }           ///< yaw of the window against the vehicle

 private:
  void move(double dt_sec);
  void drift(double dt_sec, double moved_m);
  void reportOdometry(double stamp_sec);
  void look();
  Eigen::Isometry3d T_window_base() const;
  Eigen::Isometry3d reportedBase();

  ApproachScript script_;
  estimation::FilterParams errors_;
  FrameFaults faults_;
  simulation::RandomStream random_;
  geometry::PinholeCamera camera_;
  Eigen::Isometry3d T_base_camera_, T_base_camera_true_;
  Eigen::Isometry3d T_odom_world_;  ///< the world frame is the window's
  double time_sec_ = 1.0, flown_m_ = 0.0;
  std::size_t next_ = 1;
  Eigen::Vector3d position_m_, velocity_mps_ = Eigen::Vector3d::Zero();
  double heading_rad_ = 0.0, roll_rad_ = 0.0, pitch_rad_ = 0.0;
  Eigen::Vector2d attitude_bias_rad_;
  Eigen::Matrix<double, 8, 1> bias_px_;
  Eigen::Vector3d bias_from_m_;
  std::vector<Odometry> odometry_;
  detection::WindowObservation window_;
  bool in_view_ = false;
};

}  // namespace window_ingress::evaluation
