#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <deque>
#include <optional>

namespace window_ingress::estimation {

/// Recent poses by time, interpolated on request. Bounded. A sample half a second older than the newest one
/// is a jump back in time and clears the buffer; a less old sample is late and is left out.
class PoseBuffer {
 public:
  static constexpr double kLateSec = 0.5;

  /// \return false, with nothing stored, if stamp or pose is not finite, or the stamp repeats or is late
  bool add(double stamp_sec, const Eigen::Isometry3d& pose);

  /// Pose at `stamp_sec`: interpolated, or the nearest sample if the stamp lies outside, or in a gap, and at
  /// most `max_extrapolation_sec` from it.
  std::optional<Eigen::Isometry3d> at(double stamp_sec, double max_extrapolation_sec = 0.0) const;

  void clear() { samples_.clear(); }
  bool empty() const { return samples_.empty(); }

 private:
  static constexpr double kSpanSec = 2.0;
  static constexpr std::size_t kMaxSamples = 1000;
  static constexpr double kMaxGapSec =
      0.3;  ///< samples further apart say nothing about what was between them
  struct Sample {
    double stamp_sec;
    Eigen::Isometry3d pose;
  };
  std::deque<Sample> samples_;
};

}  // namespace window_ingress::estimation
