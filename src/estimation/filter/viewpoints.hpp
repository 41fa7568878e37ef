#pragma once

#include <Eigen/Core>
#include <vector>

namespace window_ingress::estimation {

/// Counts the images taken from each place, so that the systematic error they share is not averaged away.
/// Places nearer to each other than `FilterParams::kSystematicRenewalM` are one.
class Viewpoints {
 public:
  /// Number of images taken from here, including one more.
  double looksWith(const Eigen::Vector3d& position) const;
  void add(const Eigen::Vector3d& position);
  void clear() { places_.clear(); }

 private:
  struct Place {
    Eigen::Vector3d position;
    double looks;
  };
  static constexpr std::size_t kMaxPlaces = 256;  ///< the oldest is forgotten
  std::vector<Place> places_;
};

}  // namespace window_ingress::estimation
