#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "window_ingress/estimation/frames_verdict.hpp"
#include "window_ingress/estimation/window_filter.hpp"
#include "window_ingress/estimation/window_pose_estimator.hpp"

namespace window_ingress::estimation {

/// More than any heading that is off for long: it was turned a moment ago, or the camera is mounted askew.
constexpr double kMaxTurnWithHeadingRad = 0.09;

/// Whether the camera looks where its mounting says, and the opening has the size it is said to have: a
/// filter of its own that knows neither, fed with images a little apart. What moves past the camera while
/// odometry flies a known way tells both. Heading and stamps of odometry may be off, too.
///
/// Where that filter explains nothing, the mounting may be wrong by a right angle or more, or odometry's axes
/// exchanged: these are tried on the last images, and the one that explains them is named.
class MountingCheck {
 public:
  /// \param size what the opening is said to be; zero covariance: known, and so to be verified
  MountingCheck(const PoseParams& pose, const FilterParams& filter, const SizeEstimate& size);

  /// A filter begins with a whole window and goes on with what is left of it: a camera turned aside has the
  /// window at the image's border.
  void see(const detection::WindowObservation& window, const geometry::PinholeCamera& camera,
           const Eigen::Isometry3d& T_odom_base, const Eigen::Isometry3d& T_base_camera,
           const CameraMotion& motion = {});
  void startAnewForAnotherTarget(std::uint32_t seen_id);
  void clear();
  /// How much odometry's position is seen to walk [m/sqrt(s)].
  void assumeDrift(double m_per_sqrt_sec) { filter_.assumeDrift(m_per_sqrt_sec); }
  void forgetPlaces();  ///< the odometry frame is another one; what was found out stays
  FramesVerdict verdict() const { return verdict_; }

  /// The size as measured on the way flown, whatever it is said to be; nothing before there is one.
  const std::optional<SizeEstimate>& measuredSize() const { return measured_size_; }

 private:
  struct Image {
    detection::WindowObservation window;
    geometry::PinholeCamera camera;
    Eigen::Isometry3d T_odom_base, T_base_camera;
    CameraMotion motion;
  };
  struct Setup;
  struct Trial;
  static std::vector<Setup> setups();
  bool isFarFromLast(const Image& image) const;
  bool feed(WindowFilter& filter, const Image& image, const Eigen::Isometry3d& T_odom_camera) const;
  void keep(const Image& image);
  void judge();
  void judgeTurn(const FilteredWindow& found);
  std::string faultOfSize(const SizeEstimate& found) const;
  void tryNextSetups();
  double misfitOf(const Setup& setup) const;

  WindowPoseEstimator estimator_;
  FilterParams filter_params_;
  SizeEstimate said_, open_;
  WindowFilter filter_;
  std::deque<Image> images_;  ///< whole windows, for other setups
  struct Place {
    double stamp_sec;
    Eigen::Vector3d position_m;
  };
  std::optional<Place> last_;  ///< where the last image looked at was taken, whole or not
  int refused_ = 0;
  std::uint32_t target_id_ = 0;
  bool size_is_fault_ = false;    ///< the verdict is about the window, not about the mounting
  std::shared_ptr<Trial> trial_;  ///< other setups, a few with each image; nothing while all is well
  std::optional<SizeEstimate> measured_size_;
  FramesVerdict verdict_{FramesVerdict::kOpen, "camera mounting: no way flown yet"};
};

}  // namespace window_ingress::estimation
