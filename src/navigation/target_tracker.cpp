#include "window_ingress/navigation/target_tracker.hpp"

#include <cmath>
#include <cstdio>
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

std::string otherWindowText(double factor) {
  char text[100];
  std::snprintf(text, sizeof text, "another window: about %.1f times as large as the one looked for", factor);
  return text;
}

geometry::OpeningSize neededBy(const pose::FitParams& fit) {
  return {fit.vehicle_width_m + 2.0 * fit.margin_m, fit.vehicle_height_m + 2.0 * fit.margin_m};
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
      frames_(pose, filter, params.frames, sizeSaid(pose)),
      judge_(params.openness, neededBy(params.fit)),
      size_is_known_(sizeSaid(pose).log_covariance.isZero(0.0)) {}

void TargetTracker::forgetPlaces() {
  filter_.forgetPlaces();
  frames_.forgetPlaces();
  parallax_.clear();
  judge_.reset();
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
  if (!geometry::isValidPose(T_odom_base) || !std::isfinite(stamp_sec)) return;
  if (odometry_stamp_sec_) {
    const double dt_sec = stamp_sec - *odometry_stamp_sec_;
    if (dt_sec < 0.0 && dt_sec > -pose::PoseBuffer::kLateSec) return;
    if (dt_sec < 0.0) reset();
    if (dt_sec >= 0.0 && isJump(dt_sec, T_odom_base)) forgetPlaces();
  }
  if (!odometry_.add(stamp_sec, T_odom_base)) return;
  if (velocity_odom_mps) frames_.twist().add(stamp_sec, T_odom_base, *velocity_odom_mps);
  odometry_stamp_sec_ = stamp_sec;
  last_T_odom_base_ = T_odom_base;
  if (pending_ && pending_->window.stamp_sec <= stamp_sec) flush();
}

bool TargetTracker::isJump(double dt_sec, const Eigen::Isometry3d& T_odom_base) const {
  constexpr double kFastestMps = 3.0, kFastestRadps = 3.0;
  const double moved_m = (T_odom_base.translation() - last_T_odom_base_.translation()).norm();
  const Eigen::Quaterniond before(last_T_odom_base_.linear()), now(T_odom_base.linear());
  return moved_m > params_.max_jump_m + kFastestMps * dt_sec ||
         before.angularDistance(now) > params_.max_turn_jump_rad + kFastestRadps * dt_sec;
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

pose::PoseResult TargetTracker::estimate(const Pending& pending) {
  pose::PoseHints hints;
  hints.gravity = gravity(pending);
  hints.size = filter_.sizeOf(pending.window);
  return estimator_.estimate(pending.window, pending.camera, hints);
}

// What was found out about the size belongs to the window it was found out of.
void TargetTracker::noticeTarget(std::uint32_t target_id) {
  if (target_id == target_id_) return;
  target_id_ = target_id;
  parallax_.clear();
}

void TargetTracker::checkSize(const Pending& pending, const Eigen::Isometry3d& T_odom_camera) {
  if (!size_is_known_ || !last_.pose.estimate || !pending.window.whole()) return;
  parallax_.see(pending.window.stamp_sec, T_odom_camera.translation(),
                T_odom_camera * last_.pose.estimate->best.T_camera_window.translation());
}

void TargetTracker::process(const Pending& pending) {
  noticeTarget(pending.window.target_id);
  last_.pose = estimate(pending);
  last_.why_not = whyNotUsed(pending);
  last_.used = last_.why_not.empty();
  if (last_.used) judgeOpenness(pending);
}

void TargetTracker::judgeOpenness(const Pending& pending) {
  const auto window = filter_.state(pending.window.stamp_sec);
  const auto T_odom_base = odometry_.at(pending.window.stamp_sec, params_.max_pose_gap_sec);
  if (!window || !T_odom_base || !pending.T_base_camera) return;
  judge_.see({pending.window, pending.camera, *T_odom_base * *pending.T_base_camera, window->T_odom_window,
              window->size.size});
}

std::string TargetTracker::whyNotUsed(const Pending& pending) {
  const auto& [window, camera, T_base_camera] = pending;
  const int sides = window.visibleSides();  // none: only corners are known
  const bool is_whole = window.whole() && (sides == 4 || sides == 0);
  const auto T_odom_base = odometry_.at(window.stamp_sec, params_.max_pose_gap_sec);
  // A camera that is not mounted as said may give no pose at all.
  if (is_whole && T_odom_base && T_base_camera)
    frames_.mounting().see(window, camera, *T_odom_base, *T_base_camera);
  if (!last_.pose.estimate && is_whole) return last_.pose.detail;
  if (!T_base_camera) return "mounting of the camera unknown";
  if (!T_odom_base) return "no odometry near the exposure";
  const Eigen::Isometry3d T_odom_camera = *T_odom_base * *T_base_camera;
  checkSize(pending, T_odom_camera);
  const bool used = last_.pose.estimate ? filter_.update(*last_.pose.estimate, window, camera, T_odom_camera)
                                        : filter_.update(window, camera, T_odom_camera);
  return used ? "" : "gated out by the filter";
}

// That of the IMU, unless it has none or is in other axes.
std::optional<Eigen::Matrix3d> TargetTracker::attitudeAt(double stamp_sec) {
  const auto imu = attitude_.at(stamp_sec, params_.max_pose_gap_sec);
  const auto odometry = odometry_.at(stamp_sec, params_.max_pose_gap_sec);
  const bool agree = !imu || !odometry || frames_.attitude().see(imu->linear(), odometry->linear());
  if (imu && agree) return imu->linear();
  if (odometry) return odometry->linear();
  return std::nullopt;
}

std::optional<pose::GravityPrior> TargetTracker::gravity(const Pending& pending) {
  if (!pending.T_base_camera) return std::nullopt;
  const auto R_odom_base = attitudeAt(pending.window.stamp_sec);
  if (!R_odom_base) return std::nullopt;
  const Eigen::Matrix3d R_odom_camera = *R_odom_base * pending.T_base_camera->linear();
  return pose::GravityPrior{R_odom_camera.transpose() * Eigen::Vector3d::UnitZ(), params_.gravity_sigma_rad};
}

std::optional<TargetEstimate> TargetTracker::target(double now_sec) const {
  const auto state = filter_.state(now_sec);
  if (!state) return std::nullopt;
  TargetEstimate target = targetFrom(*state);
  target.fit = fit(*state).fit;
  target.approach_forbidden = approachForbidden(*state);
  target.other_window = otherWindow();
  target.openness = openness();
  return target;
}

// A factor out of all proportion speaks of the frames, not of the window.
std::optional<double> TargetTracker::otherWindow() const {
  constexpr double kLargest = 5.0;
  if (parallax_.verdict() != pose::ParallaxCheck::Verdict::kOther) return std::nullopt;
  const double factor = parallax_.factor();
  return factor < kLargest && factor > 1.0 / kLargest ? std::optional(factor) : std::nullopt;
}

std::string TargetTracker::approachForbidden(const pose::FilteredWindow& window) const {
  const pose::FramesVerdict frames = frames_.verdict();
  if (frames.state == pose::FramesVerdict::kWrong) return frames.what;
  if (const auto factor = otherWindow()) return otherWindowText(*factor);
  const pose::FitVerdict verdict = fit(window);
  if (verdict.fit == pose::Fit::kGo) return "";
  return std::string("fit ") + pose::toString(verdict.fit) + ": " + verdict.reason;
}

}  // namespace window_ingress::navigation
