#pragma once

#include <memory>
#include <optional>

#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/pose/consistency_monitor.hpp"
#include "window_ingress/pose/filter_params.hpp"
#include "window_ingress/pose/window_pose_estimate.hpp"

namespace window_ingress::pose {

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
  };
  std::optional<Alternative> alternative;

  /// The opening that goes with the pose, and its covariance: width, height [m]. What is called known is as
  /// good as `FilterParams::known_size_sigma` says; what is not is estimated.
  geometry::OpeningSize opening;
  Eigen::Matrix2d opening_covariance = Eigen::Matrix2d::Zero();

  Consistency consistency;
};

/// Carries both planar hypotheses until the images, seen from a moving vehicle, have killed one. A size of
/// the opening that is not known is estimated along with them; it outlives a restart, but no other window.
class WindowFilter {
 public:
  /// \throws std::invalid_argument that lists every parameter out of range
  explicit WindowFilter(const FilterParams& params);
  ~WindowFilter();
  WindowFilter(WindowFilter&&) noexcept;
  WindowFilter& operator=(WindowFilter&&) noexcept;

  /// A new `target_id`, a jump of the clock or a long silence starts anew.
  /// \param estimate computed with the opening of `openingFor`
  /// \param T_odom_camera from odometry, interpolated to the image's stamp
  /// \return false if the observation was gated out or is older than the last one
  bool update(const WindowPoseEstimate& estimate, const detection::WindowObservation& window,
              const geometry::PinholeCamera& camera, const Eigen::Isometry3d& T_odom_camera);

  /// The same without a pose of its own, for a window of which only some borders are seen. Never starts a
  /// filter.
  bool update(const detection::WindowObservation& window, const geometry::PinholeCamera& camera,
              const Eigen::Isometry3d& T_odom_camera);

  /// The size to estimate a pose with: `nominal` where it is known; else what was found so far; else the
  /// height of `nominal` and the aspect that the image shows.
  geometry::OpeningSize openingFor(const detection::WindowObservation& window,
                                   const geometry::PinholeCamera& camera,
                                   const geometry::OpeningSize& nominal) const;

  /// Where the window should be in an image taken now; nothing without a state or if it is not wholly in
  /// front.
  std::optional<geometry::Quadrilateral> predictedCorners(double now_sec,
                                                          const geometry::PinholeCamera& camera,
                                                          const Eigen::Isometry3d& T_odom_camera) const;

  /// The state as of the last update, with its covariance grown by odometry drift until `now_sec`; nothing
  /// before the first update or after `max_age_sec` without one.
  std::optional<FilteredWindow> state(double now_sec) const;

  void reset();
  /// The odometry frame is another one: places are void, the size of the opening is not.
  void forgetPlaces();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace window_ingress::pose
