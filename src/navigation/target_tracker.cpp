#include "window_ingress/navigation/target_tracker.hpp"

#include <stdexcept>

#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/parameters/fields.hpp"

namespace window_ingress::navigation {
namespace {

TrackerParams checked(const TrackerParams& params) {
  const auto faults = parameters::outOfRange(params);
  if (!faults.empty()) throw std::invalid_argument("tracker: " + parameters::joined(faults));
  return params;
}

pose::SizeBelief sizeSaid(const pose::PoseParams& pose) {
  return pose::sizeBelief({pose.opening_width_m, pose.opening_height_m}, pose.scale_sigma, pose.aspect_sigma);
}

}  // namespace

TargetEstimate targetFrom(const pose::FilteredWindow& window) {
  TargetEstimate target;
  target.stamp_sec = window.stamp_sec;
  target.T_odom_window = window.T_odom_window;
  target.covariance = window.covariance;
  target.sign_trusted = window.sign_trusted;
  target.updates = window.updates;
  target.opening = window.size.size;
  return target;
}

TargetTracker::TargetTracker(const pose::PoseParams& pose, const pose::FilterParams& filter,
                             const TrackerParams& params)
    : params_(checked(params)),
      estimator_(pose),
      filter_(filter, sizeSaid(pose)),
      frames_(pose, filter, params.frames, sizeSaid(pose)) {}

void TargetTracker::forgetPlaces() {
  filter_.forgetPlaces();
  frames_.forgetPlaces();
  odometry_.clear();
  attitude_.clear();
  odometry_stamp_sec_.reset();
  pending_.reset();
  last_ = TrackerUpdate();
}

void TargetTracker::reset() {
  forgetPlaces();
  filter_.reset();
  frames_.clear();
}

void TargetTracker::addOdometry(double stamp_sec, const Eigen::Isometry3d& T_odom_base,
                                const std::optional<Eigen::Vector3d>& velocity_odom_mps) {
  constexpr double kFastestMps = 3.0;
  if (!geometry::isValidPose(T_odom_base)) return;
  if (odometry_stamp_sec_) {
    const double moved_m = (T_odom_base.translation() - odometry_position_m_).norm();
    const double dt_sec = stamp_sec - *odometry_stamp_sec_;
    if (dt_sec < 0.0) reset();
    if (moved_m > params_.max_jump_m + kFastestMps * dt_sec) forgetPlaces();
  }
  if (!odometry_.add(stamp_sec, T_odom_base)) return;
  if (velocity_odom_mps) frames_.twist().add(stamp_sec, T_odom_base, *velocity_odom_mps);
  odometry_stamp_sec_ = stamp_sec;
  odometry_position_m_ = T_odom_base.translation();
  if (pending_ && pending_->window.stamp_sec <= stamp_sec) flush();
}

void TargetTracker::addAttitude(double stamp_sec, const Eigen::Quaterniond& R_odom_base) {
  attitude_.add(stamp_sec, geometry::makePose(R_odom_base.toRotationMatrix(), Eigen::Vector3d::Zero()));
}

void TargetTracker::see(const detection::WindowObservation& window, const geometry::PinholeCamera& camera,
                        const std::optional<Eigen::Isometry3d>& T_base_camera) {
  flush();
  pending_ = Pending{window, camera, T_base_camera};
  if (odometry_stamp_sec_ && *odometry_stamp_sec_ >= window.stamp_sec) flush();
}

void TargetTracker::flush() {
  if (pending_) process(*pending_);
  pending_.reset();
}

pose::PoseResult TargetTracker::estimate(const Pending& pending) const {
  pose::PoseHints hints;
  hints.gravity = gravity(pending);
  hints.size = filter_.sizeOf(pending.window);
  return estimator_.estimate(pending.window, pending.camera, hints);
}

void TargetTracker::process(const Pending& pending) {
  last_.pose = estimate(pending);
  last_.why_not = whyNotUsed(pending);
  last_.used = last_.why_not.empty();
}

std::string TargetTracker::whyNotUsed(const Pending& pending) {
  const auto& [window, camera, T_base_camera] = pending;
  const bool is_whole = window.whole() && window.visibleSides() == 4;
  const auto T_odom_base = odometry_.at(window.stamp_sec, params_.max_pose_gap_sec);
  // A camera that is not mounted as said may give no pose at all.
  if (is_whole && T_odom_base && T_base_camera)
    frames_.mounting().see(window, camera, *T_odom_base, *T_base_camera);
  if (!last_.pose.estimate && is_whole) return last_.pose.detail;
  if (!T_base_camera) return "mounting of the camera unknown";
  if (!T_odom_base) return "no odometry near the exposure";
  const Eigen::Isometry3d T_odom_camera = *T_odom_base * *T_base_camera;
  const bool used = last_.pose.estimate ? filter_.update(*last_.pose.estimate, window, camera, T_odom_camera)
                                        : filter_.update(window, camera, T_odom_camera);
  return used ? "" : "gated out by the filter";
}

std::optional<pose::GravityPrior> TargetTracker::gravity(const Pending& pending) const {
  if (!pending.T_base_camera) return std::nullopt;
  const auto& source = attitude_.empty() ? odometry_ : attitude_;
  const auto T_odom_base = source.at(pending.window.stamp_sec, params_.max_pose_gap_sec);
  if (!T_odom_base) return std::nullopt;
  const Eigen::Matrix3d R_odom_camera = T_odom_base->linear() * pending.T_base_camera->linear();
  return pose::GravityPrior{R_odom_camera.transpose() * Eigen::Vector3d::UnitZ(), params_.gravity_sigma_rad};
}

std::optional<TargetEstimate> TargetTracker::target(double now_sec) const {
  const auto state = filter_.state(now_sec);
  if (!state) return std::nullopt;
  TargetEstimate target = targetFrom(*state);
  target.fit = fit(*state).fit;
  target.approach_forbidden = approachForbidden(*state);
  return target;
}

std::string TargetTracker::approachForbidden(const pose::FilteredWindow& window) const {
  const pose::FramesVerdict frames = frames_.verdict();
  if (frames.state == pose::FramesVerdict::kWrong) return frames.what;
  const pose::FitVerdict verdict = fit(window);
  if (verdict.fit == pose::Fit::kGo) return "";
  return std::string("fit ") + pose::toString(verdict.fit) + ": " + verdict.reason;
}

}  // namespace window_ingress::navigation
