#pragma once

#include <Eigen/Geometry>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/estimation/clock_check.hpp"
#include "window_ingress/estimation/pose_buffer.hpp"
#include "window_ingress/estimation/size_estimate.hpp"
#include "window_ingress/estimation/target_estimate.hpp"
#include "window_ingress/estimation/window_filter.hpp"
#include "window_ingress/estimation/window_pose_estimator.hpp"
#include "window_ingress/facade/facade_memory.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/openness/openness_judge.hpp"

namespace window_ingress::estimation {

struct FlightChecks;

struct TargetEstimatorParams {
  openness::OpennessParams openness;
  facade::FacadeParams facade;
  geometry::OpeningSize needed{0.6, 0.34};  // by the vehicle, margins included; not in `visit`

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field.group("openness", self.openness);
    field.group("facade", self.facade);
  }
};

/// The detector's result for one image, with camera and mounting.
struct ObservedImage {
  double stamp_sec = 0.0;
  geometry::PinholeCamera camera;
  std::optional<Eigen::Isometry3d> T_base_camera;  ///< without it there is a pose, but nothing for the filter
  std::optional<detection::WindowObservation> window;  ///< the target, if it was seen
  std::vector<detection::SeenWindow> windows;          ///< all that were seen
};

/// Result of the last observation.
struct TargetUpdate {
  PoseResult pose;
  std::string why_not;  ///< why it did not contribute to the target; empty if it did
};

/// Observations, odometry and attitude to the target in odom: pose estimation at the attitude of the
/// exposure, then the filter at the position of the exposure. Inputs may arrive late; an observation waits
/// until odometry has reached its exposure, at most until the next observation. A jump of the odometry, in
/// position or heading, starts anew, but keeps the size of the opening. A clock that goes back by more than
/// `PoseBuffer::kLateSec` resets everything; a smaller step is a late sample, which is ignored.
///
/// All windows seen are remembered (`FacadeMemory`): once the target is known, its neighbours are not
/// confused with it, however similar they look.
///
/// The configured camera mounting, velocity frame and known size are verified in flight.
class TargetEstimator {
 public:
  static constexpr double kMaxPoseGapSec = 0.05;  ///< odometry may end this long before the exposure

  /// \throws std::invalid_argument that lists every parameter out of range
  TargetEstimator(const PoseParams& pose, const FilterParams& filter, const TargetEstimatorParams& params);
  ~TargetEstimator();
  TargetEstimator(TargetEstimator&&) noexcept;
  TargetEstimator& operator=(TargetEstimator&&) noexcept;

  /// \param velocity_odom_mps if reported, turned to odom axes with the pose's attitude
  /// \param turn_odom_radps if reported, in odom axes; without both, late stamps are not accounted for
  void addOdometry(double stamp_sec, const Eigen::Isometry3d& T_odom_base,
                   const std::optional<Eigen::Vector3d>& velocity_odom_mps = std::nullopt,
                   const Eigen::Vector3d& turn_odom_radps = Eigen::Vector3d::Zero());
  void addAttitude(double stamp_sec, const Eigen::Quaterniond& R_odom_base);
  /// \param T_base_camera mounting of the camera; without it there is a pose, but the filter is not updated
  void addDetection(const detection::WindowObservation& window, const geometry::PinholeCamera& camera,
                    const std::optional<Eigen::Isometry3d>& T_base_camera);
  void addDetection(ObservedImage image);  ///< the same with all windows of the image
  /// Processes an observation that still waits for odometry with what there is.
  void flush();
  void reset();

  Reply selectWindow(std::uint32_t id);
  Reply selectWindowNear(const Eigen::Vector3d& point_odom_m);
  /// State of the navigator: the window it flies at (0: none), those it gave up, and whether it wants another
  /// one in place of the last of these.
  void addNavigatorState(std::uint32_t flown_at, const std::vector<std::uint32_t>& given_up, bool next_one);
  const facade::FacadeMemory& facade() const { return facade_; }
  /// Expected place of the target in an image taken at that time, if known and in view (distorted pixels).
  std::optional<geometry::Quadrilateral> expected(double stamp_sec, const geometry::PinholeCamera& camera,
                                                  const Eigen::Isometry3d& T_base_camera) const;

