#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "detection/borders/edge_profiles.hpp"
#include "detection/borders/lines.hpp"
#include "detection/borders/two_step_edge.hpp"

namespace window_ingress::detection {

/// A fitted border relative to its profile grid: offset and slope against the grid's middle line, in the
/// profiles' pixels.
struct FittedBorder {
  OffsetLine line;
  double from = 0.0, to = 0.0;  ///< outermost profiles on the line, positions along the grid [px]
  /// Standard deviation across the line, at its middle; larger where a reveal's two edges look like one [px].
  double sigma_px = 0.0;
  double sigma_rad = 0.0;  ///< of its direction [rad]
  int inliers = 0;         ///< profiles on the line

  double middle() const { return 0.5 * (from + to); }
  /// The line in the undistorted image; its point is the middle of the visible stretch.
  Line inImage(const EdgeProfiles& profiles) const;
};

/// Limits of what a fit accepts as the border.
struct SubpixelBorderLimits {
  double radius_px = 2.0;   ///< search reach across the starting line [px]
  double prior_px = 1e3;    ///< scale of the preference for edges near the starting line [px]
  double outlier_px = 0.6;  ///< scale of the robust fit [px]
};

/// Sub-pixel fit of one border. Finds in each profile the steepest change of the wanted colour near a line,
/// and fits a robust line through these points. The spread follows from the residuals. Keeps its memory.
class SubpixelBorder {
 public:
  /// Projects the profiles onto a direction in colour space (unit vector), along which the colour changes
  /// outwards. Grey profiles use the sum of its components.
  void project(const EdgeProfiles& profiles, const Eigen::Vector3f& colour);

  /// Projects onto the direction in which the side as a whole changes most, preferring changes near the
  /// middle line to those at `radius_px`. \return false if no change is strong enough for an edge
  bool projectStrongest(const EdgeProfiles& profiles, double radius_px);

  /// Moves `border.line` onto the edges near it. \return false if fewer than four profiles lie on it; then
  /// only the line has changed
  bool run(const SubpixelBorderLimits& limits, FittedBorder& border);

  /// After a fit: moves the border to the front edge of its reveal if another edge was fitted
  /// (`TwoStepEdge`), and adds the uncertainty of that edge to its spread.
  /// \param limits of the front edge, relative to the fit [px]
  void toFront(const TwoStepEdgeLimits& limits, FittedBorder& border) const;

 private:
  std::optional<int> steepest(int i, double centre, const SubpixelBorderLimits& limits) const;
  const float* slopesOf(int i) const {  // middle sample: valid from -reach to reach
    return slopes_.data() + static_cast<std::size_t>(i) * profiles_->width() + profiles_->reach();
  }
  void measure(const OffsetLine& about, const SubpixelBorderLimits& limits);
  void spread(const SubpixelBorderLimits& limits, FittedBorder& border) const;

  const EdgeProfiles* profiles_ = nullptr;
  std::vector<float> slopes_;  // of the projected profiles [grey levels per pixel]
  std::vector<double> positions_, offsets_;
  std::vector<float> mean_, sizes_;       // the side's mean profile; sizes of its changes
  std::vector<Eigen::Vector3f> changes_;  // of the mean colour over two pixels, by offset
};

}  // namespace window_ingress::detection
