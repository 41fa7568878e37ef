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

/// Smooths the edges of surfaces in an image that was drawn with one sample a pixel, by exact coverage.
///
/// Where the projected side of a face passes between two neighbouring pixels, one of which shows the face's
/// surface and the other does not, each of the two is mixed with the other by the area that the side cuts
/// off from it. Which surface a pixel shows stands in the image's alpha channel, so that hidden sides, and
/// those within a surface, do nothing. (Persson, Geometric Post-process Anti-Aliasing, 2011, mixes likewise,
/// one pixel an edge.)
class EdgeSmoother {
 public:
  explicit EdgeSmoother(const geometry::PinholeCamera& camera);

  /// `drawn`: CV_8UC4, R, G, B and `Face::surface`; `image`: CV_8UC3, B, G, R of `drawn`, to be smoothed.
  /// Only rows `rows` are read and written. Where several sides pass between the same two pixels, the
  /// nearest one counts: it hides the others.
  void smooth(const std::vector<Face>& faces, const std::vector<std::size_t>& visible,
              const Eigen::Isometry3d& T_camera_window, const cv::Mat& drawn, const cv::Range& rows,
              cv::Mat& image);

 private:
  struct Walk;
  /// Where a side passes between pixel `first` and `first + stride`.
  struct Crossing {
    std::ptrdiff_t first, stride;  // [px]
    double inverse_depth;          // [1/m]
    double middle;                 // of the side, from the first pixel's border [px]
    double slope;                  // the side moves so far across while it passes [px]
  };
  void follow(const Eigen::Vector3d& from_camera, const Eigen::Vector3d& to_camera, std::uint8_t surface);
  void step(const Walk& walk, int along);
  void keepNearest(const Crossing& crossing);
  void mixAll();

  geometry::PinholeCamera camera_;
  std::vector<Crossing> crossings_;
  std::array<std::vector<int>, 2>
      found_;  // number of the crossing + 1 towards the right, the lower neighbour
  const std::uint8_t* drawn_ = nullptr;
  std::uint8_t* image_ = nullptr;
  cv::Range rows_;
};

}  // namespace window_ingress::simulation
