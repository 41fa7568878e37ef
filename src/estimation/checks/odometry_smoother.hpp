#pragma once

#include <Eigen/Core>
#include <deque>
#include <optional>

namespace window_ingress::estimation {

/// The last second of a way, as a straight line in time: what of the odometry is motion, and what is jitter.
class OdometrySmoother {
 public:
  struct Motion {
    Eigen::Vector3d position_m;  ///< on the line, at the time of the last sample
    Eigen::Vector3d velocity_mps;
  };

  /// A sample that is not newer than the last one starts anew. One that is not finite is ignored.
  void add(double stamp_sec, const Eigen::Vector3d& position_m);
  /// Nothing before there are samples enough: five, over a third of the span.
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
