#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "simulation/random_stream.hpp"
#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/estimation/filter_params.hpp"
#include "window_ingress/geometry/euler_angles.hpp"
#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::evaluation {

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
inline ApproachScript ontoAxisAndIn(double distance_m, double off_axis_rad, double height_m, double end_m) {
  ApproachScript script;
  const double x = -distance_m * std::cos(off_axis_rad), y = distance_m * std::sin(off_axis_rad);
  script.waypoints_m = {{x, y, height_m}, {0.75 * x, 0.0, 0.0}, {-end_m, 0.0, 0.0}};
  return script;
}

/// An approach without images: simulated odometry, attitude estimator and ideal border detector, with random
/// errors as stated in `FilterParams` (drift in place and heading, jitter, systematic errors of attitude and
/// of corners) and white noise of each border sample. For Monte Carlo: about 10,000 images a second.
class SyntheticApproach {
 public:
  SyntheticApproach(std::uint32_t seed, const ApproachScript& script, const estimation::FilterParams& errors)
      : script_(script),
        errors_(errors),
        random_(seed, "synthetic approach"),
        camera_(geometry::PinholeCamera::fromFieldOfView(640, 480, 1.2)),
        position_m_(script.waypoints_m.front()),
        bias_from_m_(position_m_) {
    T_base_camera_ = geometry::makePose(geometry::R_optical_flu().transpose(), {0.1, 0.0, 0.02});
    T_base_camera_true_ = T_base_camera_;
    T_base_camera_true_.linear() *= turned({0.0, random_.normal(errors.mounting_yaw_sigma_rad), 0.0});
    const Eigen::Vector3d place(random_.uniform(-5, 5), random_.uniform(-5, 5), 1.5);
    T_odom_world_ = geometry::makePose(geometry::yawRotation(random_.uniform(-M_PI, M_PI)), place);
    attitude_bias_rad_ = random_.normals(errors.attitude_bias_sigma_rad).head<2>();
    for (int i = 0; i < 8; ++i) bias_px_(i) = random_.normal(errors.systematic_sigma_px);
    heading_rad_ = std::atan2(-position_m_.y(), -position_m_.x());
    look();
  }

  static constexpr double kSampleSigmaPx = 0.5;  ///< of each border sample, one per pixel
  static constexpr double kOdometryRateHz = 50.0;

  /// \return false at the end of the path
  bool advance() {
    if (next_ >= script_.waypoints_m.size()) return false;
    odometry_.clear();
    const double image_sec = time_sec_ + 1.0 / script_.image_rate_hz, step_sec = 1.0 / kOdometryRateHz;
    while (time_sec_ + 1e-9 < image_sec) {
      const double dt_sec = std::min(step_sec, image_sec - time_sec_);
      time_sec_ += dt_sec;
      move(dt_sec);
      reportOdometry(time_sec_);
    }
    look();
    return true;
  }

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
  static constexpr double kFollowSec = 0.25;  // response time of the velocity to the command
  static constexpr double kReachedM = 0.1;
  static constexpr double kSwayHz = 0.4;

  static Eigen::Matrix3d turned(const Eigen::Vector3d& vector) {
    const double angle = vector.norm();
    if (!(angle > 0.0)) return Eigen::Matrix3d::Identity();
    return Eigen::AngleAxisd(angle, vector / angle).matrix();
  }

  Eigen::Isometry3d T_window_base() const {
    return geometry::makePose(geometry::rotationFromEuler({roll_rad_, pitch_rad_, heading_rad_}),
                              position_m_);
  }

  void move(double dt_sec) {
    const Eigen::Vector3d to_go =
        script_.waypoints_m[std::min(next_, script_.waypoints_m.size() - 1)] - position_m_;
    if (to_go.norm() < kReachedM) ++next_;
    const bool waits = time_sec_ < 1.0 + script_.wait_sec;
    const Eigen::Vector3d wish =
        waits ? Eigen::Vector3d::Zero() : Eigen::Vector3d(script_.speed_mps * to_go.normalized());
    velocity_mps_ += (wish - velocity_mps_) * std::min(1.0, dt_sec / kFollowSec);
    const Eigen::Vector3d step = velocity_mps_ * dt_sec;
    drift(dt_sec, step.norm());
    position_m_ += step;
    flown_m_ += step.norm();
    heading_rad_ = std::atan2(-position_m_.y(), -position_m_.x());
    const double phase = 2.0 * M_PI * kSwayHz * time_sec_;
    roll_rad_ = script_.sway_rad * std::sin(phase);
    pitch_rad_ = script_.sway_rad * std::cos(1.3 * phase);
  }

