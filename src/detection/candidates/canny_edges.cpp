#include "detection/candidates/canny_edges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <opencv2/core/hal/intrin.hpp>
#include <opencv2/imgproc.hpp>

namespace window_ingress::detection {
namespace {

constexpr int kLanes = cv::v_int16x8::nlanes;
constexpr int kEveryRow = 4;  ///< spacing of the rows from which the thresholds are estimated
constexpr uchar kWeak = 1, kStrong = 2, kEdge = 255;

cv::v_int16x8 strength(const cv::v_int16x8& dx, const cv::v_int16x8& dy) {
  return cv::v_reinterpret_as_s16(cv::v_abs(dx) + cv::v_abs(dy));
}

// Picks from three adjacent values of each array the pair with the largest |dx| + |dy|, the first on a tie;
// for as many pixels as there are lanes. Avoids branches, because the winning channel is unpredictable.
void strongestOfThree(const short* dx3, const short* dy3, short* dx, short* dy) {
  cv::v_int16x8 x0, x1, x2, y0, y1, y2;
  cv::v_load_deinterleave(dx3, x0, x1, x2);
  cv::v_load_deinterleave(dy3, y0, y1, y2);
  const cv::v_int16x8 first = strength(x0, y0), second = strength(x1, y1), third = strength(x2, y2);
  const cv::v_int16x8 by_second = second > first, by_third = third > cv::v_max(first, second);
  cv::v_store(dx, cv::v_select(by_third, x2, cv::v_select(by_second, x1, x0)));
  cv::v_store(dy, cv::v_select(by_third, y2, cv::v_select(by_second, y1, y0)));
}

// Applies strongestOfThree to a row; its last pixels are processed as one batch, some of them twice.
void strongestInRow(const short* dx3, const short* dy3, int pixels, short* dx, short* dy) {
  if (pixels < kLanes) {
    std::array<short, 3 * kLanes> wide_dx3{}, wide_dy3{};
    std::array<short, kLanes> wide_dx, wide_dy;
    std::copy_n(dx3, 3 * pixels, wide_dx3.data());
    std::copy_n(dy3, 3 * pixels, wide_dy3.data());
    strongestOfThree(wide_dx3.data(), wide_dy3.data(), wide_dx.data(), wide_dy.data());
    std::copy_n(wide_dx.data(), pixels, dx);
    std::copy_n(wide_dy.data(), pixels, dy);
    return;
  }
  for (int i = 0; i < pixels; i += kLanes) {
    const int at = std::min(i, pixels - kLanes);
    strongestOfThree(dx3 + 3 * at, dy3 + 3 * at, dx + at, dy + at);
  }
}

/// In units of the edge strength |dx| + |dy|.
struct Thresholds {
  short low, high;
};

// Edges run across their gradient, whose direction is rounded to one of four: 13 / 32 is the tangent of 22.1
// degrees. Without branches, for the vectorizer.
void thinRow(const short* above, const short* here, const short* below, const short* dx, const short* dy,
             Thresholds limits, int columns, uchar* edges) {
  for (int x = 1; x < columns - 1; ++x) {
    const auto across = static_cast<short>(std::abs(dx[x])), along = static_cast<short>(std::abs(dy[x]));
    const bool horizontal = static_cast<short>(32 * along) < static_cast<short>(13 * across);
    const bool vertical = static_cast<short>(32 * across) < static_cast<short>(13 * along);
    const bool falling = static_cast<short>(dx[x] ^ dy[x]) >= 0;
    const short left_up = above[x - 1], up = above[x], right_up = above[x + 1], left = here[x - 1],
                right = here[x + 1], left_down = below[x - 1], down = below[x], right_down = below[x + 1];
    const short before = horizontal ? left : vertical ? up : falling ? left_up : right_up;
    const short after = horizontal ? right : vertical ? down : falling ? right_down : left_down;
    const short strength = here[x];
    const bool peak = (strength > limits.low) & (strength > before) & (strength >= after);
    edges[x] = static_cast<uchar>(peak ? (strength > limits.high ? kStrong : kWeak) : 0);
  }
}

}  // namespace

void CannyEdges::gradient(const cv::Mat& image) {
  constexpr int kBorder = cv::BORDER_REPLICATE | cv::BORDER_ISOLATED;
  const bool is_grey = image.channels() == 1;
  cv::Mat &all_dx = is_grey ? map_.dx : all_dx_, &all_dy = is_grey ? map_.dy : all_dy_;
  cv::Sobel(image, all_dx, CV_16S, 1, 0, 3, 1.0, 0.0, kBorder);
  cv::Sobel(image, all_dy, CV_16S, 0, 1, 3, 1.0, 0.0, kBorder);
  if (is_grey) return;
  map_.dx.create(image.size(), CV_16SC1);
  map_.dy.create(image.size(), CV_16SC1);
  for (int y = 0; y < image.rows; ++y)
    strongestInRow(all_dx.ptr<short>(y), all_dy.ptr<short>(y), image.cols, map_.dx.ptr<short>(y),
                   map_.dy.ptr<short>(y));
}

// |dx| + |dy| of every pixel.
void CannyEdges::measureStrength() {
  strength_.create(map_.dx.size(), CV_16SC1);
  for (int y = 0; y < map_.dx.rows; ++y) {
    const short *dx = map_.dx.ptr<short>(y), *dy = map_.dy.ptr<short>(y);
    short* strength = strength_.ptr<short>(y);
    for (int x = 0; x < map_.dx.cols; ++x)
      strength[x] = static_cast<short>(std::abs(dx[x]) + std::abs(dy[x]));
  }
}

// Threshold below which `high_quantile` of all pixels lie [grey levels per pixel].
double CannyEdges::upperThreshold() const {
  std::array<int, 2048> histogram{};
  int count = 0;
  for (int y = 0; y < strength_.rows; y += kEveryRow) {
    const short* strength = strength_.ptr<short>(y);
    for (int x = 0; x < strength_.cols; ++x) ++histogram[strength[x]];
    count += strength_.cols;
  }
  const double wanted = params_.high_quantile * count;
  double below = 0.0;
  std::size_t bin = 0;
  while (bin + 1 < histogram.size() && (below += histogram[bin]) < wanted) ++bin;
  return std::clamp(bin / EdgeMap::kSobelGain, params_.floor, std::max(params_.floor, params_.ceiling));
}

// Pixels stronger than their two neighbours across the edge: kWeak, or kStrong above the upper threshold.
// The border of the image holds none.
void CannyEdges::thin() {
  map_.edges.create(strength_.size(), CV_8UC1);
  map_.edges.setTo(0);
  const auto in_sums = [](double slope) {
    return static_cast<short>(std::floor(slope * EdgeMap::kSobelGain));
  };
  const double high = upperThreshold(), low = params_.low_ratio * high;
  const Thresholds limits{in_sums(low), in_sums(high)};
  for (int y = 1; y + 1 < strength_.rows; ++y)
    thinRow(strength_.ptr<short>(y - 1), strength_.ptr<short>(y), strength_.ptr<short>(y + 1),
            map_.dx.ptr<short>(y), map_.dy.ptr<short>(y), limits, strength_.cols, map_.edges.ptr(y));
}

// Weak pixels stay if connected to a strong one.
void CannyEdges::followStrong() {
  cv::Mat& edges = map_.edges;
  const auto step = static_cast<std::ptrdiff_t>(edges.step);
  const std::ptrdiff_t around[8] = {-step - 1, -step, -step + 1, -1, 1, step - 1, step, step + 1};
  waiting_.clear();
  for (int y = 1; y + 1 < edges.rows; ++y) {
    uchar* row = edges.ptr(y);
    for (int x = 1; x + 1 < edges.cols; ++x) {
      if (row[x] != kStrong) continue;
      row[x] = kEdge;
      waiting_.push_back(row + x);
      while (!waiting_.empty()) {
        uchar* at = waiting_.back();
        waiting_.pop_back();
        for (const std::ptrdiff_t to : around)
          if (at[to] == kWeak || at[to] == kStrong) at[to] = kEdge, waiting_.push_back(at + to);
      }
    }
  }
  cv::compare(edges, kEdge, edges, cv::CMP_EQ);
}

const EdgeMap& CannyEdges::run(const cv::Mat& image) {
  gradient(image);
  measureStrength();
  thin();
  followStrong();
  return map_;
}

}  // namespace window_ingress::detection
