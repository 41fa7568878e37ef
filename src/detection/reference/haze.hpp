#pragma once

#include <Eigen/Core>
#include <optional>

#include "detection/reference/ring_colours.hpp"

namespace window_ingress::detection {

/// Haze between camera and window, or glare on the lens: the same part of each colour is left, and the same
/// light is added to all (Koschmieder). Colour differences keep their direction and shrink equally, so they
/// can be recognised even where hardly anything of the colours is left.
struct Haze {
  double left = 1.0;                                ///< part of each colour, 0 to 1
  Eigen::Vector3f added = Eigen::Vector3f::Zero();  ///< light added, BGR

  /// The colour without haze.
  Eigen::Vector3f off(const Eigen::Vector3f& seen) const { return (seen - added) / static_cast<float>(left); }
};

/// The haze that turns the reference's wall into the wall seen, and its difference to the frame into the
/// difference seen.
/// \param left part of the difference that is left
/// \param darkest least channel seen nearby, the most that haze may add [grey levels]
/// \return nothing if no haze can do that: nothing would be left, or the haze would have a strong colour or
/// be brighter than the darkest place
std::optional<Haze> hazeThatLeaves(double left, const Eigen::Vector3f& reference_wall,
                                   const Eigen::Vector3f& seen_wall, double darkest);

/// Bhattacharyya distance, through haze, between the directions of the frame-to-surround differences (normal
/// distributions). \return nothing where there is no haze, or it leaves less than noise
std::optional<double> distanceThroughHaze(const RingMeans& reference, const RingMeans& seen);

}  // namespace window_ingress::detection
