#pragma once

#include <optional>

#include "detection/alignment/rectangle_prior.hpp"
#include "detection/candidates/candidate_gates.hpp"
#include "detection/reference/side_profile.hpp"

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

/// The target's shape in the reference image: aspect of the opening, and width of its frame relative to the
/// opening's sides. Both are the same from any viewpoint; one image does not show size.
class ReferenceShape {
 public:
  /// \param image from an unknown camera, whose focal length is assumed to be half to twice the longer side
  void learn(const cv::Mat& image, const geometry::Quadrilateral& opening);

  /// Aspect of the opening, uncertain as the focal length; nothing before `learn`.
  const std::optional<OpeningAspect>& aspect() const { return aspect_; }

  /// Why a shape is not the reference's; nothing if it is, or if that cannot be decided.
  /// \param corners fitted, raw pixels \param camera null: unknown, as in `learn`; then the test is coarse
  std::optional<Rejection> inAspect(const geometry::Quadrilateral& corners,
                                    const std::array<Eigen::Matrix2d, 4>& covariance, const cv::Size& image,
                                    const geometry::PinholeCamera* camera) const;

  /// Tests the median of the four sides' widths over the reference's: one side may be hidden or have a sill.
  std::optional<Rejection> inFrame(const cv::Mat& image, const geometry::Quadrilateral& corners,
                                   const geometry::PinholeCamera* camera);

 private:
  std::optional<OpeningAspect> aspect_;
  double seen_aspect_ = 1.0;
  std::array<double, 4> frame_{};  ///< of each side [mean sides of the opening]; 0: no frame
  std::array<SideProfile, 4> sides_;
};

}  // namespace window_ingress::detection
