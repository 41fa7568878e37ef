#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "simulation/surfaces/texture_patterns.hpp"

namespace window_ingress::simulation {
namespace {

// Sum is `total`, no part below `least`.
std::vector<int> randomParts(cv::RNG& random, int total, int least, int most) {
  std::vector<int> parts;
  int left = total;
  while (left > most) {
    const int part = std::min(random.uniform(least, most), left - least);
    parts.push_back(part);
    left -= part;
  }
  parts.push_back(left);
  return parts;
}

// A filled rectangle that wraps around at the right border.
void wrappedRectangle(cv::Mat& image, const cv::Rect& rectangle, const cv::Scalar& colour) {
  for (const int shift : {0, -kTextureSize})
    cv::rectangle(image, cv::Rect(rectangle.x + shift, rectangle.y, rectangle.width, rectangle.height),
                  colour, cv::FILLED);
}

// Rows of the same height, each as `profile` has it: -> 0..1 from its lower to its upper border.
template <typename Profile>
cv::Mat slats(cv::RNG& random, int rows, double spread, const Profile& profile) {
  cv::Mat image(kTextureSize, kTextureSize, CV_32F);
  const int high = kTextureSize / rows;
  for (int row = 0; row < rows; ++row) {
    const double shade = 1.0 + spread * random.gaussian(1.0);
    for (int y = 0; y < high; ++y) image.row(row * high + y).setTo(shade * profile((y + 0.5) / high));
  }
  return image;
}

}  // namespace

cv::Mat courses(cv::RNG& random, int columns, int rows, double joint_px, double spread,
                const cv::Scalar& stone, const cv::Scalar& joint) {
  cv::Mat image(kTextureSize, kTextureSize, CV_8UC3, joint);
  const double wide = static_cast<double>(kTextureSize) / columns,
               high = static_cast<double>(kTextureSize) / rows;
  for (int row = 0; row < rows; ++row) {
    for (int column = -1; column < columns; ++column) {
      if (row % 2 == 0 && column < 0) continue;
      const bool last_half = row % 2 == 1 && column == columns - 1;
      cv::RNG own(static_cast<std::uint64_t>(row * 97 + (last_half ? -1 : column) + 1000) * 7919u +
                  random.state);
      const double shade = 1.0 + spread * own.gaussian(1.0);
      const double x = (column + (row % 2) * 0.5) * wide + 0.5 * joint_px, y = row * high + 0.5 * joint_px;
      cv::rectangle(
          image,
          cv::Rect2d(x, y, wide - joint_px, high - joint_px) & cv::Rect2d(0, 0, kTextureSize, kTextureSize),
          stone * shade, cv::FILLED);
    }
  }
  return image;
}

// Rows of random height, stones of random width and shade.
cv::Mat fieldStone(cv::RNG& random) {
  constexpr int kJoint_px = 6;
  cv::Mat image(kTextureSize, kTextureSize, CV_8UC3, cv::Scalar(172, 166, 156)), soft;
  int y = 0;
  for (const int high : randomParts(random, kTextureSize, 34, 72)) {
    int x = random.uniform(0, kTextureSize);
    for (const int wide : randomParts(random, kTextureSize, 48, 130)) {
      const double shade = 1.0 + 0.13 * random.gaussian(1.0), warm = 6.0 * random.gaussian(1.0);
      const cv::Scalar stone(170 * shade + warm, 162 * shade, 148 * shade - warm);
      const cv::Rect face(x % kTextureSize, y + kJoint_px / 2, wide - kJoint_px, high - kJoint_px);
      wrappedRectangle(image, face, stone * 0.86);
      wrappedRectangle(image, {face.x + 2, face.y + 3, face.width - 4, face.height - 4}, stone);
      x += wide;
    }
    y += high;
  }
  return roughened(random, image, 9.0);
}

// Lapped boards: each throws a narrow shadow on the one below it.
cv::Mat siding(cv::RNG& random) {
  const cv::Mat boards = slats(random, 8, 0.012, [](double up) {
    if (up > 0.95) return 150.0;
    return up < 0.05 ? 246.0 : 232.0 - 10.0 * up;
  });
  return tinted(boards + 3.0 * noise(random, {{8, 0.5}, {64, 0.6}, {256, 0.6}}), {255, 255, 255});
}

cv::Mat louvres(cv::RNG& random) {
  const cv::Mat leaves =
      slats(random, 8, 0.02, [](double up) { return up < 0.12 ? 95.0 : 175.0 + 65.0 * up; });
  return tinted(leaves + 2.0 * noise(random, {{64, 1.0}}), {255, 255, 255});
}

cv::Mat wood(cv::RNG& random) {
  cv::Mat grain(kTextureSize, kTextureSize, CV_32F);
  const cv::Mat warp = bumps(random, 4), fibre = bumps(random, 128);
  for (int y = 0; y < kTextureSize; ++y)
    for (int x = 0; x < kTextureSize; ++x) {
      const double seam = y % (kTextureSize / 8) < 3 ? -60.0 : 0.0;
      const double ring = 12.0 * std::sin(2.0 * M_PI * y / 32.0 + 2.0 * warp.at<float>(y, x));
      grain.at<float>(y, x) = static_cast<float>(205.0 + ring + seam + 6.0 * fibre.at<float>(y, x));
    }
  return tinted(grain, {255, 235, 215});
}

}  // namespace window_ingress::simulation
