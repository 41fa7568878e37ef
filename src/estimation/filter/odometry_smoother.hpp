#pragma once

#include <Eigen/Core>
#include <deque>
#include <optional>

namespace window_ingress::estimation {

/// Fits a straight line in time to the last second of positions, to separate motion from odometry's jitter.
class OdometrySmoother {
 public:
  struct Motion {
    Eigen::Vector3d position_m;  ///< on the line, at the time of the last sample
    Eigen::Vector3d velocity_mps;
  };

  /// A sample no newer than the last one restarts the fit. Non-finite samples are ignored.
  void add(double stamp_sec, const Eigen::Vector3d& position_m);
  /// Nothing until there are five samples over a third of the span.
  std::optional<Motion> motion() const;
  void clear() { samples_.clear(); }

 private:
  struct Sample {
    double stamp_sec;
    Eigen::Vector3d position_m;
  };
  std::deque<Sample> samples_;
};

}  // namespace window_ingress::estimation
