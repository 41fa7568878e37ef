#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <optional>

#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::detection {

struct BorderRefinementParams {
  int samples = 80;              ///< profiles across each side, at most one a pixel
  double skip = 0.06;            ///< left out at both ends of a side, in its lengths
  double final_radius_px = 2.0;  ///< reach of the second pass, at a longer side of 640; grows with it [px]
  double outlier_px = 0.6;       ///< scale of the robust fit, at a longer side of 640; grows with it [px]
  double min_inliers = 0.4;      ///< part of a side's profiles that must lie on its line
  double sigma_floor_px = 0.03;  ///< no edge is claimed to be known better than this [px]

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("samples", self.samples, 4, 2000);
    field("skip", self.skip, 0.0, 0.4);
    field("final_radius_px", self.final_radius_px, 1.0, 20.0);
    field("outlier_px", self.outlier_px, 0.05, 10.0);
    field("min_inliers", self.min_inliers, 0.0, 1.0);
    field("sigma_floor_px", self.sigma_floor_px, 1e-4, 10.0);
  }
};

/// The four borders as measured in the full image.
struct RefinedBorders {
  geometry::Quadrilateral
      corners;  ///< intersections of neighbouring borders, canonical order, pixels as they came
  std::array<Eigen::Matrix2d, 4> corner_covariance;  ///< [px^2]
  std::array<Edge, 4> edges;
  int fitted = 4;              ///< sides; the others are where they started
  double worst_inliers = 0.0;  ///< part of the profiles on the line, of the worst side
};

/// Which of several edges near a side's start is its border.
enum class EdgeChoice {
  kNearest,      ///< the strongest, those near the start counting more
  kFirstInward,  ///< coming from outside, the first: where the paint of a frame ends towards its opening
  kFirstOutward  ///< coming from inside, the first: where the paint of a frame ends towards the wall
};

/// Where a fit starts and what it may take.
struct BorderStart {
  geometry::Quadrilateral quad;  ///< canonical order, pixels of the image
  double radius_px = 2.5;        ///< how far a border may lie from its start [px]
  EdgeChoice choice = EdgeChoice::kNearest;
  /// Standard deviation of the start: a side whose border cannot be fitted stays where it started; 0: no
  /// result then.
  double fallback_sigma_px = 0.0;
  /// Furthest that an end of a fitted border may lie from the start and be believed [px].
  double max_stray_px = 1e3;
};

/// Sub-pixel fit of the four borders on the gradient of the full image, undilated, corners by intersection.
/// With a camera the borders are straight lines of the undistorted image: points are undistorted, not the
/// image. Each side is sampled once, in narrow profiles. One object a thread: it keeps its memory.
class BorderRefinement {
 public:
  explicit BorderRefinement(const BorderRefinementParams& params);
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
  BorderRefinementParams params_;
  std::unique_ptr<Workspace> memory_;
};

}  // namespace window_ingress::detection
