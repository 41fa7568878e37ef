#include "detection/candidates/canny_edges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace window_ingress::detection {
namespace {

constexpr int kEveryRow = 4;  ///< spacing of the rows from which the thresholds are estimated
constexpr uchar kWeak = 1, kStrong = 2, kEdge = 255;

// Pixels stronger than their two neighbours across the edge: kWeak, or kStrong above the upper threshold.
// Edges run across their gradient, whose direction is rounded to one of four: 13 / 32 is the tangent of 22.1
// degrees. Without branches, for the vectorizer.
void thinRow(const short* above, const short* here, const short* below, const short* dx, const short* dy,
             short low, short high, int columns, uchar* edges) {
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
    const bool peak = (strength > low) & (strength > before) & (strength >= after);
    edges[x] = static_cast<uchar>(peak ? (strength > high ? kStrong : kWeak) : 0);
  }
}

short strengthOf(short dx, short dy) {
  return static_cast<short>(static_cast<short>(std::abs(dx)) + static_cast<short>(std::abs(dy)));
}

// Of three channels, the gradient of that with the largest |dx| + |dy|, the first on a tie. Without branches,
// for the vectorizer.
void strongestInRow(const std::array<const short*, 3>& dx3, const std::array<const short*, 3>& dy3,
                    int columns, short* __restrict dx, short* __restrict dy, short* __restrict strength) {
  const auto [dx0, dx1, dx2] = dx3;
  const auto [dy0, dy1, dy2] = dy3;
  for (int x = 0; x < columns; ++x) {
    const short first = strengthOf(dx0[x], dy0[x]), second = strengthOf(dx1[x], dy1[x]),
                third = strengthOf(dx2[x], dy2[x]), most = first < second ? second : first;
    const bool by_second = second > first, by_third = third > most;
    const short front_dx = by_second ? dx1[x] : dx0[x], front_dy = by_second ? dy1[x] : dy0[x];
    dx[x] = by_third ? dx2[x] : front_dx;
    dy[x] = by_third ? dy2[x] : front_dy;
    strength[x] = by_third ? third : most;
  }
}

// Sets the gradient of the strongest channel. \return |dx| + |dy|, CV_16SC1, until the next call
const cv::Mat& strongestGradient(const cv::Mat& image, EdgeMap& map) {
  constexpr int kBorder = cv::BORDER_REPLICATE | cv::BORDER_ISOLATED;
  thread_local cv::Mat sums, strength;
  thread_local std::vector<cv::Mat> dx, dy;  // of each channel
  cv::Sobel(image, sums, CV_16S, 1, 0, 3, 1.0, 0.0, kBorder);
  cv::split(sums, dx);
  cv::Sobel(image, sums, CV_16S, 0, 1, 3, 1.0, 0.0, kBorder);
  cv::split(sums, dy);
  for (cv::Mat* result : {&map.dx, &map.dy, &strength}) result->create(image.size(), CV_16SC1);
  const auto row = [](const std::vector<cv::Mat>& channels, int y) {
    return std::array<const short*, 3>{channels.front().ptr<short>(y),
                                       channels[channels.size() / 2].ptr<short>(y),
                                       channels.back().ptr<short>(y)};
  };
  for (int y = 0; y < image.rows; ++y)
    strongestInRow(row(dx, y), row(dy, y), image.cols, map.dx.ptr<short>(y), map.dy.ptr<short>(y),
                   strength.ptr<short>(y));
  return strength;
}

// Threshold below which `high_quantile` of all pixels lie [grey levels per pixel].
double upperThreshold(const cv::Mat& strength, const CannyParams& params) {
  std::array<int, 2048> histogram{};
  int count = 0;
  for (int y = 0; y < strength.rows; y += kEveryRow) {
    const short* row = strength.ptr<short>(y);
    for (int x = 0; x < strength.cols; ++x) ++histogram[row[x]];
    count += strength.cols;
  }
  const double wanted = params.high_quantile * count;
  double below = 0.0;
  std::size_t bin = 0;
  while (bin + 1 < histogram.size() && (below += histogram[bin]) < wanted) ++bin;
  return std::clamp(bin / EdgeMap::kSobelGain, params.floor, std::max(params.floor, params.ceiling));
}

// Weak pixels stay if connected to a strong one.
void followStrong(cv::Mat& edges) {
  const auto step = static_cast<std::ptrdiff_t>(edges.step);
  const std::ptrdiff_t around[8] = {-step - 1, -step, -step + 1, -1, 1, step - 1, step, step + 1};
  thread_local std::vector<uchar*> waiting;
  for (int y = 1; y + 1 < edges.rows; ++y) {
    uchar* row = edges.ptr(y);
    for (int x = 1; x + 1 < edges.cols; ++x) {
      if (row[x] != kStrong) continue;
      row[x] = kEdge;
      waiting.push_back(row + x);
      while (!waiting.empty()) {
        uchar* at = waiting.back();
        waiting.pop_back();
        for (const std::ptrdiff_t to : around)
          if (at[to] == kWeak || at[to] == kStrong) at[to] = kEdge, waiting.push_back(at + to);
      }
    }
  }
  cv::compare(edges, kEdge, edges, cv::CMP_EQ);
}

}  // namespace

EdgeMap cannyEdges(const cv::Mat& image, const CannyParams& params, EdgeMap map) {
  const cv::Mat& strength = strongestGradient(image, map);
  const double upper = EdgeMap::kSobelGain * upperThreshold(strength, params);
  const auto low = static_cast<short>(std::floor(params.low_ratio * upper)),
             high = static_cast<short>(std::floor(upper));
  map.edges.create(strength.size(), CV_8UC1);
  map.edges.setTo(0);
  for (int y = 1; y + 1 < strength.rows; ++y)
    thinRow(strength.ptr<short>(y - 1), strength.ptr<short>(y), strength.ptr<short>(y + 1),
            map.dx.ptr<short>(y), map.dy.ptr<short>(y), low, high, strength.cols, map.edges.ptr(y));
  followStrong(map.edges);
  return map;
}

}  // namespace window_ingress::detection
