#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "detection/borders/edge_profiles.hpp"
#include "detection/borders/subpixel_border.hpp"
#include "detection/tracking/edge_template.hpp"
#include "window_ingress/detection/border_refinement.hpp"
#include "window_ingress/detection/detector_params.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::detection {

/// A straight stretch of the undistorted image.
struct Stretch {
  Eigen::Vector2d from, to;
  double length() const { return (to - from).norm(); }
};

/// The part of a stretch that the image shows, `margin_px` from its border; the longest part if a lens cuts
/// it into several. Nothing if it shows none.
/// \param lens null where the image is free of distortion
std::optional<Stretch> stretchInView(const Stretch& whole, const cv::Size& image, double margin_px,
                                     const geometry::PinholeCamera* lens);

/// One border looked for where it is predicted.
struct FollowedBorder {
  bool in_view = false;  ///< enough of it should be in the image
  bool sought = false;   ///< and what it looks like is known: not of a side at the image's edge when found
  bool fitted = false;   ///< it is there, looks as before, and a line fits it
  Line line;             ///< in the undistorted image, its point in the middle between a and b
  Eigen::Vector2d a = Eigen::Vector2d::Zero(), b = Eigen::Vector2d::Zero();  ///< ends of what was seen
  double similarity = 0.0;                                                   ///< with the memory, -1 to 1
  double inliers = 0.0;  ///< part of its profiles on the line
};

/// Finds one border of the tracked window again, and remembers what it looks like. Coarse: its pattern is
/// moved over a few profiles. Fine: the steepest change in many short ones.
class EdgeTracker {
 public:
  static constexpr double kReach = 0.0094;  ///< of a border from where it is predicted [longer image sides]

  /// \param predicted the whole side, undistorted \param size_px of the window: mean side
  /// \param sigma_px of the prediction across the side
  FollowedBorder follow(const cv::Mat& image, const geometry::PinholeCamera* lens, const Stretch& predicted,
                        double size_px, double sigma_px);
  /// Takes the edge as followed last into memory.
  void keep(double size_px) {
    memory_.learn(coarse_, seen_, half_px_, size_px / coarse_.pixel(), kLearningRate);
  }
  /// The border lies there, beside the edge that was followed last: from now on it is reported so far from
  /// that edge. \return false, and nothing changed, if that is farther than `furthest_px`
  bool keepApart(const Line& border, double size_px, double furthest_px);
  /// Takes a border that is known to lie there into memory, in place of everything else.
  void learn(const cv::Mat& image, const geometry::PinholeCamera* lens, const Stretch& border,
             double size_px);

  /// The same of a border which is known by what lies round it: the edge nearest to it is followed for it.
  void learnNear(const cv::Mat& image, const geometry::PinholeCamera* lens, const Stretch& border,
                 double size_px);

 private:
  Stretch edgeOf(const Stretch& side, double size_px);
  bool fit(const cv::Mat& image, const geometry::PinholeCamera* lens, const OffsetLine& coarse,
           double size_px, FollowedBorder& border);

  static constexpr double kLearningRate = 0.15;  // an image

  EdgeTemplate memory_;
  EdgeProfiles coarse_, fine_;
  SubpixelBorder fit_;
  FittedBorder edge_;                                 // as followed last, in the fine profiles' axes
  Eigen::Vector2d middle_ = Eigen::Vector2d::Zero();  // of the side that it was looked for on
  /// From the edge outwards to the border, about the side's middle. The edges of a reveal part with the
  /// square of the window's size.
  struct {
    double offset = 0.0, slope = 0.0;  // the offset over the square of the window's size [1 / px]
    SideSigma sigma;                   // across over the window's size

    double px(double size_px) const { return offset * size_px * size_px; }
  } apart_;
  std::optional<bool> soft_;  // the colours beside the border, see `isColourSoft`
  OffsetLine seen_;           // as followed last, in the coarse profiles' axes
  int half_px_ = 6;
};

}  // namespace window_ingress::detection
