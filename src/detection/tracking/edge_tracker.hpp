#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <opencv2/core.hpp>
#include <optional>

#include "detection/borders/edge_profiles.hpp"
#include "detection/borders/subpixel_border.hpp"
#include "detection/tracking/edge_template.hpp"
#include "window_ingress/detection/border_refinement.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::detection {

/// An image, and the lens that it was seen through; null: no distortion.
struct LensImage {
  const cv::Mat& image;
  const geometry::PinholeCamera* lens;

  int longerSide() const { return std::max(image.cols, image.rows); }
};

/// A straight stretch of the undistorted image.
struct Stretch {
  Eigen::Vector2d from, to;
  double length() const { return (to - from).norm(); }
};

/// The visible part of a stretch, at least `margin_px` inside the image; the longest part if a lens cuts it
/// into several. Nothing if none is visible.
std::optional<Stretch> stretchInView(const Stretch& whole, const LensImage& view, double margin_px);

/// Result of the search for one border at its predicted place.
struct FollowedBorder {
  bool in_view = false;  ///< enough of it should be in the image
  bool sought = false;   ///< in view, and its appearance is known: it was in the image when it was found
  bool fitted = false;   ///< found, with the same appearance and a fitted line
  Line line;             ///< in the undistorted image; its point is the middle between a and b
  Eigen::Vector2d a = Eigen::Vector2d::Zero(), b = Eigen::Vector2d::Zero();  ///< ends of the visible part
  double similarity = 0.0;                                                   ///< with the memory, -1 to 1
  double inliers = 0.0;  ///< part of its profiles on the line
};

/// Finds one border of the tracked window again, and remembers its appearance. Coarse step: shifts the
/// remembered pattern over a few profiles. Fine step: finds the steepest change in many short profiles.
class EdgeTracker {
 public:
  static constexpr double kReach = 0.0094;  ///< furthest from the prediction [longer image sides]

  /// \param predicted the whole side, undistorted \param size_px mean side of the window
  /// \param sigma_px standard deviation of the prediction across the side
  FollowedBorder follow(const LensImage& view, const Stretch& predicted, double size_px, double sigma_px);
  /// Updates the memory with the edge tracked last.
  void keep(double size_px) {
    memory_.learn(coarse_, seen_, half_px_, size_px / coarse_.pixel(), kLearningRate);
  }
  /// Declares that the border lies beside the edge tracked last. From now on it is reported at this distance
  /// from that edge. \return false, and nothing changed, if the distance exceeds `furthest_px`
  bool keepApart(const Line& border, double size_px, double furthest_px);
  /// Replaces the memory with the appearance of a border known to lie there.
  void learn(const LensImage& view, const Stretch& border, double size_px);
  /// As `learn`, for a border known from its surroundings: tracks the edge nearest to it instead.
  void learnNear(const LensImage& view, const Stretch& border, double size_px);

 private:
  Stretch edgeOf(const Stretch& side, double size_px);
  bool fit(const LensImage& view, const OffsetLine& coarse, double size_px, FollowedBorder& border);

  static constexpr double kLearningRate = 0.15;  // per image

  EdgeTemplate memory_;
  EdgeProfiles coarse_, fine_;
  SubpixelBorder fit_;
  FittedBorder edge_;                                 // as tracked last, in the fine profiles' axes
  Eigen::Vector2d middle_ = Eigen::Vector2d::Zero();  // of the side on which it was searched
  /// Distance from the tracked edge outwards to the border, about the side's middle. The edges of a reveal
  /// separate with the square of the window's size.
  struct {
    double offset = 0.0, slope = 0.0;  // offset over the square of the window's size [1 / px]
    SideSigma sigma;                   // across, over the window's size

    double px(double size_px) const { return offset * size_px * size_px; }
  } apart_;
  std::optional<bool> soft_;  // colours beside the border, see `isColourSoft`
  OffsetLine seen_;           // as tracked last, in the coarse profiles' axes
  int half_px_ = 6;
};

}  // namespace window_ingress::detection
