#include "detection/candidates/nested_quads.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {
namespace {

using Eigen::Vector2d;
using geometry::Quadrilateral;

constexpr double kContinued = 22.0;  ///< the rings of one frame differ less in colour [grey levels]
constexpr double kMaxRing = 0.25;    ///< width of a frame [mean sides of its outer border]
constexpr double kRingRatio = 3.0;   ///< widest over narrowest side of a frame
constexpr double kUniform = 22.0;    ///< colours of a frame's four sides differ less than this [grey levels]
constexpr double kMaxPanes = 40.0;   ///< area of a window over the area of its smallest pane
constexpr double kLoopTolerancePx = 0.6;  ///< uncertainty of a loop's position on the search level [px]
constexpr int kRingSamples = 24;

cv::Vec3d colourAt(const cv::Mat& image, const Vector2d& p) {
  const int x = std::clamp(static_cast<int>(std::lround(p.x())), 0, image.cols - 1);
  const int y = std::clamp(static_cast<int>(std::lround(p.y())), 0, image.rows - 1);
  if (image.channels() == 1) return cv::Vec3d::all(image.at<uchar>(y, x));
  return image.at<cv::Vec3b>(y, x);
}

// Distance of a point from side i of a quadrilateral in canonical order, positive towards its inside.
double depth(const Quadrilateral& quad, int i, const Vector2d& point) {
  return geometry::cross((quad[(i + 1) % 4] - quad[i]).normalized(), point - quad[i]);
}

bool isWithin(const Quadrilateral& outer, const Quadrilateral& inner, double tolerance_px) {
  for (int i = 0; i < 4; ++i)
    for (const Vector2d& p : inner)
      if (depth(outer, i, p) < -tolerance_px) return false;
  return true;
}

// True if `inner` lies within `outer` with a border of about the same width all round.
bool isConcentric(const Quadrilateral& outer, const Quadrilateral& inner, double tolerance_px) {
  if (!isWithin(outer, inner, 0.0)) return false;
  double least = 1e9, most = 0.0;
  for (int i = 0; i < 4; ++i) {
    const double width = depth(outer, i, 0.5 * (inner[i] + inner[(i + 1) % 4]));
    least = std::min(least, width);
    most = std::max(most, width);
  }
  return most <= kMaxRing * geometry::meanSide(outer) + tolerance_px && most > tolerance_px &&
         most + tolerance_px <= kRingRatio * (least + tolerance_px);
}

/// Colour of the ring between two loops, in the middle of its sides.
struct RingBetween {
  cv::Vec3d colour;
  double spread = 0.0;  ///< larger of the spread between sides and along one side [grey levels]
};

RingBetween ringBetween(const cv::Mat& image, const Quadrilateral& outer, const Quadrilateral& inner) {
  RingBetween ring;
  std::array<cv::Vec3d, 4> sides;
  for (int i = 0; i < 4; ++i) {
    const Vector2d a = 0.5 * (outer[i] + inner[i]), b = 0.5 * (outer[(i + 1) % 4] + inner[(i + 1) % 4]);
    std::array<cv::Vec3d, kRingSamples> values;
    for (int k = 0; k < kRingSamples; ++k) {
      values[k] = colourAt(image, a + (b - a) * (0.1 + 0.8 * (k + 0.5) / kRingSamples));
      sides[i] += values[k] * (1.0 / kRingSamples);
    }
    double squares = 0.0;
    for (const cv::Vec3d& value : values) squares += (value - sides[i]).dot(value - sides[i]);
    ring.spread = std::max(ring.spread, std::sqrt(squares / kRingSamples));
    ring.colour += 0.25 * sides[i];
  }
  for (const cv::Vec3d& side : sides) ring.spread = std::max(ring.spread, cv::norm(side - ring.colour));
  return ring;
}

}  // namespace

void judgeNestedQuads(const cv::Mat& image, int factor, std::vector<ScoredCandidate>& candidates) {
  const double tolerance_px = kLoopTolerancePx * factor;
  std::vector<int> order(candidates.size()), inner_border(candidates.size(), -1);
  std::vector<double> areas;
  for (const ScoredCandidate& candidate : candidates)
    areas.push_back(std::abs(geometry::signedArea(candidate.quad)));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return areas[a] > areas[b]; });

  for (std::size_t a = 0; a < order.size(); ++a) {
    const int outer = order[a];
    if (candidates[outer].verdict != RejectReason::kNone) continue;
    int front = outer;
    cv::Vec3d paint;
    for (std::size_t b = a + 1; b < order.size(); ++b) {
      const int inner = order[b];
      if (candidates[inner].verdict != RejectReason::kNone) continue;
      const Quadrilateral &front_quad = candidates[front].quad, &inner_quad = candidates[inner].quad;
      if (!isWithin(front_quad, inner_quad, tolerance_px)) continue;
      if (isConcentric(front_quad, inner_quad, tolerance_px)) {
        const RingBetween ring = ringBetween(image, front_quad, inner_quad);
        if (front == outer) paint = ring.colour;
        if (ring.spread < kUniform && cv::norm(ring.colour - paint) < kContinued) {
          candidates[front].verdict = RejectReason::kOuterBorder;
          inner_border[front] = inner;
          front = inner;
          continue;
        }
      }
      if (areas[front] <= kMaxPanes * areas[inner] && candidates[front].rank() >= candidates[inner].rank())
        candidates[inner].verdict = RejectReason::kPane;
    }
  }
  // All borders belong to one frame, so each gets at least the score of the next outer one, from outside
  // inwards.
  for (const int outer : order)
    if (inner_border[outer] >= 0) {
      ScoredCandidate& inner = candidates[inner_border[outer]];
      inner.score = std::max(inner.score, candidates[outer].score);
    }
}

}  // namespace window_ingress::detection
