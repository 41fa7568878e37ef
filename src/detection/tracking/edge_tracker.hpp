#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "detection/borders/border_fit.hpp"
#include "detection/borders/edge_profiles.hpp"
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

/// Keeps a border at the front of the opening while the window comes nearer.
///
/// From afar the two edges of a reveal (front: frame or wall to reveal; back: reveal to what is behind) are
/// one; nearer they part, and the back one is often the stronger. The front one is where the colour outside,
/// that of frame or wall, ends: it was next to the border when the edges were one, and is remembered. When
/// something else has come between the border and that colour, the border is moved out to where it begins.
/// Lines of the wall beyond (courses of bricks, the frame's outer border) are none of that: the remembered
/// colour lies between them and the border.
class FrontBorder {
 public:
  static constexpr int kHalf = 10;  ///< offsets that are looked at [px]

  void forget() { known_ = false; }
  /// Colour next to the border, BGR; null while nothing is known.
  const Eigen::Vector3f* outside() const { return known_ ? &outside_ : nullptr; }

  /// The border lies along this line.
  /// \return how far out the front border is from it, if it is another one; after it was so several times
  std::optional<double> look(const EdgeProfiles& profiles, const OffsetLine& border, int half_px);

 private:
  Eigen::Vector3f likest(const float* mean, int channels, int half) const;
  std::optional<int> partedAt(const float* mean, int channels, int half) const;

  bool known_ = false;
  Eigen::Vector3f outside_ = Eigen::Vector3f::Zero();  // colour next to the border
  int parted_ = 0;                                     // times in a row
};

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
  /// Takes the border as followed last into memory; or, where it turned out not to be the front one, the
  /// front one, which is then found in the next image.
  void keep(const cv::Mat& image, const geometry::PinholeCamera* lens, double size_px);
  /// Takes a border that is known to lie there into memory, in place of everything else.
  void learn(const cv::Mat& image, const geometry::PinholeCamera* lens, const Stretch& border,
             double size_px);

  const EdgeTemplate& memory() const { return memory_; }

 private:
  bool fit(const cv::Mat& image, const geometry::PinholeCamera* lens, const OffsetLine& coarse,
           FollowedBorder& border);

  EdgeTemplate memory_;
  FrontBorder front_;
  EdgeProfiles coarse_, fine_;
  BorderFit fit_;
  TwoStepEdge edge_;  // of a reveal beside the border, as seen last
  int frames_ = -1;
  std::optional<bool> soft_;  // the colours beside the border, see `isColourSoft`
  OffsetLine seen_;           // as followed last, in the coarse profiles' axes
  int half_px_ = 6;
};

}  // namespace window_ingress::detection
