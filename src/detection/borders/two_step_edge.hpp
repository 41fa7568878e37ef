#pragma once

#include <Eigen/Core>

namespace window_ingress::detection {

/// Position of a border whose blur overlaps that of a neighbouring edge.
struct TwoStepEdge {
  double front = 0.0;     ///< offset of the outermost change [px]
  double apart = 0.0;     ///< distance of the change behind it, inwards [px]; 0: only one change
  double sigma_px = 0.0;  ///< uncertainty of `front` due to the second change [px]
};

/// Limits of the front edge.
struct TwoStepEdgeLimits {
  double nearest_px = -1.2, farthest_px = 1.2;  ///< offsets, outwards positive [px]
};

/// A reveal seen at a narrow angle is a strip of a few pixels or less. Its front edge (frame or wall to
/// reveal) and its back edge (reveal to what is behind) blur into each other. The steepest change then lies
/// between them, or is the back edge alone. The front edge is the border.
///
/// Fits one step of unknown blur to the colours across the border. Where that does not explain them, fits two
/// steps of the same blur, whose three colours are free in each channel (variable projection, Golub and
/// Pereyra 1973), with the Levenberg-Marquardt method. Two steps are accepted if they explain what one does
/// not, and if the front one is then well known.
///
/// \param mean colours across the border, inside to outside, one pixel apart, channel by channel, 2 half + 1
/// each, the steepest change near the middle
/// \param channels 1 or 3 \param half 4 to `kMaxHalfOfEdge`
TwoStepEdge fitTwoStepEdge(const float* mean, int channels, int half, const TwoStepEdgeLimits& limits);
constexpr int kMaxHalfOfEdge = 8;

}  // namespace window_ingress::detection
