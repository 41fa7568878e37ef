#pragma once

#include <memory>
#include <optional>

#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/estimation/camera_motion.hpp"
#include "window_ingress/estimation/consistency_monitor.hpp"
#include "window_ingress/estimation/filter_params.hpp"
#include "window_ingress/estimation/size_estimate.hpp"
#include "window_ingress/estimation/target_motion.hpp"
#include "window_ingress/estimation/window_pose_estimate.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::estimation {

/// Lasting error of the camera's attitude: rotation of the true camera against the one that odometry and
/// mounting make, about its x (pitch), y (yaw) and z (roll) axes.
struct CameraTurn {
  Eigen::Vector3d turn_rad = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  /// About y, with the error of odometry's heading: what carries the vehicle off its way.
  double with_heading_rad = 0.0, with_heading_sigma_rad = 0.0;
};

/// The window in the odometry frame, upright: position and yaw, filtered over time.
struct FilteredWindow {
  double stamp_sec = 0.0;  ///< of the last image that contributed
  double age_sec = 0.0;    ///< of that image, at the time asked for
  Eigen::Isometry3d T_odom_window = Eigen::Isometry3d::Identity();
  Matrix6d covariance = Matrix6d::Zero();  ///< odom axes; x, y, z [m], rotations [rad]
  bool sign_trusted = false;               ///< one planar hypothesis is left, or the other cannot matter
  double hypothesis_weight = 1.0;          ///< of the reported hypothesis, 0.5 to 1
  int updates = 0;                         ///< images that contributed since the last reset

  /// The other planar solution while it lives; its weight is 1 - hypothesis_weight.
  struct Alternative {
    Eigen::Isometry3d T_odom_window = Eigen::Isometry3d::Identity();
    Matrix6d covariance = Matrix6d::Zero();
    CameraTurn camera_turn;
  };
  std::optional<Alternative> alternative;

  /// The opening's size that goes with the pose. What is called known is as good as
  /// `FilterParams::kKnownSizeSigma` says; what is not is estimated.
  SizeEstimate size;

  CameraTurn camera_turn;
  Consistency consistency;
  TargetMotion motion;  ///< of the window; stands still unless `FilterParams::target_speed_mps` says else
};

/// Carries both planar hypotheses until the images, seen from a moving vehicle, have killed one. A size of
/// the opening that is not known is estimated along with them; it outlives a restart, but no other window.
class WindowFilter {
 public:
  /// \param size what is known of the opening before any image; without it, the opening of each estimate is
  ///        taken as known
  /// \throws std::invalid_argument that lists every parameter out of range
  explicit WindowFilter(const FilterParams& params, const std::optional<SizeEstimate>& size = std::nullopt);
  ~WindowFilter();
  WindowFilter(WindowFilter&&) noexcept;
  WindowFilter& operator=(WindowFilter&&) noexcept;

  /// A new `target_id`, a jump of the clock or a long silence starts anew.
  /// \param estimate computed with the size of `sizeOf`; a window of which only some borders are seen may be
  ///        without, but never starts a filter
  /// \param T_odom_camera from odometry, interpolated to the image's stamp
  /// \param motion at that stamp; matters where odometry's stamps may be late
  /// \return false if the observation was gated out or is older than the last one
  bool update(const std::optional<WindowPoseEstimate>& estimate, const detection::WindowObservation& window,
              const geometry::PinholeCamera& camera, const Eigen::Isometry3d& T_odom_camera,
              const CameraMotion& motion = {});

  /// What is known of the size of the window in this observation, for the estimator: what the filter was made
  /// with, or what was found since; nothing if neither is there.
  std::optional<SizeEstimate> sizeOf(const detection::WindowObservation& window) const;

  /// The state as of the last update, with its covariance grown by odometry drift until `now_sec`; nothing
  /// before the first update or after `max_age_sec` without one.
  std::optional<FilteredWindow> state(double now_sec) const;

  void reset();
  /// Odometry walks so much from here on, but no less than the parameters say [m/sqrt(s)].
  void assumeDrift(double m_per_sqrt_sec);
  /// The odometry frame is another one: places are void, the size of the opening is not.
  void forgetPlaces();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace window_ingress::estimation
