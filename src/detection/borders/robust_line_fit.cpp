#include "detection/borders/robust_line_fit.hpp"

#include <algorithm>
#include <cmath>

namespace window_ingress::detection {
namespace {

constexpr int kPasses = 8;
constexpr double kSettledPx = 1e-5;

double bisquare(double x) { return std::abs(x) < 1.0 ? (1.0 - x * x) * (1.0 - x * x) : 0.0; }

// Weights about the points' median, because all points may lie a little off the start.
void firstWeights(const OffsetPoints& points, double scale_px, const OffsetLine& line) {
  double *rests = points.scratch, *sorted = points.scratch + points.count;
  for (int i = 0; i < points.count; ++i) rests[i] = points.offsets[i] - line.at(points.positions[i]);
  std::copy(rests, rests + points.count, sorted);
  std::nth_element(sorted, sorted + points.count / 2, sorted + points.count);
  const double median = sorted[points.count / 2];
  for (int i = 0; i < points.count; ++i) rests[i] = 1e-3 + bisquare((rests[i] - median) / (6.0 * scale_px));
}

// Weighted least squares; false if the weights leave nothing to solve.
bool solve(const OffsetPoints& points, OffsetLine& line) {
  double w = 0, ws = 0, wd = 0, wss = 0, wsd = 0;
  for (int i = 0; i < points.count; ++i) {
    const double weight = points.scratch[i], s = points.positions[i], d = points.offsets[i];
    w += weight, ws += weight * s, wd += weight * d, wss += weight * s * s, wsd += weight * s * d;
  }
  if (!(w > 0.0)) return false;
  const double mean = ws / w, spread = wss - ws * mean;
  if (!(spread > 1e-9 * w)) return false;
  line.slope = (wsd - wd * mean) / spread;
  line.offset = wd / w - line.slope * mean;
  return true;
}

}  // namespace

void fitRobustLine(const OffsetPoints& points, double scale_px, OffsetLine& line) {
  if (points.count < 2) return;
  const double reach = std::max(std::abs(points.positions[0]), std::abs(points.positions[points.count - 1]));
  firstWeights(points, scale_px, line);
  for (int pass = 0; pass < kPasses; ++pass) {
    const OffsetLine before = line;
    if (!solve(points, line)) return;
    const double moved = std::abs(line.offset - before.offset) + reach * std::abs(line.slope - before.slope);
    if (pass > 1 && moved < kSettledPx) return;
    for (int i = 0; i < points.count; ++i)
      points.scratch[i] = bisquare((points.offsets[i] - line.at(points.positions[i])) / (3.0 * scale_px));
  }
}

}  // namespace window_ingress::detection
