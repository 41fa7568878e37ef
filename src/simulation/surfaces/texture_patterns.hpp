/// Building blocks of the patterns of `makeTexture`. All images are of kTextureSize.
#pragma once

#include <initializer_list>
#include <opencv2/core.hpp>
#include <utility>

namespace window_ingress::simulation {

constexpr int kTextureSize = 512;

/// Smooth noise with `cells` bumps per side, wrapping around; zero mean, standard deviation near 1. CV_32F.
cv::Mat bumps(cv::RNG& random, int cells);
/// Sum of several `bumps`: {cells, amplitude} each.
cv::Mat noise(cv::RNG& random, std::initializer_list<std::pair<int, double>> octaves);
/// A grey factor for all channels times a tint.
cv::Mat tinted(const cv::Mat& grey, const cv::Scalar& tint);
cv::Mat roughened(cv::RNG& random, const cv::Mat& image, double amplitude);

// --- surfaces that tile
/// Rows of stones with joints; each stone has its own shade, and every other row is shifted by half.
cv::Mat courses(cv::RNG& random, int columns, int rows, double joint_px, double spread,
                const cv::Scalar& stone, const cv::Scalar& joint);
cv::Mat fieldStone(cv::RNG& random);
cv::Mat siding(cv::RNG& random);
cv::Mat louvres(cv::RNG& random);
cv::Mat wood(cv::RNG& random);

// --- pictures
cv::Mat glass(cv::RNG& random);
cv::Mat curtain(cv::RNG& random);
cv::Mat poster(cv::RNG& random);
cv::Mat printedWindow(cv::RNG& random, const cv::Mat& picture_on_wall);
cv::Mat gardenView(cv::RNG& random);
/// 9 x 7 squares, 8 x 6 inner corners, and a margin as wide as a square.
cv::Mat chessboard();

}  // namespace window_ingress::simulation
