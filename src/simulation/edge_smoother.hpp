#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "faces.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::simulation {

/// Smooths the edges of surfaces in a picture that was drawn with one sample a pixel, by exact coverage.
///
/// Where the projected side of a face passes between two neighbouring pixels, one of which shows the face's
/// surface and the other does not, each of the two is mixed with the other by the area that the side cuts
/// off from it. Which surface a pixel shows stands in the picture's alpha channel, so that hidden sides, and
/// those within a surface, do nothing. (Persson, Geometric Post-process Anti-Aliasing, 2011, mixes likewise,
/// one pixel an edge.)
class EdgeSmoother {
 public:
  explicit EdgeSmoother(const geometry::PinholeCamera& camera);

  /// `drawn`: CV_8UC4, R, G, B and `Face::surface`; `image`: CV_8UC3, B, G, R of `drawn`, to be smoothed.
  /// Only rows `rows` are read and written. Near faces go first, where two sides lie between the same
  /// pixels the first one counts.
  void smooth(const std::vector<Face>& faces, const std::vector<std::size_t>& near_first,
              const Eigen::Isometry3d& T_camera_window, const cv::Mat& drawn, const cv::Range& rows,
              cv::Mat& image);

 private:
  struct Walk;
  void follow(const Eigen::Vector3d& from_camera, const Eigen::Vector3d& to_camera, std::uint8_t surface);
  void step(const Walk& walk, int along, double across);

  geometry::PinholeCamera camera_;
  std::vector<std::uint8_t> mixed_;  // bits: with the right, with the lower neighbour
  const std::uint8_t* drawn_ = nullptr;
  std::uint8_t* image_ = nullptr;
  cv::Range rows_;
};

}  // namespace window_ingress::simulation
