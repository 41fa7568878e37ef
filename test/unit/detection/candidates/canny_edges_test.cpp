#include "detection/candidates/canny_edges.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <random>

namespace window_ingress::detection::canny_edges_test {

cv::Mat noise(int rows, int cols, int type, unsigned seed) {
  cv::Mat image(rows, cols, type);
  std::mt19937 random(seed);
  for (int y = 0; y < rows; ++y)
    for (int i = 0; i < cols * image.channels(); ++i) image.ptr(y)[i] = random() % 4 ? random() % 256 : 255;
  return image;
}

/// Sobel by OpenCV; uses the first channel with the largest |dx| + |dy|.
void byOpenCv(const cv::Mat& image, cv::Mat& dx, cv::Mat& dy) {
  const int channels = image.channels();
  cv::Mat all_dx, all_dy;
  cv::Sobel(image, all_dx, CV_16S, 1, 0, 3, 1, 0, cv::BORDER_REPLICATE);
  cv::Sobel(image, all_dy, CV_16S, 0, 1, 3, 1, 0, cv::BORDER_REPLICATE);
  dx.create(image.size(), CV_16SC1), dy.create(image.size(), CV_16SC1);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) {
      const short *u = all_dx.ptr<short>(y) + x * channels, *v = all_dy.ptr<short>(y) + x * channels;
      int best = 0;
      for (int c = 1; c < channels; ++c)
        if (std::abs(u[c]) + std::abs(v[c]) > std::abs(u[best]) + std::abs(v[best])) best = c;
      dx.at<short>(y, x) = u[best], dy.at<short>(y, x) = v[best];
    }
}

TEST(EdgeMap, GradientIsThatOfTheStrongestChannelWhateverTheSize) {
  unsigned seed = 0;
  for (int type : {CV_8UC1, CV_8UC3})
    for (int rows : {1, 2, 3, 17, 60})
      for (int cols : {1, 2, 3, 7, 8, 9, 16, 23, 80}) {
        const cv::Mat image = noise(rows, cols, type, ++seed);
        const EdgeMap& map = cannyEdges(image, {});
        cv::Mat dx, dy;
        byOpenCv(image, dx, dy);
        EXPECT_EQ(cv::norm(map.dx, dx, cv::NORM_INF), 0.0) << rows << " x " << cols;
        EXPECT_EQ(cv::norm(map.dy, dy, cv::NORM_INF), 0.0) << rows << " x " << cols;
      }
}

TEST(EdgeMap, APartOfALargerImageIsReadRowByRow) {
  const cv::Mat large = noise(50, 90, CV_8UC3, 7), part = large(cv::Rect(10, 5, 33, 20));
  const cv::Mat edges = cannyEdges(part, {}).edges;
  EXPECT_EQ(cv::norm(cannyEdges(part.clone(), {}).edges, edges, cv::NORM_INF), 0.0);
}

}  // namespace window_ingress::detection::canny_edges_test
