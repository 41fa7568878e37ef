#include "window_ingress/estimation/clock_check.hpp"

#include <algorithm>
#include <cmath>

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::estimation {
namespace {

constexpr double kLongestGapSec = 0.5;
constexpr double kChangeSec = 0.4;  // a change is taken over this time, or at least over kMinPart of it
constexpr double kMinPart = 0.6;
constexpr double kStrayRad = 0.3;                           // no clock offset moves a window this far
constexpr double kRemembered = 150;                         // independent changes; older ones fade
constexpr double kMinCount = 3.0;                           // independent changes
constexpr double kMinTurned = 0.06;                         // rad^2/s^2, sum of squared changes of the rate
constexpr double kGuessedRad = 0.004, kGuessedCount = 2.0;  // scatter of the shift before any is measured
constexpr double kMinSigmaRad = 0.001;                      // of a change of the shift: corners, attitude
constexpr double kModelSigmaSec = 0.005;
constexpr double kMaxOffsetSec = 0.05, kMaxSigmas = 4.0;
// A vague offset must be more certain: a satellite receiver's errors last for seconds, so its changes are not
// independent.
constexpr double kVagueSigmaSec = 0.025, kMaxVagueSigmas = 5.0;

bool isFinite(const ClockCheck::Sight& sight) {
  return std::isfinite(sight.stamp_sec) && sight.camera_odom_m.allFinite() &&
         sight.velocity_odom_mps.allFinite() && std::isfinite(sight.azimuth_rad) &&
         std::isfinite(sight.yaw_rate_radps);
}

/// The window's apparent direction, relative to that from the camera to its estimated place.
struct Shift {
  Shift(const ClockCheck::Sight& sight, const Eigen::Vector2d& window_odom_m) {
    const Eigen::Vector2d way = window_odom_m - sight.camera_odom_m, &v = sight.velocity_odom_mps;
    rate_radps = sight.yaw_rate_radps - (v.x() * way.y() - v.y() * way.x()) / way.squaredNorm();
    shift_rad = geometry::wrapAngle(sight.azimuth_rad - std::atan2(way.y(), way.x()));
  }
  double rate_radps, shift_rad;  ///< rate: of the camera's turn relative to the window
};

}  // namespace

bool ClockCheck::Offset::isTooLarge() const {
  const double sigmas = sigma_sec > kVagueSigmaSec ? kMaxVagueSigmas : kMaxSigmas;
  return std::abs(late_sec) > std::max(kMaxOffsetSec, sigmas * sigma_sec);
}

// Both ends of a change are seen from the same place of the window, so that learning it counts for nothing.
void ClockCheck::see(const Sight& sight, const Eigen::Vector2d& window_odom_m) {
  if (!isFinite(sight) || !window_odom_m.allFinite()) return;
  const double elapsed_sec = recent_.empty() ? 0.0 : sight.stamp_sec - recent_.back().stamp_sec;
  if (!(elapsed_sec > 0.0 && elapsed_sec < kLongestGapSec)) recent_.clear();
  recent_.push_back(sight);
  while (sight.stamp_sec - recent_.front().stamp_sec > kChangeSec) recent_.pop_front();
  if (sight.stamp_sec - recent_.front().stamp_sec < kMinPart * kChangeSec) return;
  const Shift before(recent_.front(), window_odom_m), now(sight, window_odom_m);
  if (std::max(std::abs(before.shift_rad), std::abs(now.shift_rad)) < kStrayRad)
    addChange(now.rate_radps - before.rate_radps, now.shift_rad - before.shift_rad, elapsed_sec);
}

void ClockCheck::addChange(double rate, double shift, double elapsed_sec) {
  const double weight = std::min(1.0, elapsed_sec / kChangeSec);  // successive changes overlap
  const double kept = 1.0 - weight / kRemembered;
  count_ = kept * count_ + weight;
  rr_ = kept * rr_ + weight * rate * rate;
  rs_ = kept * rs_ + weight * rate * shift;
  ss_ = kept * ss_ + weight * shift * shift;
  if (count_ < kMinCount || rr_ < kMinTurned) return;
  const double late_sec = rs_ / rr_;
  const double scatter = (std::max(0.0, ss_ - late_sec * rs_) + kGuessedCount * kGuessedRad * kGuessedRad) /
                         (count_ - 1.0 + kGuessedCount);
  offset_ = Offset{
      late_sec, std::sqrt((scatter + kMinSigmaRad * kMinSigmaRad) / rr_ + kModelSigmaSec * kModelSigmaSec)};
}

}  // namespace window_ingress::estimation
