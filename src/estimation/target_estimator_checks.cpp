// Checks during flight: size, clocks, openness, and what forbids the approach.
#include <algorithm>
#include <cmath>

#include "estimation/checks/flight_checks.hpp"
#include "window_ingress/estimation/target_estimator.hpp"
#include "window_ingress/geometry/euler_angles.hpp"
#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::estimation {
namespace {

std::string turnedText(const CameraTurn& camera) {
  constexpr double kCertainSigmas = 2.0;
  const double turn_rad = camera.turn_rad.y(), sigma_rad = std::sqrt(camera.covariance(1, 1));
  if (!(std::abs(turn_rad) - kCertainSigmas * sigma_rad > kMaxTurnWithHeadingRad)) return "";
  return formatted("camera's yaw or odometry's heading off by about %.0f deg",
                   std::abs(turn_rad) * geometry::kDegreesPerRad);
}

}  // namespace

void TargetEstimator::checkSize(const ObservedImage& image, const Eigen::Isometry3d& T_odom_camera) {
  if (!size_is_known_ || !last_.pose.estimate || !image.window->whole()) return;
  checks_->parallax.assumeDrift(checks_->twist.driftMPerSqrtSec());
  checks_->parallax.see(image.stamp_sec, T_odom_camera.translation(),
                        T_odom_camera * last_.pose.estimate->best.T_camera_window.translation());
}

// Images that the filter refuses count, too, because wrong stamps may be the reason. Where odometry ends
// before the stamp, its twist carries the pose on.
void TargetEstimator::checkClocks(const ObservedImage& image, const Eigen::Isometry3d& T_odom_camera,
                                  const FilteredWindow& window) {
  if (!image.window->whole() || !window.motion.model.stands()) return;
  const double ahead_sec = std::max(0.0, image.stamp_sec - *odometry_stamp_sec_);
  const Eigen::Vector2d velocity_mps = motion_.velocity_mps.head<2>();
  const Eigen::Vector3d sight =
      T_odom_camera.linear() * image.camera.ray(geometry::centroid(image.window->corners));
  clocks_.see(
      {image.stamp_sec, T_odom_camera.translation().head<2>() + ahead_sec * velocity_mps, velocity_mps,
       std::atan2(sight.y(), sight.x()) + ahead_sec * motion_.turn_radps.z(), motion_.turn_radps.z()},
      window.T_odom_window.translation().head<2>());
}

void TargetEstimator::judgeOpenness(const ObservedImage& image, const Eigen::Isometry3d& T_odom_camera,
                                    const FilteredWindow& window) {
  // What lies behind a moving window is assumed to move with it, so positions are relative to the window.
  const Eigen::Vector3d moved =
      window.motion.model.stands() ? Eigen::Vector3d(0, 0, 0) : window.T_odom_window.translation();
  const Eigen::Translation3d back(-moved);
  judge_.see(
      {*image.window, image.camera, back * T_odom_camera, back * window.T_odom_window, window.size.size});
}

// Waits for odometry from after the image, because the check needs the vehicle's motion at the image.
void TargetEstimator::verifyMounting(double odometry_sec) {
  constexpr double kAroundSec = 0.1;
  while (!unverified_.empty() && unverified_.front().stamp_sec + kAroundSec <= odometry_sec) {
    const ObservedImage image = std::move(unverified_.front());
    unverified_.pop_front();
    const auto T_odom_base = odometry_.at(image.stamp_sec, kMaxPoseGapSec);
    const auto before = odometry_.at(image.stamp_sec - kAroundSec, kMaxPoseGapSec);
    const auto after = odometry_.at(image.stamp_sec + kAroundSec, kMaxPoseGapSec);
    if (!T_odom_base) continue;
    checks_->mounting.assumeDrift(checks_->twist.driftMPerSqrtSec());
    CameraMotion motion;
    if (before && after) {
      motion.velocity_mps = (after->translation() - before->translation()) / (2.0 * kAroundSec);
      const Eigen::AngleAxisd turn(after->linear() * before->linear().transpose());
      motion.turn_radps = turn.angle() * turn.axis() / (2.0 * kAroundSec);
    }
    checks_->mounting.see(*image.window, image.camera, *T_odom_base, *image.T_base_camera, motion);
  }
}

std::string TargetEstimator::unverified() const {
  const FramesVerdict mounting = checks_->mounting.verdict();
  return mounting_is_sure_ || mounting.state == FramesVerdict::kGood ? "" : mounting.what;
}

FramesVerdict TargetEstimator::frames() const { return checks_->frames(); }

const std::optional<SizeEstimate>& TargetEstimator::measuredSize() const {
  return checks_->mounting.measuredSize();
}

// An extreme factor indicates wrong frames, not another window.
std::optional<double> TargetEstimator::otherWindow() const {
  constexpr double kLargest = 5.0;
  const double factor = checks_->parallax.otherFactor().value_or(kLargest);
  return factor < kLargest && factor > 1.0 / kLargest ? std::optional(factor) : std::nullopt;
}

std::string TargetEstimator::approachForbidden(const FilteredWindow& window) const {
  const FramesVerdict frames = checks_->frames();
  if (frames.state == FramesVerdict::kWrong) return frames.what;
  if (const auto factor = otherWindow())
    return formatted("another window: about %.1f times as large as the one looked for", *factor);
  if (auto turned = turnedText(window.camera_turn); !turned.empty()) return turned;
  if (const Consistency& consistency = window.consistency; consistency.contradicted)
    return formatted("%d of %d images contradict the estimated window: is the configured size wrong?",
                     consistency.refused, consistency.refused + consistency.images);
  const FitVerdict verdict = fit(window);
  if (verdict.fit == Fit::kGo) return "";
  return std::string("fit ") + toString(verdict.fit) + ": " + verdict.reason;
}

}  // namespace window_ingress::estimation
