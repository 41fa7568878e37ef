#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <optional>

#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::detection {

/// Uncertainty of one side in the undistorted image: standard deviations across it at its middle and of its
/// direction. Zero: the side is not known.
struct SideSigma {
  double px = 0.0, rad = 0.0;

  bool known() const { return px > 0.0; }
};

/// The four borders as measured in the full image.
struct RefinedBorders {
  /// Intersections of neighbouring borders, canonical order, distorted pixels.
  geometry::Quadrilateral corners;
  std::array<Eigen::Matrix2d, 4> corner_covariance;  ///< [px^2]
  std::array<Edge, 4> edges;
  std::array<bool, 4> fitted = {};  ///< false: not fitted, the side stays where it was known to be
  std::array<SideSigma, 4> known;   ///< knowledge of the sides without their borders, from the start
  int seen = 0;                     ///< number of sides with a border, see `max_stray_px`
};

/// Start of a fit and what it may accept.
struct BorderStart {
  geometry::Quadrilateral quad;  ///< canonical order, pixels of the image
  double radius_px = 2.5;        ///< how far a border may lie from its start [px]
  /// What is known of the sides without their borders: top, right, bottom, left. A known side stays at its
  /// start if its border cannot be fitted or contradicts what is known; otherwise it becomes the weighted
  /// average of both. An unknown side must be fitted.
  std::array<SideSigma, 4> known = {};
  /// A fitted border with an end farther from the start than this is another edge [px].
  double max_stray_px = 1e3;
  std::optional<int> hidden = {};  ///< a known side without a visible border: it stays at its start

  /// All sides to within `sigma_px`, from end to end.
  void knowAll(double sigma_px);
};

/// Part of a side's profiles that must lie on its line.
constexpr double kMinBorderInliers = 0.4;

/// Sub-pixel fit of the four borders on the undilated gradient of the full image; corners are their
/// intersections. With a camera, points are undistorted (not the image), and borders are straight lines of
/// the undistorted image. Each side is sampled once, in narrow profiles.
/// \param image CV_8UC1 or CV_8UC3
/// \param worst_inliers if not null, gets the worst side's part of profiles on its line, even on failure
std::optional<RefinedBorders> refineBorders(const cv::Mat& image, const BorderStart& start,
                                            const geometry::PinholeCamera* camera,
                                            double* worst_inliers = nullptr);

}  // namespace window_ingress::detection
