#include "window_ingress/estimation/clock_check.hpp"

#include <algorithm>
#include <cmath>

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::estimation {
namespace {

constexpr double kStretchSec = 2.0, kLongestGapSec = 0.5;
constexpr std::size_t kMinSights = 10, kMaxSights = 400;
constexpr double kMinRateSpread = 0.08;   // rad/s, root mean square about the mean
constexpr double kMinSigmaRad = 0.003;    // of a direction: corners, attitude
constexpr double kCorrelated = 4.0;       // number of sights that share one error
constexpr double kModelSigmaSec = 0.015;  // of one stretch: its yaw rate is slightly old
constexpr double kStrayRad = 0.3;         // no clock offset moves a window this far
constexpr double kMaxWeight = 10.0;       // stretches; older ones are forgotten
constexpr double kMaxOffsetSec = 0.05, kMaxSigmas = 3.0;

bool isFinite(const ClockCheck::Sight& sight) {
  return std::isfinite(sight.stamp_sec) && sight.camera_odom_m.allFinite() &&
         std::isfinite(sight.azimuth_rad) && std::isfinite(sight.yaw_rate_radps);
}

}  // namespace

bool ClockCheck::Offset::isTooLarge() const {
  return std::abs(late_sec) > std::max(kMaxOffsetSec, kMaxSigmas * sigma_sec);
}

void ClockCheck::see(const Sight& sight, const Eigen::Vector2d& window_odom_m) {
  if (!isFinite(sight) || !window_odom_m.allFinite()) return;
  if (!stretch_.empty()) {
    const double elapsed_sec = sight.stamp_sec - stretch_.back().stamp_sec;
    if (!(elapsed_sec > 0.0 && elapsed_sec < kLongestGapSec)) stretch_.clear();
  }
  stretch_.push_back(sight);
  if (stretch_.size() > kMaxSights) stretch_.pop_front();
  if (sight.stamp_sec - stretch_.front().stamp_sec < kStretchSec) return;
  if (const auto found = slopeWith(window_odom_m)) {
    join(*found);
    stretch_.clear();
  } else {
    stretch_.pop_front();
  }
}

// The window's estimated position removes the effect of the path flown; its error is the same for all sights.
std::optional<ClockCheck::Offset> ClockCheck::slopeWith(const Eigen::Vector2d& window_odom_m) const {
  double count = 0.0, rate = 0.0, off = 0.0, rates = 0.0, both = 0.0, offs = 0.0;
  for (const Sight& sight : stretch_) {
    const Eigen::Vector2d way = window_odom_m - sight.camera_odom_m;
    const double off_rad = geometry::wrapAngle(sight.azimuth_rad - std::atan2(way.y(), way.x()));
    if (std::abs(off_rad) > kStrayRad) continue;
    count += 1.0, rate += sight.yaw_rate_radps, off += off_rad;
    rates += sight.yaw_rate_radps * sight.yaw_rate_radps;
    both += sight.yaw_rate_radps * off_rad;
    offs += off_rad * off_rad;
  }
  if (count < static_cast<double>(kMinSights)) return std::nullopt;
  const double spread = rates - rate * rate / count;
  if (spread < count * kMinRateSpread * kMinRateSpread) return std::nullopt;
  const double slope_sec = (both - rate * off / count) / spread;
  const double left = std::max(0.0, offs - off * off / count - slope_sec * slope_sec * spread) / count;
  const double variance = kCorrelated * (left + kMinSigmaRad * kMinSigmaRad) / spread;
  return Offset{slope_sec, std::sqrt(variance + kModelSigmaSec * kModelSigmaSec)};
}

void ClockCheck::join(const Offset& found) {
  if (!offset_) {
    offset_ = found;
    return;
  }
  const double before = std::min(1.0 / (offset_->sigma_sec * offset_->sigma_sec),
                                 kMaxWeight / (kModelSigmaSec * kModelSigmaSec));
  const double now = 1.0 / (found.sigma_sec * found.sigma_sec);
  offset_->late_sec = (before * offset_->late_sec + now * found.late_sec) / (before + now);
  offset_->sigma_sec = 1.0 / std::sqrt(before + now);
}

}  // namespace window_ingress::estimation
