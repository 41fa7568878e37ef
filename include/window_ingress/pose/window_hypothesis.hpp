#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/pose/filter_params.hpp"
#include "window_ingress/pose/image_measurement.hpp"
#include "window_ingress/pose/window_pose_estimate.hpp"

namespace window_ingress::pose {

/// One image as the filter sees it.
struct FilterView {
  const ImageMeasurement& image;
  const geometry::PinholeCamera& camera;
  geometry::OpeningSize opening;
  Eigen::Isometry3d T_odom_camera;
};

/// One belief about the window in the odometry frame: an iterated extended Kalman filter.
///
/// State: position in odom [m], yaw about odom's z [rad], and the lasting error of the camera's attitude
/// about its own x axis (pitch) and z axis (roll) [rad], which odometry cannot know. The window itself stands
/// upright.
class WindowHypothesis {
 public:
  using State = Eigen::Matrix<double, 6, 1>;
  enum Index { kX, kY, kZ, kYaw, kPitchBias, kRollBias };

  /// A wide prior around a pose from a single image; the image itself is still to be applied.
  WindowHypothesis(const FilterParams& params, const Eigen::Isometry3d& T_odom_window,
                   double yaw_sigma_rad = kWideYawSigmaRad);
  static constexpr double kWideYawSigmaRad = 0.7;

  /// Time passes and the camera moves: odometry drifts, attitude errors fade.
  void predict(const FilterParams& params, double elapsed_sec, const Eigen::Vector3d& camera_from,
               const Eigen::Vector3d& camera_to);

  struct Outcome {
    double squares = 0.0;       ///< normalised innovation squared
    double log_evidence = 0.0;  ///< log density of the image given the belief before it
  };
  /// Applies one image. Nothing, and nothing changed, if the belief puts the window behind the camera.
  std::optional<Outcome> update(const FilterParams& params, const FilterView& view);

  Eigen::Isometry3d T_odom_window() const;
  Eigen::Isometry3d T_camera_window(const Eigen::Isometry3d& T_odom_camera) const;
  double yawSigma() const { return std::sqrt(covariance_(kYaw, kYaw)); }
  const State& state() const { return state_; }
  const Matrix6d& covariance() const { return covariance_; }

  /// Angle of the window's axis against the horizontal line of sight [rad]: 0 when seen along its axis.
  double yawFromSight(const Eigen::Vector3d& camera_position) const;
  /// The other planar solution: yaw mirrored about the line of sight.
  WindowHypothesis mirrored(const Eigen::Vector3d& camera_position) const;
  /// One belief with mean and spread of both; `share` is the weight of the other one, 0 to 1.
  WindowHypothesis mergedWith(const WindowHypothesis& other, double share) const;
  /// Squared Mahalanobis distance of position and yaw.
  double distanceTo(const WindowHypothesis& other) const;

 private:
  friend struct HypothesisFit;
  State state_;
  Matrix6d covariance_;
};

}  // namespace window_ingress::pose
