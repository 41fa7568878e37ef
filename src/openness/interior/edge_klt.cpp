#include "openness/interior/edge_klt.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>

namespace window_ingress::openness {
namespace {

constexpr int kAlong = 4, kAcross = 4;  // half of the patch [px]
constexpr int kValues = (2 * kAlong + 1) * (2 * kAcross + 1);
using Patch = std::array<float, kValues>;
constexpr int kSteps = 8;
constexpr double kArrived_px = 0.02, kFurthest_px = 4.0;  // last step; distance from the guess
constexpr double kLikeness = 0.8;                         // correlation of the two patches

float at(const cv::Mat& grey, float x, float y) {
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
  const unsigned char* row = grey.ptr(y0) + x0;
  const unsigned char* next = grey.ptr(y0 + 1) + x0;
  const float top = static_cast<float>(row[0]) + fx * static_cast<float>(row[1] - row[0]);
  const float bottom = static_cast<float>(next[0]) + fx * static_cast<float>(next[1] - next[0]);
  return top + fy * (bottom - top);
}

// Grey values around a place, in rows across the edge, without their mean.
bool cut(const cv::Mat& grey, const cv::Point2f& place, const cv::Point2f& normal, Patch& patch) {
  constexpr float kReach = kAlong + kAcross + 1;
  if (!(place.x > kReach && place.y > kReach && place.x < static_cast<float>(grey.cols) - 1 - kReach &&
        place.y < static_cast<float>(grey.rows) - 1 - kReach))
    return false;
  std::size_t i = 0;
  float sum = 0.0f;
  for (int along = -kAlong; along <= kAlong; ++along)
    for (int across = -kAcross; across <= kAcross; ++across, ++i) {
      const auto a = static_cast<float>(along), c = static_cast<float>(across);
      patch[i] = at(grey, place.x + c * normal.x - a * normal.y, place.y + c * normal.y + a * normal.x);
      sum += patch[i];
    }
  for (float& value : patch) value -= sum / kValues;
  return true;
}

// Slopes across the edge; the outermost columns have none.
Patch slopesOf(const Patch& patch) {
  Patch slopes{};
  for (std::size_t i = 1; i + 1 < patch.size(); ++i) {
    const std::size_t column = i % (2 * kAcross + 1);
    if (column > 0 && column < 2 * kAcross) slopes[i] = 0.5f * (patch[i + 1] - patch[i - 1]);
  }
  return slopes;
}

double dot(const Patch& a, const Patch& b) { return std::inner_product(a.begin(), a.end(), b.begin(), 0.0); }

}  // namespace

void SlopeImage::take(const cv::Mat& grey) {
  cv::Sobel(grey, dx_, CV_32F, 1, 0, 3, 1.0 / 8.0);
  cv::Sobel(grey, dy_, CV_32F, 0, 1, 3, 1.0 / 8.0);
  cv::magnitude(dx_, dy_, slope_);
}

std::vector<EdgePoint> SlopeImage::steepest(const cv::Rect& inner, int spacing_px, double least_slope,
                                            std::size_t most) const {
  std::vector<EdgePoint> edges;
  for (int top = inner.y; top < inner.y + inner.height; top += spacing_px)
    for (int left = inner.x; left < inner.x + inner.width; left += spacing_px) {
      const cv::Rect block = cv::Rect(left, top, spacing_px, spacing_px) & inner;
      double slope = 0.0;
      cv::Point place;
      cv::minMaxLoc(slope_(block), nullptr, &slope, nullptr, &place);
      if (slope < least_slope) continue;
      place += block.tl();
      const auto steep = static_cast<float>(slope);
      edges.push_back({place, {dx_.at<float>(place) / steep, dy_.at<float>(place) / steep}, steep});
    }
  std::sort(edges.begin(), edges.end(), [](const auto& a, const auto& b) { return a.slope > b.slope; });
  if (edges.size() > most) edges.resize(most);
  return edges;
}

std::optional<cv::Point2f> followAcross(const cv::Mat& key, const cv::Mat& now, const EdgePoint& edge,
                                        const cv::Point2f& guess) {
  Patch before, after;
  if (!cut(key, edge.place, edge.normal, before)) return std::nullopt;
  const Patch slopes = slopesOf(before);
  const double squares = dot(slopes, slopes);
  if (!(squares > 0.0)) return std::nullopt;
  cv::Point2f place = guess;
  for (int i = 0; i < kSteps; ++i) {
    if (!cut(now, place, edge.normal, after)) return std::nullopt;
    const double step = (dot(slopes, before) - dot(slopes, after)) / squares;
    place += static_cast<float>(std::clamp(step, -2.0, 2.0)) * edge.normal;
    if (cv::norm(place - guess) > kFurthest_px) return std::nullopt;
    if (std::abs(step) < kArrived_px) break;
  }
  if (!cut(now, place, edge.normal, after)) return std::nullopt;
  const double likeness = dot(before, after) / std::sqrt(dot(before, before) * dot(after, after) + 1e-9);
  return likeness > kLikeness ? std::optional(place) : std::nullopt;
}

}  // namespace window_ingress::openness
