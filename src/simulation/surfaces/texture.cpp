#include "simulation/surfaces/texture.hpp"

#include <algorithm>
#include <map>
#include <opencv2/imgproc.hpp>

#include "simulation/surfaces/texture_patterns.hpp"

namespace window_ingress::simulation {

cv::Mat bumps(cv::RNG& random, int cells) {
  cv::Mat coarse(cells, cells, CV_32F), wrapped, fine;
  random.fill(coarse, cv::RNG::NORMAL, 0.0, 1.4);
  const int border = std::min(2, cells);
  cv::copyMakeBorder(coarse, wrapped, border, border, border, border, cv::BORDER_WRAP);
  const int scale = kTextureSize / cells;
  cv::resize(wrapped, fine, cv::Size(), scale, scale, cv::INTER_CUBIC);
  return fine(cv::Rect(border * scale, border * scale, kTextureSize, kTextureSize)).clone();
}

cv::Mat noise(cv::RNG& random, std::initializer_list<std::pair<int, double>> octaves) {
  cv::Mat sum = cv::Mat::zeros(kTextureSize, kTextureSize, CV_32F);
  for (const auto& [cells, amplitude] : octaves) sum += amplitude * bumps(random, cells);
  return sum;
}

cv::Mat tinted(const cv::Mat& grey, const cv::Scalar& tint) {
  cv::Mat channels[3], merged, bytes;
  for (int c = 0; c < 3; ++c) channels[c] = grey * (tint[c] / 255.0);
  cv::merge(channels, 3, merged);
  merged.convertTo(bytes, CV_8U);
  return bytes;
}

cv::Mat roughened(cv::RNG& random, const cv::Mat& image, double amplitude) {
  cv::Mat grey = noise(random, {{256, 0.6}, {64, 0.5}, {16, 0.5}}), channels[3], rough, sum;
  for (auto& channel : channels) channel = amplitude * grey;
  cv::merge(channels, 3, rough);
  cv::add(image, rough, sum, cv::noArray(), CV_8U);
  return sum;
}

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
    case Texture::kPaint:
      return tinted(240.0 + 1.5 * noise(random, {{4, 1.0}, {128, 0.6}}), {255, 255, 255});
    case Texture::kSiding:
      return siding(random);
    case Texture::kStone:
      return fieldStone(random);
    case Texture::kLouvres:
      return louvres(random);
    case Texture::kWood:
      return wood(random);
    case Texture::kGlass:
      return glass(random);
    case Texture::kCurtain:
      return curtain(random);
    case Texture::kPoster:
      return poster(random);
    case Texture::kPrintedWindow:
      return printedWindow(random, makeTexture(Texture::kPoster, seed));
    case Texture::kView:
      return gardenView(random);
    case Texture::kChessboard:
      return chessboard();
    case Texture::kClouds:
      return tinted(232.0 + 14.0 * noise(random, {{4, 0.6}, {8, 0.5}, {16, 0.3}, {32, 0.2}}),
                    {255, 255, 255});
    default:
      return cv::Mat(4, 4, CV_8UC3, cv::Scalar::all(255));
  }
}

double tileSize_m(Texture texture) {
  static const std::map<Texture, double> sizes_m{
      {Texture::kPlaster, 2.0}, {Texture::kPaint, 2.0},  {Texture::kStone, 2.0},  {Texture::kSiding, 1.2},
      {Texture::kLouvres, 0.4}, {Texture::kGrass, 2.5},  {Texture::kPaving, 1.6}, {Texture::kTiles, 2.4},
      {Texture::kHedge, 2.0},   {Texture::kClouds, 60.0}};
  const auto size = sizes_m.find(texture);
  return size == sizes_m.end() ? 1.0 : size->second;
}

}  // namespace window_ingress::simulation
