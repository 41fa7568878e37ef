#pragma once

#include <Eigen/Core>

namespace window_ingress::detection {

/// A reveal seen at a narrow angle is a strip of a pixel or two: its front edge (frame or wall to reveal) and
/// its back edge (reveal to what is behind) blur into one, and the steepest change lies somewhere between
/// them. Where the two change in different colours, that can be told from one blurred edge: the change on the
/// outer flank has a part at right angles, in colour space, to that on the inner flank, and this part has a
/// maximum of its own.
///
/// \param changes of the mean colour across the border, by offset, outwards; one pixel apart
/// \param at the largest change
/// \return distance of that maximum from the largest change [px]: how far the front edge may lie from what is
/// measured; 0 for a single edge
double partedBy(const Eigen::Vector3f* changes, int count, int at);

}  // namespace window_ingress::detection
