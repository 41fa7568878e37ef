#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "detection/borders/edge_profiles.hpp"
#include "detection/borders/lines.hpp"
#include "detection/borders/robust_line_fit.hpp"
#include "detection/borders/two_step_edge.hpp"

namespace window_ingress::detection {

/// A border within the profiles taken across its start: offset and slope against the grid's middle line, in
/// the pixels that these count across.
struct FittedBorder {
  OffsetLine line;
  double from = 0.0, to = 0.0;  ///< outermost profiles on the line, positions along the grid [px]
  /// Across the line, in the middle between them; the larger where a reveal's two edges look like one [px].
  double sigma_px = 0.0;
  double sigma_rad = 0.0;  ///< of its direction [rad]
  int inliers = 0;         ///< profiles on the line

  double middle() const { return 0.5 * (from + to); }
  /// The line in the undistorted image, its point in the middle of what was seen.
  Line inImage(const EdgeProfiles& profiles) const;
};

/// What a fit may take for the border.
struct SubpixelBorderLimits {
  double radius_px = 2.0;   ///< reach across the line it is looked for at [px]
  double prior_px = 1e3;    ///< scale of the preference for edges near that line [px]
  double outlier_px = 0.6;  ///< scale of the robust fit [px]
};

/// Sub-pixel position of one border: in each profile the steepest change of the wanted colour near a line, to
/// a fraction of a pixel; a robust line through them; its spread by what is left over. Keeps its memory.
class SubpixelBorder {
 public:
  /// Takes the profiles along one direction in colour space, unit vector: towards it they rise outwards. Grey
  /// profiles use its sum.
  void project(const EdgeProfiles& profiles, const Eigen::Vector3f& colour);

  /// The same along the direction in which the side as a whole changes most, near the middle line rather than
  /// at `radius_px` from it. \return false if it changes nowhere as an edge does
  bool projectStrongest(const EdgeProfiles& profiles, double radius_px);

  /// Moves `border.line` onto the edges near it. \return false, and only the line changed, if there are fewer
  /// than four profiles on it
  bool run(const SubpixelBorderLimits& limits, FittedBorder& border);

  /// After a fit: moves the border to the front edge of its reveal where that is another one than was fitted
  /// (`TwoStepEdge`), and enlarges its spread by what is not known of it.
  /// \param limits of the front edge, from what was fitted [px]
  void toFront(const TwoStepEdgeLimits& limits, FittedBorder& border) const;

 private:
  std::optional<int> steepest(int i, double centre, const SubpixelBorderLimits& limits) const;
  const float* slopesOf(int i) const {  // its middle: from -reach to reach
    return slopes_.data() + static_cast<std::size_t>(i) * profiles_->width() + profiles_->reach();
  }
  void measure(const OffsetLine& about, const SubpixelBorderLimits& limits);
  void spread(const SubpixelBorderLimits& limits, FittedBorder& border) const;

  const EdgeProfiles* profiles_ = nullptr;
  std::vector<float> slopes_;  // of the projected profiles, grey levels a pixel
  std::vector<int> peak_at_;   // by profile: sample of the edge, and its offset
  std::vector<double> peak_, positions_, offsets_, scratch_;
  std::vector<float> mean_;               // of all profiles, channel by channel
  std::vector<Eigen::Vector3f> changes_;  // of the mean colour over two pixels, by offset
  std::vector<float> sizes_;              // of the changes
};

}  // namespace window_ingress::detection
