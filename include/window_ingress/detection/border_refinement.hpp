#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <optional>

#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::detection {

/// The four borders as measured in the full image.
struct RefinedBorders {
  geometry::Quadrilateral
      corners;  ///< intersections of neighbouring borders, canonical order, pixels as they came
  std::array<Eigen::Matrix2d, 4> corner_covariance;  ///< [px^2]
  std::array<Edge, 4> edges;
  int seen = 4;                ///< sides at which there is a border, see `max_stray_px`
  double worst_inliers = 0.0;  ///< part of the profiles on the line, of the worst side
};

/// Where a fit starts and what it may take.
struct BorderStart {
  geometry::Quadrilateral quad;  ///< canonical order, pixels of the image
  double radius_px = 2.5;        ///< how far a border may lie from its start [px]
  /// Standard deviation of the start: a side whose border cannot be fitted stays where it started; 0: no
  /// result then.
  double fallback_sigma_px = 0.0;
  /// A fitted border with an end farther from the start than this is another edge [px].
  double max_stray_px = 1e3;
  /// A fitted border with an end farther from the start than this is seen, but does not move the side: where
  /// there is a reveal, the start is the more exact one [px].
  double max_shift_px = 1e3;
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
