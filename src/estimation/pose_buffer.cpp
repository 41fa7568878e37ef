#include "window_ingress/estimation/pose_buffer.hpp"

#include <algorithm>
#include <cmath>

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::estimation {

bool PoseBuffer::add(double stamp_sec, const Eigen::Isometry3d& pose) {
  if (!std::isfinite(stamp_sec) || !geometry::isValidPose(pose)) return false;
  const double newer_sec = samples_.empty() ? 1.0 : stamp_sec - samples_.back().stamp_sec;
  if (newer_sec <= 0.0 && newer_sec > -kLateSec) return false;
  if (newer_sec < 0.0) samples_.clear();
  samples_.push_back({stamp_sec, pose});
  while (samples_.size() > kMaxSamples || samples_.front().stamp_sec < stamp_sec - kSpanSec)
    samples_.pop_front();
  return true;
}

std::optional<Eigen::Isometry3d> PoseBuffer::at(double stamp_sec, double max_extrapolation_sec) const {
  if (samples_.empty() || !std::isfinite(stamp_sec)) return std::nullopt;
  const auto after =
      std::lower_bound(samples_.begin(), samples_.end(), stamp_sec,
                       [](const Sample& sample, double stamp) { return sample.stamp_sec < stamp; });
  const bool is_outside = after == samples_.end() || after == samples_.begin();
  const Sample &before = after == samples_.begin() ? *after : *(after - 1),
               &next = after == samples_.end() ? before : *after;
  if (is_outside || next.stamp_sec - before.stamp_sec > kMaxGapSec) {
    const bool is_before = stamp_sec - before.stamp_sec < next.stamp_sec - stamp_sec;
    const Sample& nearest = is_before ? before : next;
    if (std::abs(stamp_sec - nearest.stamp_sec) > max_extrapolation_sec) return std::nullopt;
    return nearest.pose;
  }
  const double fraction = (stamp_sec - before.stamp_sec) / (next.stamp_sec - before.stamp_sec);
  const Eigen::Quaterniond from(before.pose.linear()), to(next.pose.linear());
  const Eigen::Vector3d moved_m = next.pose.translation() - before.pose.translation();
  return geometry::makePose(from.slerp(fraction, to).normalized().toRotationMatrix(),
                            before.pose.translation() + fraction * moved_m);
}

}  // namespace window_ingress::estimation
