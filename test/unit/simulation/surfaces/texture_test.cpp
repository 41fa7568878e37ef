#include "simulation/surfaces/texture.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <vector>

namespace window_ingress::simulation::texture_test {

const std::vector<Texture> kTiling{Texture::kSiding,  Texture::kStone,  Texture::kPaint,  Texture::kPlaster,
                                   Texture::kBrick,   Texture::kGrass,  Texture::kHedge,  Texture::kTiles,
                                   Texture::kLouvres, Texture::kPaving, Texture::kClouds, Texture::kWood};
const std::vector<Texture> kPictures{Texture::kGlass, Texture::kPoster, Texture::kCurtain,
                                     Texture::kPrintedWindow, Texture::kView};

double difference(const cv::Mat& a, const cv::Mat& b) {
  return cv::norm(a, b, cv::NORM_L1) / static_cast<double>(a.total() * a.channels());
}

TEST(Textures, SameSeedGivesTheSameBytesAndAnotherSeedOthers) {
  for (const auto* list : {&kTiling, &kPictures})
    for (const Texture texture : *list) {
      const cv::Mat image = makeTexture(texture, 7);
      EXPECT_EQ(cv::norm(image, makeTexture(texture, 7), cv::NORM_INF), 0.0) << static_cast<int>(texture);
      EXPECT_GT(cv::norm(image, makeTexture(texture, 8), cv::NORM_INF), 0.0) << static_cast<int>(texture);
      EXPECT_EQ(image.type(), CV_8UC3);
      EXPECT_EQ(image.rows & (image.rows - 1), 0) << "a power of two";
    }
}

// Neighbours across the seam differ no more than the most different neighbours within the texture.
TEST(Textures, TileWithoutASeam) {
  for (const Texture texture : kTiling)
    for (const std::uint32_t seed : {1u, 2u}) {
      const cv::Mat image = makeTexture(texture, seed);
      double worst_column = 0.0, worst_row = 0.0;
      for (int i = 0; i + 1 < image.cols; ++i) {
        worst_column = std::max(worst_column, difference(image.col(i), image.col(i + 1)));
        worst_row = std::max(worst_row, difference(image.row(i), image.row(i + 1)));
      }
      const int last = image.cols - 1;
      EXPECT_LE(difference(image.col(0), image.col(last)), 1.1 * worst_column + 0.5)
          << static_cast<int>(texture) << " seed " << seed;
      EXPECT_LE(difference(image.row(0), image.row(last)), 1.1 * worst_row + 0.5)
          << static_cast<int>(texture) << " seed " << seed;
    }
}

TEST(Textures, BoardsRunLevelAndPaintIsSmooth) {
  const auto deviation = [](const cv::Mat& image) {
    cv::Scalar mean, spread;
    cv::meanStdDev(image, mean, spread);
    return spread[0];
  };
  const cv::Mat boards = makeTexture(Texture::kSiding, 1);
  EXPECT_GT(deviation(boards.col(100)), 3.0 * deviation(boards.row(30)));
  EXPECT_LT(deviation(makeTexture(Texture::kPaint, 1)), 3.0);
  EXPECT_GT(deviation(makeTexture(Texture::kStone, 1)), 12.0);
}

}  // namespace window_ingress::simulation::texture_test
