#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "estimation/filter/window_state.hpp"
#include "estimation/planar/image_measurement.hpp"
#include "window_ingress/estimation/filter_params.hpp"
#include "window_ingress/estimation/size_estimate.hpp"
#include "window_ingress/estimation/window_pose_estimate.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::estimation {

/// One image as the filter sees it.
struct FilterView {
  const ImageMeasurement& image;  ///< given the weight that it has beside those already taken from its place
  const ImageMeasurement&
      alone;  ///< the same, as if it were the first from its place: decides about outliers
  const geometry::PinholeCamera& camera;
  Eigen::Isometry3d T_odom_camera;
  /// How far the camera's position lies from the smooth way that it is on. The scale is learned from the way
  /// alone: jitter that was taken for motion would pass for a way flown past a window of infinite size.
  Eigen::Vector3d jitter_m = Eigen::Vector3d::Zero();
  bool moves = true;         ///< else this image tells nothing about the scale
  CameraMotion motion = {};  ///< matters where odometry's stamps may be late
};

/// What is known of the camera's yaw on the vehicle, and of odometry's heading beside its positions.
struct YawBias {
  double rad = 0.0, sigma_rad = 0.0;
};

/// One belief about the window in the odometry frame: an iterated extended Kalman filter on `WindowState`.
class WindowHypothesis {
 public:
  /// A wide prior around a pose from a single image; the image itself is still to be applied.
  /// \param anchor_m of the state: the camera's position at that image
  WindowHypothesis(const FilterParams& params, const Eigen::Isometry3d& T_odom_window,
                   const SizeEstimate& size, const YawBias& yaw_bias, const Eigen::Vector3d& anchor_m);

  /// Time passes and the camera flies a way to its position: odometry drifts, attitude errors fade.
  void predict(const FilterParams& params, double elapsed_sec, double way_m,
               const Eigen::Vector3d& camera_position);
  /// An error of odometry's heading: it carries the window around the camera.
  /// \param lasts the camera's yaw on the vehicle is taken to be off by the same, and learned
  void addTurn(double sigma_rad, const Eigen::Vector3d& camera_position, bool lasts = false);

  struct Outcome {
    double squares = 0.0;       ///< normalised innovation squared of `FilterView::alone`
    double log_evidence = 0.0;  ///< log density of the image given the belief before it
  };
  /// Applies one image. Nothing, and nothing changed, if the belief puts the window behind the camera.
  std::optional<Outcome> update(const FilterParams& params, const FilterView& view);

  const WindowState& state() const { return state_; }
  const WindowState::Matrix& covariance() const { return covariance_; }
  Eigen::Isometry3d T_odom_window() const { return state_.T_odom_window(); }
  Eigen::Matrix4d poseCovariance() const;      ///< x, y, z [m], yaw [rad]; odom axes
  Eigen::Matrix3d velocityCovariance() const;  ///< of the window, odom axes [(m/s)^2]
  SizeEstimate size() const;
  YawBias yawBias() const {
    return {state_.values(WindowState::kYawBias),
            std::sqrt(covariance_(WindowState::kYawBias, WindowState::kYawBias))};
  }

  /// Angle of the window's axis against the horizontal line of sight [rad]: 0 when seen along its axis.
  double yawFromSight(const Eigen::Vector3d& camera_position) const;
  /// An error of the heading turns the window about the camera, and is not in it.
  double yawFromSightSigma(const Eigen::Vector3d& camera_position) const;
  /// The other planar solution: yaw mirrored about the line of sight.
  WindowHypothesis mirrored(const Eigen::Vector3d& camera_position) const;
  /// One belief with mean and spread of both; `share` is the weight of the other one, 0 to 1. Same anchor.
  WindowHypothesis mergedWith(const WindowHypothesis& other, double share) const;
  /// Squared Mahalanobis distance of place and yaw.
  double distanceTo(const WindowHypothesis& other) const;

 private:
  Eigen::RowVector4d yawFromSightByPose(const Eigen::Vector3d& camera_position) const;
  void move(const MotionModel& motion, double elapsed_sec);
  void keepScale(double inverse_height, double variance);

  WindowState state_;
  WindowState::Matrix covariance_;
};

}  // namespace window_ingress::estimation
