#include "window_ingress/simulation/texture.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace window_ingress::simulation {
namespace {

constexpr int kSize = 512;

// Smooth noise of `cells` bumps along a side, wrapping around; zero mean, standard deviation near 1. CV_32F.
cv::Mat bumps(cv::RNG& random, int cells) {
  cv::Mat coarse(cells, cells, CV_32F), wrapped, fine;
  random.fill(coarse, cv::RNG::NORMAL, 0.0, 1.4);
  const int border = std::min(2, cells);
  cv::copyMakeBorder(coarse, wrapped, border, border, border, border, cv::BORDER_WRAP);
  const int scale = kSize / cells;
  cv::resize(wrapped, fine, cv::Size(), scale, scale, cv::INTER_CUBIC);
  return fine(cv::Rect(border * scale, border * scale, kSize, kSize)).clone();
}

cv::Mat noise(cv::RNG& random, std::initializer_list<std::pair<int, double>> octaves) {
  cv::Mat sum = cv::Mat::zeros(kSize, kSize, CV_32F);
  for (const auto& [cells, amplitude] : octaves) sum += amplitude * bumps(random, cells);
  return sum;
}

// The same factor for all channels times a tint.
cv::Mat tinted(const cv::Mat& grey, const cv::Scalar& tint) {
  cv::Mat channels[3], merged, bytes;
  for (int c = 0; c < 3; ++c) channels[c] = grey * (tint[c] / 255.0);
  cv::merge(channels, 3, merged);
  merged.convertTo(bytes, CV_8U);
  return bytes;
}

// Rows of stones with joints between; each stone has a shade of its own, every other row is shifted by half.
cv::Mat courses(cv::RNG& random, int columns, int rows, double joint_px, double spread,
                const cv::Scalar& stone, const cv::Scalar& joint) {
  cv::Mat image(kSize, kSize, CV_8UC3, joint);
  const double wide = static_cast<double>(kSize) / columns, high = static_cast<double>(kSize) / rows;
  for (int row = 0; row < rows; ++row) {
    for (int column = -1; column < columns; ++column) {
      if (row % 2 == 0 && column < 0) continue;
      const bool last_half = row % 2 == 1 && column == columns - 1;
      cv::RNG own(static_cast<std::uint64_t>(row * 97 + (last_half ? -1 : column) + 1000) * 7919u +
                  random.state);
      const double shade = 1.0 + spread * own.gaussian(1.0);
      const double x = (column + (row % 2) * 0.5) * wide + 0.5 * joint_px, y = row * high + 0.5 * joint_px;
      cv::rectangle(image,
                    cv::Rect2d(x, y, wide - joint_px, high - joint_px) & cv::Rect2d(0, 0, kSize, kSize),
                    stone * shade, cv::FILLED);
    }
  }
  return image;
}

cv::Mat roughened(cv::RNG& random, const cv::Mat& image, double amplitude) {
  cv::Mat grey = noise(random, {{256, 0.6}, {64, 0.5}, {16, 0.5}}), channels[3], rough, sum;
  for (auto& channel : channels) channel = amplitude * grey;
  cv::merge(channels, 3, rough);
  cv::add(image, rough, sum, cv::noArray(), CV_8U);
  return sum;
}

cv::Mat wood(cv::RNG& random) {
  cv::Mat grain(kSize, kSize, CV_32F);
  const cv::Mat warp = bumps(random, 4), fibre = bumps(random, 128);
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const double seam = y % (kSize / 8) < 3 ? -60.0 : 0.0;
      const double ring = 12.0 * std::sin(2.0 * M_PI * y / 32.0 + 2.0 * warp.at<float>(y, x));
      grain.at<float>(y, x) = static_cast<float>(205.0 + ring + seam + 6.0 * fibre.at<float>(y, x));
    }
  return tinted(grain, {255, 235, 215});
}

