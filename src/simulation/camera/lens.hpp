#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::simulation {

/// An ideal camera that draws part of what a lens sees.
struct IdealPlane {
  geometry::PinholeCamera camera;
  Eigen::Matrix3d R_plane_camera;  ///< from the lens's optical frame to that of `camera`
  cv::Rect part;                   ///< of the ideal image, which holds all planes one below the other
};

/// Bends an ideal image as a lens with distortion does, by maps computed once.
///
/// The ideal image is one plane where twice the lens's width and height are enough. A fisheye that sees more
/// gets up to five faces of a cube around the camera, as much of each as it sees. What lies further than 1.5
/// rad off its axis is black, as beyond the image circle of a real one.
class Lens {
 public:
  /// \throws std::invalid_argument if the distortion cannot be inverted over the image, or if a lens other
  /// than a fisheye needs an ideal image of more than twice the width or height
  explicit Lens(const geometry::PinholeCamera& camera);

  /// Without distortion and wide enough to see all that the lens sees; the given camera itself if there is no
  /// distortion.
  const std::vector<IdealPlane>& planes() const { return planes_; }

  /// Of the ideal image.
  cv::Size idealSize() const { return ideal_size_; }

  /// Of the images that `distort` makes.
  cv::Size size() const { return size_; }

  /// `image` shares its pixels with `ideal_image` if there is no distortion.
  void distort(const cv::Mat& ideal_image, cv::Mat& image) const;

 private:
  void keep(const cv::Mat& map);

  std::vector<IdealPlane> planes_;
  cv::Size ideal_size_, size_;
  cv::Mat map_, map_fraction_, unseen_;
};

}  // namespace window_ingress::simulation
