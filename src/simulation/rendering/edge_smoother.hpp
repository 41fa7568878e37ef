#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "simulation/surfaces/faces.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::simulation {

/// Smooths the edges of surfaces by exact coverage, in an image drawn with one sample per pixel.
///
/// A projected side of a face may pass between two neighbouring pixels of which only one shows the face's
/// surface. Each of the two is then mixed with the other by the area that the side cuts off. The image's
/// alpha channel holds the surface of each pixel, so that hidden sides, and sides within a surface, have no
/// effect. (Persson, Geometric Post-process Anti-Aliasing, 2011, mixes in the same way, one pixel per edge.)
class EdgeSmoother {
 public:
  explicit EdgeSmoother(const geometry::PinholeCamera& camera);

  /// `drawn`: CV_8UC4, R, G, B and `Face::surface`; `image`: CV_8UC3, B, G, R of `drawn`, to be smoothed.
  /// Reads and writes only the rows `rows`. Where several sides pass between the same two pixels, the nearest
  /// one counts, because it hides the others.
  void smooth(const std::vector<Face>& faces, const std::vector<std::size_t>& visible,
              const Eigen::Isometry3d& T_camera_window, const cv::Mat& drawn, const cv::Range& rows,
              cv::Mat& image);

 private:
  /// Where a side passes between pixel `first` and `first + stride`.
  struct Crossing {
    std::ptrdiff_t first, stride;  // [px]
    double inverse_depth;          // [1/m]
    double middle;                 // of the side, from the first pixel's border [px]
    double slope;                  // motion of the side across, over one pixel along [px]
  };
  void follow(const Eigen::Vector3d& from_camera, const Eigen::Vector3d& to_camera, std::uint8_t surface);
  void keepNearest(const Crossing& crossing);
  void mixAll();

  geometry::PinholeCamera camera_;
  std::vector<Crossing> crossings_;
  std::array<std::vector<int>, 2> found_;  // number of the crossing + 1, to the right and downwards
  const std::uint8_t* drawn_ = nullptr;
  std::uint8_t* image_ = nullptr;
  cv::Range rows_;
};

}  // namespace window_ingress::simulation