// What a pane shows: a dim room, the sky's reflection from above, curtains at both sides.
cv::Mat glass() {
  cv::Mat image(kSize, kSize, CV_8UC3);
  for (int y = 0; y < kSize; ++y) {
    const double sky = std::pow(1.0 - static_cast<double>(y) / kSize, 1.5);
    for (int x = 0; x < kSize; ++x) {
      const double aside = std::abs(x - 0.5 * kSize) / (0.5 * kSize);
      const double fold = aside > 0.62 ? 90.0 + 25.0 * std::sin(x * 0.19) : 0.0;
      const double streak = std::abs(x + y - 600) < 55 ? 28.0 : 0.0;
      image.at<cv::Vec3b>(y, x) = {cv::saturate_cast<uchar>(38 + 70 * sky + fold + streak),
                                   cv::saturate_cast<uchar>(44 + 90 * sky + fold + streak),
                                   cv::saturate_cast<uchar>(52 + 115 * sky + 0.9 * fold + streak)};
    }
  }
  return image;
}

cv::Mat poster(cv::RNG& random) {
  cv::Mat image(kSize, kSize, CV_8UC3, cv::Scalar(235, 225, 200));
  cv::rectangle(image, {0, 0, kSize, 330}, cv::Scalar(90, 150, 205), cv::FILLED);
  cv::circle(image, {380, 100}, 55, cv::Scalar(250, 215, 90), cv::FILLED, cv::LINE_AA);
  for (int hill = 0; hill < 5; ++hill) {
    const cv::Point centre(random.uniform(0, kSize), 330),
        axes(random.uniform(80, 220), random.uniform(50, 170));
    const cv::Scalar green(50 + random.uniform(0, 50), 100 + random.uniform(0, 60), 60);
    cv::ellipse(image, centre, axes, 0, 180, 360, green, cv::FILLED, cv::LINE_AA);
  }
  for (int line = 0; line < 4; ++line) {
    const cv::Rect words(40, 360 + 36 * line, random.uniform(200, 430), 14);
    cv::rectangle(image, words, cv::Scalar(60, 50, 50), cv::FILLED);
  }
  return image;
}

}  // namespace

cv::Mat makeTexture(Texture texture, std::uint32_t seed) {
  cv::RNG random(seed * 1000003u + static_cast<std::uint32_t>(texture) + 1u);
  switch (texture) {
    case Texture::kPlaster:
      return tinted(222.0 + 6.0 * noise(random, {{4, 0.7}, {16, 0.5}, {64, 0.5}, {256, 0.8}}),
                    {255, 255, 255});
    case Texture::kBrick:
      return roughened(random, courses(random, 4, 12, 6.0, 0.10, {190, 96, 70}, {188, 180, 168}), 6.0);
    case Texture::kGrass:
      return tinted(175.0 + 26.0 * noise(random, {{4, 0.5}, {32, 0.6}, {128, 0.7}, {256, 0.8}}),
                    {165, 205, 110});
    case Texture::kPaving:
      return roughened(random, courses(random, 4, 4, 5.0, 0.05, {198, 194, 186}, {120, 118, 110}), 6.0);
    case Texture::kTiles:
      return roughened(random, courses(random, 8, 12, 5.0, 0.09, {178, 86, 62}, {88, 44, 36}), 6.0);
    case Texture::kHedge:
      return tinted(150.0 + 40.0 * noise(random, {{8, 0.5}, {32, 0.7}, {128, 0.7}}), {120, 175, 85});
    case Texture::kWood:
      return wood(random);
    case Texture::kGlass:
      return glass();
    case Texture::kPoster:
      return poster(random);
    case Texture::kClouds:
      return tinted(232.0 + 14.0 * noise(random, {{4, 0.6}, {8, 0.5}, {16, 0.3}, {32, 0.2}}),
                    {255, 255, 255});
    default:
      return cv::Mat(4, 4, CV_8UC3, cv::Scalar::all(255));
  }
}

double tileSize_m(Texture texture) {
  switch (texture) {
    case Texture::kPlaster:
      return 2.0;
    case Texture::kGrass:
      return 2.5;
    case Texture::kPaving:
      return 1.6;
    case Texture::kTiles:
      return 2.4;
    case Texture::kHedge:
      return 2.0;
    case Texture::kClouds:
      return 60.0;
    default:
      return 1.0;
  }
}

}  // namespace window_ingress::simulation
