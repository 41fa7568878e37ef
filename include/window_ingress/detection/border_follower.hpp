#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "window_ingress/detection/border_fit.hpp"
#include "window_ingress/detection/border_memory.hpp"
#include "window_ingress/detection/border_refinement.hpp"
#include "window_ingress/detection/front_border.hpp"
#include "window_ingress/detection/stretch_in_view.hpp"
#include "window_ingress/detection/track_params.hpp"

namespace window_ingress::detection {

/// One border looked for where it is predicted.
struct FollowedBorder {
  bool in_view = false;  ///< enough of it should be in the picture
  bool fitted = false;   ///< it is there, looks as before, and a line fits it
  Line line;             ///< in the undistorted image, its point in the middle between a and b
  Eigen::Vector2d a = Eigen::Vector2d::Zero(), b = Eigen::Vector2d::Zero();  ///< ends of what was seen
  double similarity = 0.0;                                                   ///< with the memory, -1 to 1
  double inliers = 0.0;  ///< part of its profiles on the line
};

/// Finds one border of the tracked window again, and remembers what it looks like. Coarse: its pattern is
/// moved over a few profiles. Fine: the steepest change in many short ones.
class BorderFollower {
 public:
  BorderFollower(const TrackParams& track, const BorderRefinementParams& refinement)
      : track_(track), refinement_(refinement) {}

  /// \param predicted the whole side, undistorted \param size_px of the window: mean side
  /// \param sigma_px of the prediction across the side
  FollowedBorder follow(const cv::Mat& image, const geometry::PinholeCamera* lens, const Stretch& predicted,
                        double size_px, double sigma_px);
  /// Takes the border as followed last into memory; or, where it turned out not to be the front one, the
  /// front one, which is then found in the next picture.
  void keep(const cv::Mat& image, const geometry::PinholeCamera* lens, double size_px);
  /// Takes a border that is known to lie there into memory, in place of everything else.
  void learn(const cv::Mat& image, const geometry::PinholeCamera* lens, const Stretch& border,
             double size_px);

  const BorderMemory& memory() const { return memory_; }

 private:
  bool fit(const cv::Mat& image, const geometry::PinholeCamera* lens, const OffsetLine& coarse,
           FollowedBorder& border);

  TrackParams track_;
  BorderRefinementParams refinement_;
  BorderMemory memory_;
  FrontBorder front_;
  EdgeProfiles coarse_, fine_;
  BorderFit fit_;
  DoubleEdge edge_;  // of a reveal beside the border, as seen last
  int frames_ = -1;
  std::optional<bool> soft_;  // the colours beside the border, see `isColourSoft`
  OffsetLine seen_;           // as followed last, in the coarse profiles' axes
  int half_px_ = 6;
};

}  // namespace window_ingress::detection
