/// Procedural surfaces, drawn from a seed. All of them tile without a seam, except the poster and the glass.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace window_ingress::simulation {

/// In the order in which they are drawn: what hides most comes first.
enum class Texture {
  kPlaster,
  kBrick,
  kPlain,
  kGlass,
  kPoster,
  kPaving,
  kGrass,
  kHedge,
  kWood,
  kTiles,
  kClouds
};

/// Colour factors, 255 for "as the surface's own colour"; CV_8UC3 in RGB order, square, sides a power of two.
cv::Mat makeTexture(Texture texture, std::uint32_t seed);

/// Side of one tile of the texture [m].
double tileSize_m(Texture texture);

}  // namespace window_ingress::simulation
