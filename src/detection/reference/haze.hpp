#pragma once

#include <Eigen/Core>
#include <optional>

#include "detection/reference/ring_histogram.hpp"

namespace window_ingress::detection {

/// Haze, or glare on the lens, between camera and window: of each colour a part is left, and the same light
/// is added to all (Koschmieder). Differences of colours keep their direction and shrink alike, so that they
/// tell what they are of even where next to nothing is left of the colours themselves.
struct Haze {
  double left = 1.0;                                ///< of each colour, 0 to 1
  Eigen::Vector3f added = Eigen::Vector3f::Zero();  ///< BGR

  /// The colour without it.
  Eigen::Vector3f off(const Eigen::Vector3f& seen) const { return (seen - added) / static_cast<float>(left); }
};

/// The haze that would make of the reference's wall what is seen of it, and of its difference to the frame
/// the difference seen.
/// \param left part of the difference that is left
/// \param darkest least channel seen about there: haze adds no more than that [grey levels]
/// \return nothing for what no haze does: one without a part left, of a strong colour, or brighter than
///         the darkest place
std::optional<Haze> hazeThatLeaves(double left, const Eigen::Vector3f& reference_wall,
                                   const Eigen::Vector3f& seen_wall, double darkest);

/// Bhattacharyya distance of two normal distributions of what haze has left of the difference between frame
/// and surround, by its direction. \return nothing where there is no haze, or it has left less than noise
std::optional<double> distanceThroughHaze(const RingMeans& reference, const RingMeans& seen);

/// True if haze alone may be what makes the one of the other.
bool isSameThroughHaze(const RingMeans& reference, const RingMeans& seen);

}  // namespace window_ingress::detection
