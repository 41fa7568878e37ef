#include "window_ingress/detection/edge_map.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <opencv2/core/hal/intrin.hpp>
#include <opencv2/imgproc.hpp>

namespace window_ingress::detection {
namespace {

constexpr int kRowGap = 32;  ///< between rows that are read and written at once, for the vectorizer
constexpr int kLanes = cv::v_int16x8::nlanes;

cv::v_int16x8 strength(const cv::v_int16x8& dx, const cv::v_int16x8& dy) {
  return cv::v_reinterpret_as_s16(cv::v_abs(dx) + cv::v_abs(dy));
}

// Of three neighbouring values in each array, the pair with the largest |dx| + |dy|, the first of equals; for
// as many pixels as there are lanes. Without branches: which channel wins is as good as random.
void strongestOfThree(const short* dx3, const short* dy3, short* dx, short* dy) {
  cv::v_int16x8 x0, x1, x2, y0, y1, y2;
  cv::v_load_deinterleave(dx3, x0, x1, x2);
  cv::v_load_deinterleave(dy3, y0, y1, y2);
  const cv::v_int16x8 first = strength(x0, y0), second = strength(x1, y1), third = strength(x2, y2);
  const cv::v_int16x8 by_second = second > first, by_third = third > cv::v_max(first, second);
  cv::v_store(dx, cv::v_select(by_third, x2, cv::v_select(by_second, x1, x0)));
  cv::v_store(dy, cv::v_select(by_third, y2, cv::v_select(by_second, y1, y0)));
}

// The same for a row; its last pixels are done together, some of them twice. The arrays of three are readable
// for as many pixels as there are lanes.
void strongestInRow(const short* dx3, const short* dy3, int pixels, short* dx, short* dy) {
  if (pixels < kLanes) {
    std::array<short, kLanes> wide_dx, wide_dy;
    strongestOfThree(dx3, dy3, wide_dx.data(), wide_dy.data());
    std::copy_n(wide_dx.data(), pixels, dx);
    std::copy_n(wide_dy.data(), pixels, dy);
    return;
  }
  for (int i = 0; i < pixels; i += kLanes) {
    const int at = std::min(i, pixels - kLanes);
    strongestOfThree(dx3 + 3 * at, dy3 + 3 * at, dx + at, dy + at);
  }
}

// What the two Sobel kernels ask of a column of three pixels, for all columns of a row. `mean` and `change`
// have a pixel of margin before the first and after the last.
void sumColumns(const uchar* above, const uchar* here, const uchar* below, int values, short* mean,
                short* change) {
  for (int i = 0; i < values; ++i) {
    mean[i] = static_cast<short>(above[i] + 2 * here[i] + below[i]);
    change[i] = static_cast<short>(below[i] - above[i]);
  }
}

void repeatEnds(short* row, int values, int channels) {
  std::copy(row, row + channels, row - channels);
  std::copy(row + values - channels, row + values, row + values);
}

void sumRows(const short* mean, const short* change, int values, int channels, short* dx, short* dy) {
  for (int i = 0; i < values; ++i) {
    dx[i] = static_cast<short>(mean[i + channels] - mean[i - channels]);
    dy[i] = static_cast<short>(change[i - channels] + 2 * change[i] + change[i + channels]);
  }
}

}  // namespace

// Sobel in both directions, border repeated, row by row: the rows in between stay in the cache.
void EdgeDetector::gradient(const cv::Mat& image) {
  const int channels = image.channels(), values = image.cols * channels;
  map_.dx.create(image.size(), CV_16SC1);
  map_.dy.create(image.size(), CV_16SC1);
  rows_.create(4, values + 2 * channels + kRowGap, CV_16SC1);
  short *mean = rows_.ptr<short>(0) + channels, *change = rows_.ptr<short>(1) + channels;
  short *dx3 = rows_.ptr<short>(2), *dy3 = rows_.ptr<short>(3);
  for (int y = 0; y < image.rows; ++y) {
    short *dx = map_.dx.ptr<short>(y), *dy = map_.dy.ptr<short>(y);
    sumColumns(image.ptr(std::max(0, y - 1)), image.ptr(y), image.ptr(std::min(image.rows - 1, y + 1)),
               values, mean, change);
    repeatEnds(mean, values, channels);
    repeatEnds(change, values, channels);
    sumRows(mean, change, values, channels, channels == 1 ? dx : dx3, channels == 1 ? dy : dy3);
    if (channels == 3) strongestInRow(dx3, dy3, image.cols, dx, dy);
  }
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
