#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <deque>
#include <optional>

namespace window_ingress::estimation {

/// Recent poses by time, interpolated on request. Bounded. A sample half a second older than the newest one
/// is a jump back in time and clears the buffer; one that is less older comes late and is left out.
class PoseBuffer {
 public:
  /// \param max_gap_sec samples further apart say nothing about what was between them
  explicit PoseBuffer(double span_sec = 2.0, std::size_t max_samples = 1000, double max_gap_sec = 0.3);
  static constexpr double kLateSec = 0.5;

  /// \return false and nothing stored if the stamp or the pose is not finite, or the stamp repeats or is late
  bool add(double stamp_sec, const Eigen::Isometry3d& pose);

  /// Pose at `stamp_sec`: interpolated, or the nearest sample if the stamp lies outside, or in a gap, and at
  /// most `max_extrapolation_sec` from it.
  std::optional<Eigen::Isometry3d> at(double stamp_sec, double max_extrapolation_sec = 0.0) const;

  void clear() { samples_.clear(); }
  bool empty() const { return samples_.empty(); }

 private:
  struct Sample {
    double stamp_sec;
    Eigen::Isometry3d pose;
  };
  double span_sec_;
  std::size_t max_samples_;
  double max_gap_sec_;
  std::deque<Sample> samples_;
};

}  // namespace window_ingress::estimation
