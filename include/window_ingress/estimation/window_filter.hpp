#pragma once

#include <memory>
#include <optional>

#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/estimation/consistency_monitor.hpp"
#include "window_ingress/estimation/filter_params.hpp"
#include "window_ingress/estimation/size_estimate.hpp"
#include "window_ingress/estimation/target_motion.hpp"
#include "window_ingress/estimation/window_pose_estimator.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::estimation {

/// Systematic error of the camera's attitude: rotation of the true camera against the attitude from odometry
/// and mounting, about its x (pitch), y (yaw) and z (roll) axes.
struct CameraTurn {
  Eigen::Vector3d turn_rad = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  /// Yaw error plus the error of odometry's heading: this sum carries the vehicle off its course.
  double with_heading_rad = 0.0, with_heading_sigma_rad = 0.0;
};

/// The window in the odometry frame, upright: position and yaw, filtered over time.
struct FilteredWindow {
  double stamp_sec = 0.0;  ///< of the last image that contributed
  double age_sec = 0.0;    ///< age of that image at the requested time
  Eigen::Isometry3d T_odom_window = Eigen::Isometry3d::Identity();
  Matrix6d covariance = Matrix6d::Zero();  ///< odom axes; x, y, z [m], rotations [rad]
  bool sign_trusted = false;               ///< one planar hypothesis is left, or the other is irrelevant
  double hypothesis_weight = 1.0;          ///< of the reported hypothesis, 0.5 to 1
  int updates = 0;                         ///< images that contributed since the last reset

  /// The other planar solution, while it is kept; its weight is 1 - hypothesis_weight.
  struct Alternative {
    Eigen::Isometry3d T_odom_window = Eigen::Isometry3d::Identity();
    Matrix6d covariance = Matrix6d::Zero();
    CameraTurn camera_turn;
  };
  std::optional<Alternative> alternative;

  /// The opening's size for this pose. A known size has the error `FilterParams::kKnownSizeSigma`; an unknown
  /// one is estimated.
  SizeEstimate size;

  CameraTurn camera_turn;
  Consistency consistency;
  TargetMotion motion;  ///< of the window; fixed if `FilterParams::target_speed_mps` is 0
};

/// Keeps both planar hypotheses until images from a moving vehicle have ruled one out. An unknown size of the
/// opening is estimated with them; it survives a restart, but not a change of window.
class WindowFilter {
 public:
  /// \param size prior knowledge of the opening; without it, the opening of each estimate counts as known
  /// \throws std::invalid_argument that lists every parameter out of range
  explicit WindowFilter(const FilterParams& params, const std::optional<SizeEstimate>& size = std::nullopt);
  ~WindowFilter();
  WindowFilter(WindowFilter&&) noexcept;
  WindowFilter& operator=(WindowFilter&&) noexcept;

  /// A new `target_id`, a jump of the clock or a long silence restarts the filter.
  /// \param estimate computed with the size of `sizeOf`; a partial window may come without, but never starts
  ///        a filter
  /// \param T_odom_camera from odometry, interpolated to the image's stamp
  /// \param motion motion at that stamp; matters if odometry's stamps may be late
  /// \return false if the observation is an outlier or older than the last one
  bool update(const std::optional<WindowPoseEstimate>& estimate, const detection::WindowObservation& window,
              const geometry::PinholeCamera& camera, const Eigen::Isometry3d& T_odom_camera,
              const CameraMotion& motion = {});

  /// Size of the window in this observation, for the estimator: the prior, or what was found since; nothing
  /// if there is neither.
  std::optional<SizeEstimate> sizeOf(const detection::WindowObservation& window) const;

  /// The state as of the last update, with its covariance grown by odometry drift until `now_sec`; nothing
  /// before the first update or after `max_age_sec` without one.
  std::optional<FilteredWindow> state(double now_sec) const;

  void reset();
  /// Sets the drift of odometry from now on; the parameter is its minimum [m/sqrt(s)].
  void assumeDrift(double m_per_sqrt_sec);
  /// The odometry frame changed: forgets places, keeps the size of the opening.
  void forgetPlaces();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace window_ingress::estimation
