#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "window_ingress/estimation/target_estimate.hpp"
#include "window_ingress/estimation/window_filter.hpp"
#include "window_ingress/estimation/window_pose_estimator.hpp"

namespace window_ingress::estimation {

/// Greater than any lasting heading error: odometry turned a moment ago, or the camera is mounted askew.
constexpr double kMaxTurnWithHeadingRad = 0.09;

/// Checks that the camera points where its mounting says, and that the opening has its stated size: a
/// separate filter that knows neither, fed with images some distance apart. The window's motion in the image
/// during a known motion of the odometry determines both. Heading and stamps of odometry may be off, too.
///
/// If that filter explains nothing, the mounting may be wrong by a right angle or more, or odometry's axes
/// may be exchanged. These setups are tried on the last images, and the one that explains them is named.
class MountingCheck {
 public:
  /// \param size stated size of the opening; zero covariance: known, and therefore verified
  MountingCheck(const PoseParams& pose, const FilterParams& filter, const SizeEstimate& size);

  /// The filter starts with a whole window and continues with partial ones, because a camera turned aside has
  /// the window at the image's border.
  void see(const detection::WindowObservation& window, const geometry::PinholeCamera& camera,
           const Eigen::Isometry3d& T_odom_base, const Eigen::Isometry3d& T_base_camera,
           const CameraMotion& motion = {});
  void startAnewForAnotherTarget(std::uint32_t seen_id);
  void clear();
  /// Sets the observed drift of odometry's position [m/sqrt(s)].
  void assumeDrift(double m_per_sqrt_sec) { filter_.assumeDrift(kWander * m_per_sqrt_sec); }
  void forgetPlaces();  ///< the odometry frame has changed; findings stay
  FramesVerdict verdict() const { return verdict_; }

  /// Size measured in flight, independent of the stated one; nothing before it is measured.
  const std::optional<SizeEstimate>& measuredSize() const { return measured_size_; }

 private:
  /// A satellite receiver's errors last for seconds, so they grow faster than the random walk measured in one.
  static constexpr double kWander = 1.6;
  static constexpr char kNothingYet[] = "camera mounting: not flown far enough yet";
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
  std::optional<Place> last_;  ///< where the last image was used, whole or not
  int refused_ = 0;
  std::uint32_t target_id_ = 0;
  bool size_is_fault_ = false;    ///< the verdict is about the window, not about the mounting
  std::shared_ptr<Trial> trial_;  ///< other setups, a few tried per image; null while all is well
  std::optional<SizeEstimate> measured_size_;
  FramesVerdict verdict_{FramesVerdict::kUndecided, kNothingYet};
};

}  // namespace window_ingress::estimation
