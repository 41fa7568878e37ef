#pragma once

#include <Eigen/Geometry>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/estimation/clock_check.hpp"
#include "window_ingress/estimation/frames_verdict.hpp"
#include "window_ingress/estimation/pose_buffer.hpp"
#include "window_ingress/estimation/size_estimate.hpp"
#include "window_ingress/estimation/target_estimate.hpp"
#include "window_ingress/estimation/window_filter.hpp"
#include "window_ingress/estimation/window_pose_estimator.hpp"
#include "window_ingress/facade/facade_memory.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/openness/openness_judge.hpp"

namespace window_ingress::estimation {

struct TargetEstimatorParams {
  openness::OpennessParams openness;
  facade::FacadeParams facade;
  geometry::OpeningSize needed{0.6, 0.34};  // by the vehicle with its margins; not in `visit`

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field.group("openness", self.openness);
    field.group("facade", self.facade);
  }
};

/// What the detector says of one image, and from where it was taken.
struct ObservedImage {
  double stamp_sec = 0.0;
  geometry::PinholeCamera camera;
  std::optional<Eigen::Isometry3d> T_base_camera;  ///< without it there is a pose, but nothing for the filter
  std::optional<detection::WindowObservation> window;  ///< the target, if it was seen
  std::vector<detection::SeenWindow> windows;          ///< all that were
};

/// What became of the last observation.
struct TargetUpdate {
  PoseResult pose;
  std::string why_not;  ///< empty if it contributed to the target
};

/// Observations, odometry and attitude to the target in odom: pose estimation at the attitude of the
/// exposure, then the filter at the position of the exposure. Everything may arrive late; an observation
/// waits until odometry has caught up with its exposure, at most until the next one comes. A jump of the
/// odometry, in place or heading, starts anew, but for the size of the opening; a clock that goes back by
/// more than `PoseBuffer::kLateSec` starts everything anew (less is a sample that comes late, and left out).
///
/// All windows seen are remembered (`FacadeMemory`): once the target is known, its neighbours are not taken
/// for it, however like it they look.
///
/// What is said of the camera's mounting, of the velocity's frame and of a known size is verified on the way.
class TargetEstimator {
 public:
  static constexpr double kMaxPoseGapSec = 0.05;  ///< odometry may end this much before the exposure

  /// \throws std::invalid_argument that lists every parameter out of range
  TargetEstimator(const PoseParams& pose, const FilterParams& filter, const TargetEstimatorParams& params);
  ~TargetEstimator();
  TargetEstimator(TargetEstimator&&) noexcept;
  TargetEstimator& operator=(TargetEstimator&&) noexcept;

  /// \param velocity_odom_mps if reported: turned to odom axes with the pose's attitude
  /// \param turn_odom_radps likewise; without both, lateness of the stamps stays unknown
  void addOdometry(double stamp_sec, const Eigen::Isometry3d& T_odom_base,
                   const std::optional<Eigen::Vector3d>& velocity_odom_mps = std::nullopt,
                   const Eigen::Vector3d& turn_odom_radps = Eigen::Vector3d::Zero());
  void addAttitude(double stamp_sec, const Eigen::Quaterniond& R_odom_base);
  /// \param T_base_camera mounting of the camera; without it there is a pose, but nothing for the filter
  void see(const detection::WindowObservation& window, const geometry::PinholeCamera& camera,
           const std::optional<Eigen::Isometry3d>& T_base_camera);
  void see(
      ObservedImage image);  ///< the same with all windows of the image, whether or not one is the target
  /// An observation that still waits for odometry is processed with what there is.
  void flush();
  void reset();

  facade::Answer selectWindow(std::uint32_t id);
  facade::Answer selectWindowNear(const Eigen::Vector3d& point_odom_m);
  /// What the navigator does: the window it flies at (0: none), those that it gave up, and whether it is to
  /// get another one in place of the last of them.
  void heed(std::uint32_t flown_at, const std::vector<std::uint32_t>& given_up, bool next_one);
  const facade::FacadeMemory& facade() const { return facade_; }
  /// Where the target must be in an image taken at that time, if that is known and in view (distorted
  /// pixels).
  std::optional<geometry::Quadrilateral> expected(double stamp_sec, const geometry::PinholeCamera& camera,
                                                  const Eigen::Isometry3d& T_base_camera) const;

  std::optional<TargetEstimate> target(double now_sec) const;
  std::optional<FilteredWindow> filtered(double now_sec) const { return filter_.state(now_sec); }
  const TargetUpdate& lastUpdate() const { return last_; }

  /// Whether the vehicle fits through the opening, as far as its size is known.
  FitVerdict fit(const FilteredWindow& window) const { return fitVerdict(window.size, params_.needed); }
  /// Whether it is open, as far as the texture within its border has shown.
  const openness::OpennessVerdict& openness() const { return judge_.verdict(); }
  FramesVerdict frames() const;
  /// The opening's size as measured on the way flown, whatever it is said to be.
  const std::optional<SizeEstimate>& measuredSize() const;
  /// By how much the stamps of images and odometry differ, once a turn has shown it.
  const std::optional<ClockCheck::Offset>& clockOffset() const { return clocks_.offset(); }
  /// Why nobody should fly towards this window; empty if there is no reason.
  std::string approachForbidden(const FilteredWindow& window) const;
  /// What the way flown has yet to show before anybody flies in: that the camera is mounted as said. Empty if
  /// it has.
  std::string unverified() const;
  /// The window seen is not the one looked for, but so many times as large.
  std::optional<double> otherWindow() const;

 private:
  void process(const ObservedImage& image);
  void use(const ObservedImage& image);
  geometry::OpeningSize lookedFor() const;
  std::optional<Eigen::Isometry3d> cameraAt(double stamp_sec,
                                            const std::optional<Eigen::Isometry3d>& T_base_camera) const;
  void rememberWindows(const ObservedImage& image);
  void startAnewIfNot(std::uint32_t target_before);
  void verifyMounting(double odometry_sec);
  std::string updateFilter(const ObservedImage& image);  // empty, or why it was not used
  void forgetPlaces();
  void noticeTarget(std::uint32_t target_id);
  void checkSize(const ObservedImage& image, const Eigen::Isometry3d& T_odom_camera);
  void checkClocks(const ObservedImage& image);
  bool isJump(double dt_sec, const Eigen::Isometry3d& T_odom_base) const;
  std::optional<Eigen::Matrix3d> attitudeAt(double stamp_sec);
  std::optional<GravityPrior> gravity(const ObservedImage& image);
  PoseResult estimate(const ObservedImage& image);
  void judgeOpenness(const ObservedImage& image);

  TargetEstimatorParams params_;
  WindowPoseEstimator estimator_;
  WindowFilter filter_;
  struct Checks;
  std::unique_ptr<Checks> checks_;  ///< of what is said about frames, mounting and size
  ClockCheck clocks_;
  openness::OpennessJudge judge_;
  facade::FacadeMemory facade_;
  std::size_t heeded_ = 0;  ///< how many of those given up are known
  bool size_is_known_;
  double attitude_sigma_rad_;
  std::uint32_t target_id_ = 0;
  PoseBuffer odometry_, attitude_;
  std::optional<double> odometry_stamp_sec_;
  Eigen::Isometry3d last_T_odom_base_ = Eigen::Isometry3d::Identity();
  CameraMotion motion_;  ///< as odometry says it: differences of poses would share the noise of the poses
  std::optional<ObservedImage> pending_;
  std::deque<ObservedImage> unverified_;  ///< images that the check of the mounting has yet to look at
  TargetUpdate last_;
};

}  // namespace window_ingress::estimation
