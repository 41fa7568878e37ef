#include "window_ingress/detection/edge_map.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <opencv2/imgproc.hpp>

namespace window_ingress::detection {
namespace {

// Keeps, of three neighbouring values in each array, the pair with the largest |dx| + |dy|.
void strongestOfThree(const short* dx3, const short* dy3, int pixels, short* dx, short* dy) {
  for (int i = 0; i < pixels; ++i, dx3 += 3, dy3 += 3) {
    const int first = std::abs(dx3[0]) + std::abs(dy3[0]), second = std::abs(dx3[1]) + std::abs(dy3[1]),
              third = std::abs(dx3[2]) + std::abs(dy3[2]);
    // Without branches: which channel wins is as good as random.
    const int better = static_cast<int>(second > first);
    const int best = third > std::max(first, second) ? 2 : better;
    dx[i] = dx3[best];
    dy[i] = dy3[best];
  }
}

}  // namespace

void EdgeDetector::gradient(const cv::Mat& image) {
  if (image.channels() == 1) {
    cv::Sobel(image, map_.dx, CV_16S, 1, 0, 3, 1, 0, cv::BORDER_REPLICATE);
    cv::Sobel(image, map_.dy, CV_16S, 0, 1, 3, 1, 0, cv::BORDER_REPLICATE);
    return;
  }
  cv::Sobel(image, all_dx_, CV_16S, 1, 0, 3, 1, 0, cv::BORDER_REPLICATE);
  cv::Sobel(image, all_dy_, CV_16S, 0, 1, 3, 1, 0, cv::BORDER_REPLICATE);
  map_.dx.create(image.size(), CV_16SC1);
  map_.dy.create(image.size(), CV_16SC1);
  for (int y = 0; y < image.rows; ++y)
    strongestOfThree(all_dx_.ptr<short>(y), all_dy_.ptr<short>(y), image.cols, map_.dx.ptr<short>(y),
                     map_.dy.ptr<short>(y));
}

void EdgeDetector::chooseThresholds() {
  map_.low = params_.low;
  map_.high = std::max(params_.low, params_.high);
  if (!params_.automatic) return;
  std::array<int, 2048> histogram{};
  for (int y = 0; y < map_.dx.rows; ++y) {
    const short* dx = map_.dx.ptr<short>(y);
    const short* dy = map_.dy.ptr<short>(y);
    for (int x = 0; x < map_.dx.cols; ++x)
      ++histogram[std::min<int>(std::abs(dx[x]) + std::abs(dy[x]), histogram.size() - 1)];
  }
  const double wanted = params_.high_quantile * map_.dx.rows * map_.dx.cols;
  double below = 0.0;
  std::size_t bin = 0;
  while (bin + 1 < histogram.size() && (below += histogram[bin]) < wanted) ++bin;
  map_.high = std::clamp(bin / EdgeMap::kSobelGain, params_.floor, std::max(params_.floor, params_.ceiling));
  map_.low = params_.low_ratio * map_.high;
}

const EdgeMap& EdgeDetector::run(const cv::Mat& image) {
  gradient(image);
  chooseThresholds();
  cv::Canny(map_.dx, map_.dy, map_.edges, map_.low * EdgeMap::kSobelGain, map_.high * EdgeMap::kSobelGain,
            false);
  return map_;
}

}  // namespace window_ingress::detection
