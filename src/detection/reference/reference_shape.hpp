#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "detection/alignment/rectangle_prior.hpp"
#include "detection/candidates/candidate_gates.hpp"
#include "detection/reference/side_profile.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

/// How badly four corners fit any view of a rectangle of a known aspect [standard deviations]: chi with two
/// degrees of freedom, if the corners have the given covariance. Eight coordinates are seen and a pose has
/// six numbers; the remaining two are the aspect and the angle between the sides, see RectanglePrior.
/// \param ideal pixels of the undistorted image, canonical order
/// \param covariance of each corner [px^2]
/// \return nothing for corners that are not convex or not finite
std::optional<double> rectangleMisfit(const geometry::Quadrilateral& ideal,
                                      const std::array<Eigen::Matrix2d, 4>& covariance,
                                      const geometry::PinholeCamera& camera, const OpeningAspect& aspect);

/// A value measured in an image.
struct Measured {
  double value = 0.0, sigma = 0.0;
};

/// The target's shape in the reference image: aspect of the opening, and width of its frame relative to the
/// opening's sides. Both are the same from any viewpoint; one image does not show size.
class ReferenceShape {
 public:
  /// \param image from an unknown camera, whose focal length is assumed to be half to twice the longer side
  void learn(const cv::Mat& image, const geometry::Quadrilateral& opening);
  void forget() { aspect_.reset(), frame_.fill(0.0); }

  /// Aspect of the opening; nothing before `learn`.
  std::optional<OpeningAspect> aspect() const;

  /// Why a shape is not the reference's; nothing if it is, or if that cannot be decided.
  /// \param corners fitted, raw pixels \param camera null: unknown, as in `learn`; then the test is coarse
  std::optional<Rejection> inAspect(const geometry::Quadrilateral& corners,
                                    const std::array<Eigen::Matrix2d, 4>& covariance, const cv::Size& image,
                                    const geometry::PinholeCamera* camera) const;

  /// Tests the median of the four sides' widths over the reference's: one side may be hidden or have a sill.
  std::optional<Rejection> inFrame(const cv::Mat& image, const geometry::Quadrilateral& corners,
                                   const geometry::PinholeCamera* camera);

 private:
  std::optional<Measured> frameRatio(const cv::Mat& image, const geometry::Quadrilateral& corners,
                                     const geometry::PinholeCamera* camera);

  std::optional<Measured> aspect_;  ///< sigma: half the range over all focal lengths
  double seen_aspect_ = 1.0;
  std::array<double, 4> frame_{};  ///< of each side [mean sides of the opening]; 0: no frame
  std::array<SideProfile, 4> sides_;
  std::vector<double> ratios_;
};

}  // namespace window_ingress::detection
