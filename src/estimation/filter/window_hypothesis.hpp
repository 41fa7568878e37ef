#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "estimation/filter/window_state.hpp"
#include "estimation/planar/image_measurement.hpp"
#include "window_ingress/estimation/filter_params.hpp"
#include "window_ingress/estimation/size_estimate.hpp"
#include "window_ingress/estimation/window_pose_estimator.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::estimation {

/// One image as the filter sees it.
struct FilterView {
  const ImageMeasurement& image;  ///< weighted by what it adds to earlier images from its place
  const ImageMeasurement& alone;  ///< weighted as the first image from its place, for the outlier test
  const geometry::PinholeCamera& camera;
  Eigen::Isometry3d T_odom_camera;
  /// Offset of the camera's position from its smooth path. The scale is learned from that path alone: jitter
  /// mistaken for motion would look like flight past a window of infinite size.
  Eigen::Vector3d jitter_m = Eigen::Vector3d::Zero();
  bool moves = true;         ///< false: this image says nothing about the scale
  CameraMotion motion = {};  ///< matters if odometry's stamps may be late
};

/// Estimate of the camera's yaw on the vehicle, and of odometry's heading against its positions.
struct YawBias {
  double rad = 0.0, sigma_rad = 0.0;
};

/// One belief about the window in the odometry frame: an iterated extended Kalman filter on `WindowState`.
class WindowHypothesis {
 public:
  /// A wide prior around a pose from a single image; the image itself must still be applied.
  /// \param anchor_m of the state: the camera's position at that image
  WindowHypothesis(const FilterParams& params, const Eigen::Isometry3d& T_odom_window,
                   const SizeEstimate& size, const YawBias& yaw_bias, const Eigen::Vector3d& anchor_m);

  /// Predicts over time and the way flown to the camera's position: odometry drifts, attitude errors fade.
  void predict(const FilterParams& params, double elapsed_sec, double way_m,
               const Eigen::Vector3d& camera_position);
  /// Adds an uncertainty of odometry's heading, which moves the window around the camera.
  /// \param lasts the camera's yaw on the vehicle has the same error, which is then learned
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
  /// Standard deviation of `yawFromSight`; without heading errors, which turn the window about the camera.
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
