#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::evaluation {

/// Errors of found corners over many images. Found and true corners are in canonical order, in pixels.
class CornerStatistics {
 public:
  void add(const geometry::Quadrilateral& found, const geometry::Quadrilateral& truth);
  int frames() const { return static_cast<int>(distances_.size() / 4); }
  Eigen::Vector2d rms() const;   ///< per axis [px]
  Eigen::Vector2d mean() const;  ///< per axis [px]
  double median() const;         ///< of the corners' distances [px]
  double worst() const;          ///< of the corners' distances [px]
  /// Mean distance of the corners from the true sides, positive outwards: positive if the found border is too
  /// large [px].
  double outward() const;

 private:
  int corners() const { return std::max<int>(1, static_cast<int>(distances_.size())); }

  std::vector<double> distances_;
  Eigen::Vector2d sum_ = Eigen::Vector2d::Zero(), squares_ = Eigen::Vector2d::Zero();
  double outward_sum_ = 0.0;
};

double meanCornerDistance(const geometry::Quadrilateral& a, const geometry::Quadrilateral& b);  ///< [px]

}  // namespace window_ingress::evaluation
