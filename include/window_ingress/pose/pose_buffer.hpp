#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <deque>
#include <optional>

namespace window_ingress::pose {

/// Recent poses by time, interpolated on request. Bounded. A sample older than the newest one is a jump back
/// in time and clears the buffer.
class PoseBuffer {
 public:
  explicit PoseBuffer(double span_sec = 2.0, std::size_t max_samples = 1000);

  /// \return false and nothing stored if the stamp or the pose is not finite, or the stamp repeats
  bool add(double stamp_sec, const Eigen::Isometry3d& pose);

  /// Pose at `stamp_sec`: interpolated, or the nearest sample if the stamp lies at most
  /// `max_extrapolation_sec` outside.
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
  std::deque<Sample> samples_;
};

}  // namespace window_ingress::pose
