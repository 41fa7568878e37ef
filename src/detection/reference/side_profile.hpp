#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

/// Colours across one side of a loop, from inside to outside: means along the side.
struct SideProfile {
  double first = 0.0;                  ///< distance of the first mean, outwards positive [mean sides]
  double step = 0.0;                   ///< between two means
  std::vector<Eigen::Vector3f> means;  ///< BGR

  double at(int i) const { return first + i * step; }

  /// Mean colour between two distances, of at least one sample; false where the profile does not reach.
  bool mean(double from, double to, Eigen::Vector3f& colour) const;
  /// Change of the colour over two steps about a sample [grey levels]; 0 at the ends.
  float change(int i) const;
  /// Largest change between two distances, and its distance.
  double largestChange(double from, double to, double* place = nullptr) const;
};

/// Range and density of the samples round a loop.
struct ProfileReach {
  double inward = 0.0, outward = 0.0;  ///< [mean sides of the opening]
  double aspect = 1.0;                 ///< of the opening: width over height
  int along = 24;                      ///< samples along it
  int across = 140;                    ///< samples across it, at most; no more than one per pixel
  double from = 0.08, to = 0.92;       ///< along a side [of its length]
};

/// Measures the profiles of all four sides. A profile ends where the image does.
/// \param image CV_8UC3 \param loop convex, canonical order, raw pixels \param camera null: no distortion
void measureSides(const cv::Mat& image, const geometry::Quadrilateral& loop,
                  const geometry::PinholeCamera* camera, const ProfileReach& reach,
                  std::array<SideProfile, 4>& sides);

/// For each side of a window: whether its frame is also visible before its beginning and beyond its end.
using FrameEnds = std::array<std::array<bool, 2>, 4>;

/// Finds where frames continue, by their contrast with the wall, in any haze. Only sides count whose frame
/// looks like those of two others. \param sides buffers, reused; others as above
FrameEnds framesBeyond(const cv::Mat& image, const geometry::Quadrilateral& loop,
                       const geometry::PinholeCamera* camera, std::array<SideProfile, 4>& sides);

}  // namespace window_ingress::detection