  std::optional<TargetEstimate> target(double now_sec) const;
  std::optional<FilteredWindow> filtered(double now_sec) const { return filter_.state(now_sec); }
  const TargetUpdate& lastUpdate() const { return last_; }

  /// Whether the vehicle fits through the opening, as far as its size is known.
  FitVerdict fit(const FilteredWindow& window) const { return fitVerdict(window.size, params_.needed); }
  /// Whether the target is open, as far as the texture within its border has shown.
  const openness::OpennessVerdict& openness() const { return judge_.verdict(); }
  FramesVerdict frames() const;
  /// The opening's size as measured in flight, independent of the configured size.
  const std::optional<SizeEstimate>& measuredSize() const;
  /// Difference between the stamps of images and odometry, once a turn has shown it.
  const std::optional<ClockCheck::Offset>& clockOffset() const { return clocks_.offset(); }
  /// Why the vehicle must not approach this window; empty if there is no reason.
  std::string approachForbidden(const FilteredWindow& window) const;
  /// What the flight must still show before the vehicle may fly in: that the camera is mounted as configured.
  /// Empty if shown.
  std::string unverified() const;
  /// Size of the window seen over the size looked for, if it is another window.
  std::optional<double> otherWindow() const;

 private:
  void process(const ObservedImage& image);
  geometry::OpeningSize lookedFor() const;
  std::optional<Eigen::Isometry3d> cameraAt(double stamp_sec,
                                            const std::optional<Eigen::Isometry3d>& T_base_camera) const;
  void rememberWindows(const ObservedImage& image, const Eigen::Isometry3d& T_odom_camera,
                       const std::optional<FilteredWindow>& used);
  void startAnewIfNot(std::uint32_t target_before);
  void verifyMounting(double odometry_sec);
  /// \return empty, or why the image was not used
  std::string updateFilter(const ObservedImage& image, const std::optional<Eigen::Isometry3d>& T_odom_camera);
  void forgetPlaces();
  void noticeTarget(std::uint32_t target_id);
  void checkSize(const ObservedImage& image, const Eigen::Isometry3d& T_odom_camera);
  void checkClocks(const ObservedImage& image, const Eigen::Isometry3d& T_odom_camera,
                   const FilteredWindow& window);
  bool isJump(double dt_sec, const Eigen::Isometry3d& T_odom_base) const;
  std::optional<GravityPrior> gravity(const ObservedImage& image);
  void judgeOpenness(const ObservedImage& image, const Eigen::Isometry3d& T_odom_camera,
                     const FilteredWindow& window);

  TargetEstimatorParams params_;
  WindowPoseEstimator estimator_;
  WindowFilter filter_;
  std::unique_ptr<FlightChecks> checks_;  ///< of the configured frames, mounting and size
  ClockCheck clocks_;
  openness::OpennessJudge judge_;
  facade::FacadeMemory facade_;
  std::optional<std::size_t> handled_given_up_;  ///< number of abandoned windows already processed
  bool size_is_known_;
  bool mounting_is_sure_;  ///< stated as sure, so it is not verified
  double attitude_sigma_rad_;
  std::uint32_t target_id_ = 0;
  PoseBuffer odometry_, attitude_;
  std::optional<double> odometry_stamp_sec_;
  Eigen::Isometry3d last_T_odom_base_ = Eigen::Isometry3d::Identity();
  CameraMotion motion_;  ///< from odometry, because differences of poses would share the noise of the poses
  std::optional<ObservedImage> pending_;
  std::deque<ObservedImage> unverified_;  ///< images not yet seen by the check of the mounting
  TargetUpdate last_;
};

}  // namespace window_ingress::estimation
