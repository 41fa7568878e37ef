#include "window_ingress/parameters/slider.hpp"

#include <algorithm>
#include <cmath>

namespace window_ingress::parameters {
namespace {

constexpr double kTwoDecades = 100.0;

}  // namespace

Slider::Slider(const Field& field)
    : goes_by_ones_(field.isWhole() || field.isSwitch()),
      minimum_(field.minimum),
      maximum_(field.maximum),
      logarithmic_(field.minimum > 0.0 && field.maximum > kTwoDecades * field.minimum),
      last_(kSteps) {
  if (goes_by_ones_ && maximum_ - minimum_ <= kSteps) {
    last_ = static_cast<int>(maximum_ - minimum_);
    logarithmic_ = false;
  }
}

int Slider::positionOf(double value) const {
  const double inside = std::clamp(value, minimum_, maximum_);
  const double part = logarithmic_ ? std::log(inside / minimum_) / std::log(maximum_ / minimum_)
                                   : (inside - minimum_) / (maximum_ - minimum_);
  return static_cast<int>(std::lround(part * last_));
}

double Slider::valueAt(int position) const {
  if (position <= 0) return minimum_;
  if (position >= last_) return maximum_;
  const double part = static_cast<double>(position) / last_;
  const double value =
      logarithmic_ ? minimum_ * std::pow(maximum_ / minimum_, part) : minimum_ + part * (maximum_ - minimum_);
  return goes_by_ones_ ? std::round(value) : value;
}

}  // namespace window_ingress::parameters
