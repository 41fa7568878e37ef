#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/estimation/pose_params.hpp"
#include "window_ingress/estimation/size_estimate.hpp"
#include "window_ingress/geometry/euler_angles.hpp"
#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::estimation {

/// Direction of "up" in the camera at the exposure: a soft prior that never chooses between the two
/// solutions.
struct GravityPrior {
  Eigen::Vector3d up_camera = Eigen::Vector3d(0, -1, 0);  ///< unit vector, optical frame
  double sigma_rad = 0.02;                                ///< of the attitude, mounting included
};

/// True if the prior can be used: finite, a direction, a spread of more than 1e-6 rad.
inline bool isUsable(const GravityPrior& prior) {
  return prior.up_camera.allFinite() && prior.up_camera.norm() > 1e-6 && prior.sigma_rad > 1e-6 &&
         prior.sigma_rad < 1e6;
}

/// Covariance of a pose: x, y, z [m], then rotations about the fixed x, y, z axes of the parent frame [rad]
/// (the order of geometry_msgs/PoseWithCovariance).
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// One of the two poses that explain a planar rectangle.
struct PlanarSolution {
  Eigen::Isometry3d T_camera_window = Eigen::Isometry3d::Identity();
  Matrix6d covariance = Matrix6d::Zero();  ///< in the camera frame
  double reprojection_rms_px = 0.0;        ///< per coordinate, of the four corners
  /// Half the sum of squared, sigma-weighted residuals of image and size.
  double cost = 0.0;
  geometry::OpeningSize opening;                                     ///< the size at which it fits best
  Eigen::Matrix2d opening_log_covariance = Eigen::Matrix2d::Zero();  ///< of (log width, log height)
};

/// Width over height of the opening.
struct MeasuredAspect {
  double ratio = 0.0;
  double sigma = 0.0;
};

/// Pose of the window relative to the camera, from one image.
struct WindowPoseEstimate {
  double stamp_sec = 0.0;
  PlanarSolution best;                        ///< the likelier of the two
  std::optional<PlanarSolution> alternative;  ///< the other local minimum, where there is one

  /// Heading of the window's axis against the camera's, about the vertical (gravity's if known, else the
  /// camera's own): 0 when square to the window, positive when the window's axis points to the left of the
  /// camera's.
  double yaw_rad = 0.0;
  double yaw_sigma_rad = 0.0;  ///< with the opening's size known
  /// Heading of the window's axis against the horizontal line of sight to the window's centre: 0 on the axis.
  /// The two planar solutions differ in its sign, which gives the side to which the vehicle must move.
  double yaw_from_sight_rad = 0.0;
  /// Spread of the yaw with the opening's size unknown, i.e. from keystone alone; decides about the sign.
  double sigma_u_rad = 0.0;
  double log_likelihood_ratio = 0.0;  ///< best over alternative, >= 0; 1e9 stands for infinity
  /// The signs of yaw_rad and of yaw_from_sight_rad are known: sigma_u is less than a third of either, and
  /// the likelihood ratio confirms it.
  bool sign_trusted = false;

  geometry::OpeningSize opening;  ///< size used for the pose: known, or of best fit
  Eigen::Matrix2d opening_log_covariance = Eigen::Matrix2d::Zero();  ///< of (log width, log height)

  /// Width over height as measured in this image alone, without prior knowledge; only from a whole view.
  std::optional<MeasuredAspect> aspect;

  geometry::EulerAngles euler;    ///< the paper's angles of R_camera_window, taken in forward-left-up axes
  double opening_width_m = 0.0;   ///< apparent width from here, largest when square to the window
  double opening_height_m = 0.0;  ///< apparent height from here
  double left_side_px = 0.0;      ///< length of the left border in the undistorted image
  double right_side_px = 0.0;     ///< length of the right border in the undistorted image
};

/// Why there is no pose.
enum class PoseReject {
  kNone,
  kBadCamera,
  kBadCorners,
  kNotInFront,
  kReprojection,
  kRange,
  kTilt,
  kNotFinite
};

const char* toString(PoseReject reject);

struct PoseResult {
  std::optional<WindowPoseEstimate> estimate;
  PoseReject reject = PoseReject::kNone;
  std::string detail;  ///< for people, with numbers: "reprojection 4.2 px > 3.0 px"
};

/// Prior knowledge for one image of the window. Unusable values are ignored.
struct PoseHints {
  std::optional<GravityPrior> gravity = std::nullopt;
  std::optional<SizeEstimate> size = std::nullopt;  ///< instead of the parameters' size
};

/// One observation and a calibration to the relative pose (P11, P12). Stateless.
class WindowPoseEstimator {
 public:
  /// \throws std::invalid_argument that lists every parameter out of range
  explicit WindowPoseEstimator(const PoseParams& params);

  /// \param window corners in any cyclic order (turned upright by gravity, or else by the camera's own up);
  ///        for a partial view, four visible borders
  PoseResult estimate(const detection::WindowObservation& window, const geometry::PinholeCamera& camera,
                      const PoseHints& hints = {}) const;

  const PoseParams& params() const { return params_; }

 private:
  PoseParams params_;
};

}  // namespace window_ingress::estimation
