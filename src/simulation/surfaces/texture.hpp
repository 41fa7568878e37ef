/// Procedural surfaces from a seed. All tile without a seam, except the images: glass, curtain, poster,
/// printed window, chessboard.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace window_ingress::simulation {

/// In drawing order: surfaces that hide most come first. The numbers feed the patterns' seeds.
enum class Texture {
  kSiding = -3,
  kStone = -2,
  kPaint = -1,
  kPlaster = 0,
  kBrick = 1,
  kPlain = 2,
  kGlass = 3,
  kPoster = 4,
  kPaving = 5,
  kGrass = 6,
  kHedge = 7,
  kWood = 8,
  kTiles = 9,
  kClouds = 10,
  kCurtain = 11,
  kLouvres = 12,
  kPrintedWindow = 13,
  kView = 14,
  kChessboard = 15
};

/// Colour factors, 255 for the surface's own colour; CV_8UC3 in RGB order, square, sides a power of two.
cv::Mat makeTexture(Texture texture, std::uint32_t seed);

/// Side of one tile of the texture [m].
double tileSize_m(Texture texture);

}  // namespace window_ingress::simulation