  void drift(double dt_sec, double moved_m) {
    const double kept = std::exp(-dt_sec / errors_.attitude_bias_time_sec);
    const double fresh = errors_.attitude_bias_sigma_rad * std::sqrt(1.0 - kept * kept);
    attitude_bias_rad_ = kept * attitude_bias_rad_ + random_.normals(fresh).head<2>();
    const Eigen::Vector3d before = T_odom_world_ * position_m_;
    const double sigma = std::hypot(errors_.drift_m_per_sqrt_sec * std::sqrt(dt_sec),
                                    errors_.drift_m_per_sqrt_m * std::sqrt(moved_m));
    const double yaw = random_.normal(errors_.drift_rad_per_sqrt_sec * std::sqrt(dt_sec));
    T_odom_world_.linear() = geometry::yawRotation(yaw) * T_odom_world_.linear();
    T_odom_world_.translation() = before + random_.normals(sigma) - T_odom_world_.linear() * position_m_;
  }

  Eigen::Isometry3d reportedBase() {
    Eigen::Isometry3d T = T_odom_world_ * T_window_base();
    T.linear() *= turned({attitude_bias_rad_.x(), attitude_bias_rad_.y(), 0.0});
    T.translation() += random_.normals(errors_.odom_position_sigma_m);
    T.linear() *= turned(random_.normals(errors_.odom_attitude_sigma_rad));
    return T;
  }

  void reportOdometry(double stamp_sec) {
    Odometry sample;
    sample.stamp_sec = stamp_sec;
    sample.T_odom_base = reportedBase();
    const Eigen::Vector3d velocity_odom = T_odom_world_.linear() * velocity_mps_ + random_.normals(0.03);
    const Eigen::Vector3d twist = sample.T_odom_base.linear().transpose() * velocity_odom;
    sample.velocity_odom_mps = sample.T_odom_base.linear() * twist;
    odometry_.push_back(sample);
  }

  void look() {
    if ((position_m_ - bias_from_m_).norm() > estimation::FilterParams::kSystematicRenewalM) {
      bias_from_m_ = position_m_;
      for (int i = 0; i < 8; ++i) bias_px_(i) = random_.normal(errors_.systematic_sigma_px);
    }
    window_ = {};
    window_.stamp_sec = time_sec_;
    window_.target_id = 1;
    const auto corners =
        geometry::projectOpening(camera_, (T_window_base() * T_base_camera_true_).inverse(), script_.opening);
    in_view_ = corners && std::all_of(corners->begin(), corners->end(),
                                      [this](const auto& corner) { return camera_.contains(corner, 2.0); });
    if (!in_view_) return;
    for (int i = 0; i < 4; ++i) window_.corners[i] = (*corners)[i] + bias_px_.segment<2>(2 * i);
    std::array<Eigen::Vector3d, 4> lines;
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector2d a = window_.corners[i], b = window_.corners[(i + 1) % 4],
                            along = (b - a).normalized();
      const Eigen::Vector2d across(-along.y(), along.x());
      const double length = (b - a).norm(), sigma_px = kSampleSigmaPx / std::sqrt(length);
      const double sigma_rad = sigma_px * std::sqrt(12.0) / length;
      const Eigen::Vector2d middle = 0.5 * (a + b) + random_.normal(sigma_px) * across;
      const Eigen::Vector2d direction = along + random_.normal(sigma_rad) * across;
      lines[i] = middle.homogeneous().cross((middle + length * direction).homogeneous());
      window_.edges[i] = {true, sigma_px, sigma_rad, a, b};
    }
    for (int i = 0; i < 4; ++i) {
      window_.corners[i] = lines[(i + 3) % 4].cross(lines[i]).hnormalized();
      window_.corner_covariance[i] = 0.01 * Eigen::Matrix2d::Identity();
    }
  }

  ApproachScript script_;
  estimation::FilterParams errors_;
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
