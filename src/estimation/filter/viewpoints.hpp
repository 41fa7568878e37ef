#pragma once

#include <Eigen/Core>
#include <vector>

#include "window_ingress/estimation/filter_params.hpp"

namespace window_ingress::estimation {

/// Counts the images taken from each place, so that the systematic error they share is not averaged away.
/// Places nearer to each other than `FilterParams::kSystematicRenewalM` are one.
class Viewpoints {
 public:
  /// Number of images taken from here, including one more.
  double looksWith(const Eigen::Vector3d& position) const {
    const std::size_t here = nearest(position);
    return here == places_.size() ? 1.0 : places_[here].looks + 1.0;
  }
  void add(const Eigen::Vector3d& position) {
    const double looks = looksWith(position);
    if (looks > 1.0)
      places_[nearest(position)].looks = looks;
    else
      places_.push_back({position, 1.0});
    if (places_.size() > kMaxPlaces) places_.erase(places_.begin());
  }
  void clear() { places_.clear(); }

 private:
  struct Place {
    Eigen::Vector3d position;
    double looks;
  };
  static constexpr std::size_t kMaxPlaces = 256;  ///< the oldest is forgotten

  /// Index of the place that the position belongs to; the number of places if there is none.
  std::size_t nearest(const Eigen::Vector3d& position) const {
    std::size_t index = places_.size();
    double least_m = FilterParams::kSystematicRenewalM;
    for (std::size_t i = 0; i < places_.size(); ++i)
      if (const double apart_m = (places_[i].position - position).norm(); apart_m < least_m)
        least_m = apart_m, index = i;
    return index;
  }

  std::vector<Place> places_;
};

}  // namespace window_ingress::estimation
