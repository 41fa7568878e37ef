#pragma once

#include <array>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>

#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::detection {

/// How well the place of one side is known in the undistorted image: standard deviations across it, at its
/// middle, and of its direction. Zero: not at all.
struct SideSigma {
  double px = 0.0, rad = 0.0;

  bool known() const { return px > 0.0; }
};

/// The four borders as measured in the full image.
struct RefinedBorders {
  geometry::Quadrilateral
      corners;  ///< intersections of neighbouring borders, canonical order, pixels as they came
  std::array<Eigen::Matrix2d, 4> corner_covariance;  ///< [px^2]
  std::array<Edge, 4> edges;
  std::array<bool, 4> fitted = {};  ///< false: the side lies where it was known to lie, without its border
  std::array<SideSigma, 4> known;   ///< without their borders, as the start said
  int seen = 0;                     ///< sides at which there is a border, see `max_stray_px`
};

/// Where a fit starts and what it may take.
struct BorderStart {
  geometry::Quadrilateral quad;  ///< canonical order, pixels of the image
  double radius_px = 2.5;        ///< how far a border may lie from its start [px]
  /// What is known of the sides without their borders: top, right, bottom, left. A known side whose border
  /// cannot be fitted, or contradicts what is known, stays where it started; else it becomes the average of
  /// both, each by what it knows. An unknown side must be fitted.
  std::array<SideSigma, 4> known = {};
  /// A fitted border with an end farther from the start than this is another edge [px].
  double max_stray_px = 1e3;
  std::optional<int> hidden = {};  ///< a known side that has no border to be seen: it stays where it started

  /// All sides to within `sigma_px`, from end to end.
  void knowAll(double sigma_px);
};

/// Sub-pixel fit of the four borders on the gradient of the full image, undilated, corners by intersection.
/// With a camera the borders are straight lines of the undistorted image: points are undistorted, not the
/// image. Each side is sampled once, in narrow profiles. One object a thread: it keeps its memory.
class BorderRefinement {
 public:
  static constexpr double kMinInliers = 0.4;  ///< part of a side's profiles that must lie on its line

  BorderRefinement();
  ~BorderRefinement();
  BorderRefinement(BorderRefinement&&) noexcept;
  BorderRefinement& operator=(BorderRefinement&&) noexcept;

  /// \param image CV_8UC1 or CV_8UC3
  /// \param worst_inliers where not null: part of the profiles on the line of the worst side, also on failure
  std::optional<RefinedBorders> run(const cv::Mat& image, const BorderStart& start,
                                    const geometry::PinholeCamera* camera,
                                    double* worst_inliers = nullptr) const;

  struct Workspace;

 private:
  std::unique_ptr<Workspace> memory_;
};

}  // namespace window_ingress::detection
