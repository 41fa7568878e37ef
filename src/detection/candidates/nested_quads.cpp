#include "detection/candidates/nested_quads.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "detection/quads.hpp"

namespace window_ingress::detection {
namespace {

using Eigen::Vector2d;
using geometry::Quadrilateral;

constexpr double kContinued =
    22.0;  ///< a loop further in belongs to the frame if its ring differs less [grey levels]
constexpr double kMaxRing = 0.25;   ///< width of a frame, in mean sides of its outer border
constexpr double kRingRatio = 3.0;  ///< widest over narrowest side of a frame
constexpr double kUniform = 22.0;   ///< colours of a frame's four sides differ less than this [grey levels]
constexpr double kMaxPanes = 40.0;  ///< area of a window over the area of its smallest pane
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
  const Vector2d along = (quad[(i + 1) % 4] - quad[i]).normalized(), d = point - quad[i];
  return along.x() * d.y() - along.y() * d.x();
}

bool isWithin(const Quadrilateral& outer, const Quadrilateral& inner, double tolerance_px) {
  for (int i = 0; i < 4; ++i)
    for (const Vector2d& p : inner)
      if (depth(outer, i, p) < -tolerance_px) return false;
  return true;
}

// Colour in the middle of one side of the ring: mean, and its spread along the side.
double sideColour(const cv::Mat& image, const Quadrilateral& outer, const Quadrilateral& inner, int i,
                  cv::Vec3d& mean) {
  std::array<cv::Vec3d, kRingSamples> values;
  mean = cv::Vec3d();
  const Vector2d a = 0.5 * (outer[i] + inner[i]), b = 0.5 * (outer[(i + 1) % 4] + inner[(i + 1) % 4]);
  for (int k = 0; k < kRingSamples; ++k) {
    values[k] = colourAt(image, a + (b - a) * (0.1 + 0.8 * (k + 0.5) / kRingSamples));
    mean += values[k] * (1.0 / kRingSamples);
  }
  double squares = 0.0;
  for (const cv::Vec3d& value : values) squares += (value - mean).dot(value - mean);
  return std::sqrt(squares / kRingSamples);
}

cv::Vec3d ringColour(const cv::Mat& image, const Quadrilateral& outer, const Quadrilateral& inner) {
  cv::Vec3d mean, side;
  for (int i = 0; i < 4; ++i) {
    sideColour(image, outer, inner, i, side);
    mean += 0.25 * side;
  }
  return mean;
}

}  // namespace

double ringSpread(const cv::Mat& image, const Quadrilateral& outer, const Quadrilateral& inner) {
  double spread = 0.0;
  cv::Vec3d mean;
  std::array<cv::Vec3d, 4> sides;
  for (int i = 0; i < 4; ++i) {
    spread = std::max(spread, sideColour(image, outer, inner, i, sides[i]));
    mean += 0.25 * sides[i];
  }
  for (const cv::Vec3d& side : sides) spread = std::max(spread, cv::norm(side - mean));
  return spread;
}

bool isConcentric(const Quadrilateral& outer, const Quadrilateral& inner, double tolerance_px) {
  if (!isWithin(outer, inner, 0.0)) return false;
  double least = 1e9, most = 0.0;
  for (int i = 0; i < 4; ++i) {
    const double width = depth(outer, i, 0.5 * (inner[i] + inner[(i + 1) % 4]));
    least = std::min(least, width);
    most = std::max(most, width);
  }
  return most <= kMaxRing * meanSide(outer) + tolerance_px && most > tolerance_px &&
         most + tolerance_px <= kRingRatio * (least + tolerance_px);
}

std::vector<NestedVerdict> nestedVerdicts(const cv::Mat& image, const std::vector<Quadrilateral>& quads,
                                          const std::vector<double>& scores, double tolerance_px) {
  const int count = static_cast<int>(quads.size());
  std::vector<NestedVerdict> verdicts(count);
  std::vector<int> order(count);
  std::vector<double> areas(count);
  for (int i = 0; i < count; ++i) areas[i] = std::abs(geometry::signedArea(quads[i]));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return areas[a] > areas[b]; });

  for (std::size_t a = 0; a < order.size(); ++a) {
    const int outer = order[a];
    if (verdicts[outer].reject != RejectReason::kNone) continue;
    int front = outer;
    cv::Vec3d paint;
    for (std::size_t b = a + 1; b < order.size(); ++b) {
      const int inner = order[b];
      if (verdicts[inner].reject != RejectReason::kNone) continue;
      if (!isWithin(quads[front], quads[inner], tolerance_px)) continue;
      if (isConcentric(quads[front], quads[inner], tolerance_px) &&
          ringSpread(image, quads[front], quads[inner]) < kUniform) {
        const cv::Vec3d colour = ringColour(image, quads[front], quads[inner]);
        if (front == outer) paint = colour;
        if (cv::norm(colour - paint) < kContinued) {
          verdicts[front] = {RejectReason::kOuterBorder, inner};
          front = inner;
          continue;
        }
      }
      if (areas[front] <= kMaxPanes * areas[inner] && scores[front] >= scores[inner])
        verdicts[inner] = {RejectReason::kPane, front};
    }
  }
  return verdicts;
}

void judgeNestedQuads(const cv::Mat& image, int factor, std::vector<ScoredCandidate>& rivals) {
  const double tolerance_px = kLoopTolerancePx * factor;
  std::vector<geometry::Quadrilateral> quads;
  std::vector<double> ranks;
  for (const ScoredCandidate& rival : rivals) quads.push_back(rival.quad), ranks.push_back(rival.rank());
  const auto verdicts = nestedVerdicts(image, quads, ranks, tolerance_px);
  for (std::size_t i = 0; i < rivals.size(); ++i) rivals[i].verdict = verdicts[i];
  // A frame is one thing: its inner border is as sure as its outer one.
  for (std::size_t i = 0; i < rivals.size(); ++i)
    if (verdicts[i].reject == RejectReason::kOuterBorder) {
      ScoredCandidate& inner = rivals[verdicts[i].other];
      inner.score = std::max(inner.score, rivals[i].score);
    }
}

}  // namespace window_ingress::detection
