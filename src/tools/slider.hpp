/// A parameter on a slider of tune_detector.
#pragma once

#include <algorithm>
#include <cmath>

#include "window_ingress/parameters/fields.hpp"

namespace window_ingress::tools {

/// A field on a slider with integer positions from 0. Switches and small integers have one position each,
/// positive ranges of more than two decades are logarithmic, all others linear.
class Slider {
 public:
  static constexpr int kSteps = 1000;  ///< at most

  explicit Slider(const parameters::Field& field)
      : goes_by_ones_(field.isWhole() || field.isSwitch()),
        minimum_(field.minimum),
        maximum_(field.maximum),
        logarithmic_(minimum_ > 0.0 && maximum_ > kTwoDecades * minimum_) {
    if (!goes_by_ones_ || maximum_ - minimum_ > kSteps) return;
    last_ = static_cast<int>(maximum_ - minimum_);
    logarithmic_ = false;
  }

  int positions() const { return last_; }  ///< the last position; the first is 0
  int positionOf(double value) const {     ///< the nearest
    const double inside = std::clamp(value, minimum_, maximum_);
    const double part = logarithmic_ ? std::log(inside / minimum_) / std::log(maximum_ / minimum_)
                                     : (inside - minimum_) / (maximum_ - minimum_);
    return static_cast<int>(std::lround(part * last_));
  }
  double valueAt(int position) const {  ///< exactly minimum and maximum at the ends
    if (position <= 0) return minimum_;
    if (position >= last_) return maximum_;
    const double part = static_cast<double>(position) / last_;
    const double value = logarithmic_ ? minimum_ * std::pow(maximum_ / minimum_, part)
                                      : minimum_ + part * (maximum_ - minimum_);
    return goes_by_ones_ ? std::round(value) : value;
  }

 private:
  static constexpr double kTwoDecades = 100.0;
  bool goes_by_ones_;  // holds integers only
  double minimum_, maximum_;
  bool logarithmic_;
  int last_ = kSteps;
};

}  // namespace window_ingress::tools
