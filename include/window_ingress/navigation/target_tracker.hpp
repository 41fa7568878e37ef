#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/navigation/navigation_types.hpp"
#include "window_ingress/openness/openness_judge.hpp"
#include "window_ingress/pose/frames_check.hpp"
#include "window_ingress/pose/opening_fit.hpp"
#include "window_ingress/pose/parallax_check.hpp"
#include "window_ingress/pose/pose_buffer.hpp"
#include "window_ingress/pose/window_filter.hpp"
#include "window_ingress/pose/window_pose_estimator.hpp"

namespace window_ingress::navigation {

struct TrackerParams {
  double max_pose_gap_sec = 0.05;   ///< odometry may end this much before the exposure [s]
  double gravity_sigma_rad = 0.02;  ///< of the attitude, mounting included [rad]
  double max_jump_m = 0.5;          ///< odometry moving more than this beyond 3 m/s is a jump [m]
  double max_turn_jump_rad = 0.35;  ///< odometry turning more than this beyond 3 rad/s is a jump [rad]
  pose::FitParams fit;
  pose::FramesParams frames;
  openness::OpennessParams openness;

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("max_pose_gap_sec", self.max_pose_gap_sec, 0.0, 0.5);
    field("gravity_sigma_rad", self.gravity_sigma_rad, 0.001, 0.5);
    field("max_jump_m", self.max_jump_m, 0.05, 10.0);
    field("max_turn_jump_rad", self.max_turn_jump_rad, 0.05, 3.2);
    field.group("fit", self.fit);
    field.group("frames", self.frames);
    field.group("openness", self.openness);
  }
};

/// What became of the last observation.
struct TrackerUpdate {
  pose::PoseResult pose;
  bool used = false;    ///< it contributed to the target
  std::string why_not;  ///< empty if it did
};

/// Observations, odometry and attitude to the target in odom: pose estimation at the attitude of the
/// exposure, then the filter at the position of the exposure. Everything may arrive late; an observation
/// waits until odometry has caught up with its exposure, at most until the next one comes. A jump of the
/// odometry, in place or heading, starts anew, but for the size of the opening; a clock that goes back by
/// more than `PoseBuffer::kLateSec` starts everything anew (less is a sample that comes late, and left out).
///
/// What is said of the camera's mounting, of the velocity's frame and of a known size is verified on the way.
class TargetTracker {
 public:
  /// \throws std::invalid_argument that lists every parameter out of range
  TargetTracker(const pose::PoseParams& pose, const pose::FilterParams& filter, const TrackerParams& params);

  /// \param velocity_odom_mps if reported: turned to odom axes with the pose's attitude
  void addOdometry(double stamp_sec, const Eigen::Isometry3d& T_odom_base,
                   const std::optional<Eigen::Vector3d>& velocity_odom_mps = std::nullopt);
  void addAttitude(double stamp_sec, const Eigen::Quaterniond& R_odom_base);
  /// \param T_base_camera mounting of the camera; without it there is a pose, but nothing for the filter
  void see(const detection::WindowObservation& window, const geometry::PinholeCamera& camera,
           const std::optional<Eigen::Isometry3d>& T_base_camera);
  /// An observation that still waits for odometry is processed with what there is.
  void flush();
  void reset();

  std::optional<TargetEstimate> target(double now_sec) const;
  std::optional<pose::FilteredWindow> filtered(double now_sec) const { return filter_.state(now_sec); }
  const TrackerUpdate& lastUpdate() const { return last_; }

  /// Whether the vehicle fits through the opening, as far as its size is known.
  pose::FitVerdict fit(const pose::FilteredWindow& window) const {
    return pose::fitVerdict(window.size, params_.fit);
  }
  /// Whether it is open, as far as the texture within its border has shown.
  const openness::OpennessVerdict& openness() const { return judge_.verdict(); }
  pose::FramesVerdict frames() const { return frames_.verdict(); }
  /// The opening's size as measured on the way flown, whatever it is said to be.
  const std::optional<pose::SizeBelief>& measuredSize() const { return frames_.mounting().measuredSize(); }
  /// Why nobody should fly towards this window; empty if there is no reason.
  std::string approachForbidden(const pose::FilteredWindow& window) const;
  /// The window seen is not the one looked for, but so many times as large.
  std::optional<double> otherWindow() const;

 private:
  struct Pending {
    detection::WindowObservation window;
    geometry::PinholeCamera camera;
    std::optional<Eigen::Isometry3d> T_base_camera;
  };
  void process(const Pending& pending);
  std::string whyNotUsed(const Pending& pending);
  void forgetPlaces();
  void noticeTarget(std::uint32_t target_id);
  void checkSize(const Pending& pending, const Eigen::Isometry3d& T_odom_camera);
  bool isJump(double dt_sec, const Eigen::Isometry3d& T_odom_base) const;
  std::optional<Eigen::Matrix3d> attitudeAt(double stamp_sec);
  std::optional<pose::GravityPrior> gravity(const Pending& pending);
  pose::PoseResult estimate(const Pending& pending);
  void judgeOpenness(const Pending& pending);

  TrackerParams params_;
  pose::WindowPoseEstimator estimator_;
  pose::WindowFilter filter_;
  pose::FramesCheck frames_;
  pose::ParallaxCheck parallax_;
  openness::OpennessJudge judge_;
  bool size_is_known_;
  std::uint32_t target_id_ = 0;
  pose::PoseBuffer odometry_, attitude_;
  std::optional<double> odometry_stamp_sec_;
  Eigen::Isometry3d last_T_odom_base_ = Eigen::Isometry3d::Identity();
  std::optional<Pending> pending_;
  TrackerUpdate last_;
};

/// The filter's state in the navigator's words.
TargetEstimate targetFrom(const pose::FilteredWindow& window);

}  // namespace window_ingress::navigation
