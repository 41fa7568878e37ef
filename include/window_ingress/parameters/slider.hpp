#pragma once

#include "window_ingress/parameters/fields.hpp"

namespace window_ingress::parameters {

/// A field on a slider with whole positions from 0 on: switches and small whole numbers one by one; ranges
/// above zero of more than two decades by their logarithm, others evenly.
class Slider {
 public:
  static constexpr int kSteps = 1000;  ///< at most

  explicit Slider(const Field& field);

  int positions() const { return last_; }  ///< the last position; the first is 0
  int positionOf(double value) const;      ///< the nearest
  double valueAt(int position) const;      ///< of the ends: minimum and maximum, exactly

 private:
  bool goes_by_ones_;  // holds whole numbers only
  double minimum_, maximum_;
  bool logarithmic_;
  int last_;
};

}  // namespace window_ingress::parameters
