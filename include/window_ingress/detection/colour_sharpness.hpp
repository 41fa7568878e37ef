#pragma once

#include <Eigen/Core>

#include "window_ingress/detection/edge_profiles.hpp"

namespace window_ingress::detection {

/// Many pictures have their colour at half of their size (JPEG and most video, cameras with a Bayer pattern):
/// there it is brightness that says where an edge is, to a pixel and better; colour lags behind by a pixel.

/// Brightness of a colour or a change of it, BGR (ITU-R BT.601).
float brightnessOf(const Eigen::Vector3f& bgr);

/// The profiles have colour, and it is softer than a pixel's blur: the squares of its second differences
/// against those of its first ones, which is 1 / (2 sigma^2) of an edge, and 3 of noise.
bool isColourSoft(const EdgeProfiles& profiles);

/// A change as far as soft colour can be trusted in it.
Eigen::Vector3f resolvedPart(const Eigen::Vector3f& change);

}  // namespace window_ingress::detection
