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
/// degrees of freedom, where the corners are what they are said to be. Eight coordinates are seen, a pose has
/// six numbers; what is left are the aspect and the angle between the sides, see RectanglePrior.
/// \param ideal pixels of the undistorted image, canonical order
/// \param covariance of each corner [px^2]
/// \return nothing for what is not convex or not finite
std::optional<double> rectangleMisfit(const geometry::Quadrilateral& ideal,
                                      const std::array<Eigen::Matrix2d, 4>& covariance,
                                      const geometry::PinholeCamera& camera, const OpeningAspect& aspect);

/// A value as far as an image tells.
struct Measured {
  double value = 0.0, sigma = 0.0;
};

/// The target's shape as the reference image shows it: aspect of the opening, and the width of its frame
/// relative to the opening's sides. Both stay the same from anywhere; size does not show in one image.
class ReferenceShape {
 public:
  /// \param image by an unknown camera: its focal length is taken to be half to twice the longer side
  void learn(const cv::Mat& image, const geometry::Quadrilateral& opening);
  void forget() { aspect_.reset(), frame_.fill(0.0); }

  /// Of the opening; nothing before `learn`.
  std::optional<OpeningAspect> aspect() const;

  /// Why a shape is not the reference's; nothing where it is, or that cannot be told.
  /// \param corners fitted, pixels of the image as it came; \param camera null: unknown, as in `learn`; only
  /// coarsely told then
  std::optional<Rejection> inAspect(const geometry::Quadrilateral& corners,
                                    const std::array<Eigen::Matrix2d, 4>& covariance, const cv::Size& image,
                                    const geometry::PinholeCamera* camera) const;

  /// Middle of the four sides' widths, each over the reference's: one side may be hidden, or have a sill.
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
