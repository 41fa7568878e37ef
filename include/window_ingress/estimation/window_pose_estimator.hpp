#pragma once

#include <optional>
#include <string>

#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/estimation/gravity_prior.hpp"
#include "window_ingress/estimation/pose_params.hpp"
#include "window_ingress/estimation/size_estimate.hpp"
#include "window_ingress/estimation/window_pose_estimate.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::estimation {

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
