#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::simulation {

/// An ideal camera that draws part of the lens's view.
struct IdealPlane {
  geometry::PinholeCamera camera;
  Eigen::Matrix3d R_plane_camera;  ///< from the lens's optical frame to that of `camera`
  cv::Rect part;                   ///< of the ideal image, in which the planes lie one below the other
};

/// Distorts an ideal image as a lens does, by maps computed once.
///
/// The ideal image is one plane if twice the lens's width and height are enough. A fisheye with a wider view
/// gets up to five faces of a cube around the camera, as much of each as it sees. Points further than 1.5 rad
/// off the axis are black, as beyond the image circle of a real lens.
class Lens {
 public:
  /// \throws std::invalid_argument if the distortion cannot be inverted over the image, or if a lens other
  /// than a fisheye needs an ideal image of more than twice the width or height
  explicit Lens(const geometry::PinholeCamera& camera);

  /// Planes without distortion that cover the lens's view; the given camera itself if it has no distortion.
  const std::vector<IdealPlane>& planes() const { return planes_; }

  /// Size of the ideal image.
  cv::Size idealSize() const { return ideal_size_; }

  /// Size of the images from `distort`.
  cv::Size size() const { return size_; }

  /// `image` shares its pixels with `ideal_image` if there is no distortion.
  void distort(const cv::Mat& ideal_image, cv::Mat& image) const;

 private:
  std::vector<IdealPlane> planes_;
  cv::Size ideal_size_, size_;
  cv::Mat map_, map_fraction_, unseen_;
};

}  // namespace window_ingress::simulation
