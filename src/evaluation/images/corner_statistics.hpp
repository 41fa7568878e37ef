#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "evaluation/statistics.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::evaluation {

/// Errors of found corners over many images. Found and true corners are in canonical order, in pixels.
class CornerStatistics {
 public:
  void add(const geometry::Quadrilateral& found, const geometry::Quadrilateral& truth) {
    for (int i = 0; i < 4; ++i) {
      const int next = (i + 1) % 4;
      const Eigen::Vector2d error = found[i] - truth[i];
      distances_.push_back(error.norm());
      sum_ += error;
      squares_ += error.cwiseAbs2();
      const Eigen::Vector2d along = (truth[next] - truth[i]).normalized();
      const Eigen::Vector2d out(along.y(), -along.x());
      outward_sum_ += 0.5 * out.dot(error + found[next] - truth[next]);
    }
  }
  int frames() const { return static_cast<int>(distances_.size() / 4); }
  Eigen::Vector2d rms() const { return (squares_ / corners()).cwiseSqrt(); }  ///< per axis [px]
  Eigen::Vector2d mean() const { return sum_ / corners(); }                   ///< per axis [px]
  double median() const { return quantile(distances_, 0.5); }  ///< of the corners' distances [px]
  double worst() const { return quantile(distances_, 1.0); }   ///< of the corners' distances [px]
  /// Mean distance of the corners from the true sides, positive outwards: positive if the found border is too
  /// large [px].
  double outward() const { return outward_sum_ / corners(); }

 private:
  int corners() const { return std::max<int>(1, static_cast<int>(distances_.size())); }

  std::vector<double> distances_;
  Eigen::Vector2d sum_ = Eigen::Vector2d::Zero(), squares_ = Eigen::Vector2d::Zero();
  double outward_sum_ = 0.0;
};

}  // namespace window_ingress::evaluation
