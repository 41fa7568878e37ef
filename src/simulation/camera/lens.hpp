#pragma once

#include <opencv2/core.hpp>

#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::simulation {

/// Bends an ideal image as a lens with distortion does, by maps computed once.
class Lens {
 public:
  /// \throws std::invalid_argument if the distortion cannot be inverted over the image, or needs an ideal
  /// image of more than twice the width or height
  explicit Lens(const geometry::PinholeCamera& camera);

  /// The camera without distortion, wide enough to see all that the distorted one sees; the same one if there
  /// is no distortion.
  const geometry::PinholeCamera& idealCamera() const { return ideal_; }

  /// Of the images that `distort` makes.
  cv::Size size() const { return size_; }

  /// `image` shares its pixels with `ideal_image` if there is no distortion.
  void distort(const cv::Mat& ideal_image, cv::Mat& image) const;

 private:
  geometry::PinholeCamera ideal_;
  cv::Size size_;
  cv::Mat map_, map_fraction_;
};

}  // namespace window_ingress::simulation
