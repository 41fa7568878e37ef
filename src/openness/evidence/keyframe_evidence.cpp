#include "window_ingress/openness/keyframe_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "window_ingress/geometry/median.hpp"

namespace window_ingress::openness {
namespace {

constexpr double kBeforePlane_m = 0.1;  // a closed surface stands no further in front of the plane
constexpr int kMaxIds = 1000;
constexpr double kMaxTooDeep = 0.3;   // of the points
constexpr double kMaxSigmas = 3.0;    // deviation allowed for a static point
constexpr double kMaxUnsteady = 0.3;  // of the points
constexpr int kMinPoints = 5;         // needed for a verdict
constexpr int kMinToMove = 8;         // points needed to judge motion
constexpr double kGrowth = 1.25;      // of the gain, from sample to sample

double outside(double value, double low, double high) { return std::max({0.0, low - value, value - high}); }

// Ranges of D / (d + D) for a closed and an open way, seen from a distance d.
struct DepthParts {
  DepthParts(double distance_m, const OpennessParams& params) {
    const auto part = [&](double depth_m) { return depth_m / (distance_m + depth_m); };
    closed_from = part(-std::min(kBeforePlane_m, 0.5 * distance_m));
    closed_to = part(params.max_depth_closed_m);
    open_from = part(params.min_depth_behind_m);
    open_to = part(params.max_depth_behind_m);
  }
  // Log likelihood of the nearest open depth over that of the nearest closed one.
  double logOdds(double part, double sigma) const {
    const double closed = outside(part, closed_from, closed_to) / sigma;
    const double open = outside(part, open_from, open_to) / sigma;
    return 0.5 * (closed * closed - open * open);
  }

  double closed_from, closed_to;  // next to the plane: a surface that closes it
  double open_from, open_to;      // a room
};

// Depth from its part: D = d part / (1 - part).
double depthOf(double part, double distance_m) { return distance_m * part / std::max(1e-3, 1.0 - part); }
double depthSigma(double part, double sigma, double distance_m) {
  return distance_m * sigma / std::pow(std::max(1e-3, 1.0 - part), 2);
}

}  // namespace

void KeyframeEvidence::Point::see(const PointParallax& parallax) {
  place = parallax.place;
  const bool is_first = samples == 0;
  if (is_first || parallax.part_sigma < best.part_sigma) best = parallax;
  if (is_first || parallax.gain_px > kGrowth * ring[(samples - 1) % kSamples].gain_px)
    ring[samples++ % kSamples] = parallax;
}

bool KeyframeEvidence::Point::isSteady() const {
  const auto agrees = [&](const PointParallax& view) {
    return std::abs(view.part - best.part) <= kMaxSigmas * std::hypot(view.part_sigma, best.part_sigma);
  };
  return std::abs(best.across_px) <= kMaxSigmas * best.across_sigma_px &&
         std::all_of(ring.begin(), ring.begin() + std::min(samples, kSamples), agrees);
}

void KeyframeEvidence::begin(double key_stamp_sec) {
  key_stamp_sec_ = key_stamp_sec;
  points_.clear();
}

void KeyframeEvidence::see(int id, const PointParallax& parallax, bool through, std::uint64_t beside) {
  if (id < 0 || id >= kMaxIds) return;
  if (static_cast<std::size_t>(id) >= points_.size()) points_.resize(static_cast<std::size_t>(id) + 1);
  Point& point = points_[static_cast<std::size_t>(id)];
  point.see(parallax);
  point.through = through;
  point.beside = beside;
  point.is_new = true;
}

KeyframeEstimate KeyframeEvidence::estimate(double distance_m, const OpennessParams& params,
                                            OpeningCells& cells) {
  const DepthParts parts(distance_m, params);
  KeyframeEstimate estimate;
  int too_deep = 0;  // points further behind than any room
  std::vector<double> odds, depths, sigmas;
  for (Point& point : points_) {
    const bool is_new = std::exchange(point.is_new, false);
    if (!point.isTested()) continue;
    if (!point.isSteady()) {
      ++estimate.unsteady;
      continue;
    }
    const PointParallax& best = point.best;
    const double log_odds = parts.logOdds(best.part, best.part_sigma);
    if (log_odds < 0.0 && !point.through) continue;
    if (is_new) {
      cells.see(point.place, log_odds);
      cells.seeBeside(point.beside, log_odds);
    }
    odds.push_back(log_odds);
    depths.push_back(depthOf(best.part, distance_m));
    sigmas.push_back(depthSigma(best.part, best.part_sigma, distance_m));
    too_deep += best.part - 2.0 * best.part_sigma > parts.open_to;
  }
  cells.endImage();
  estimate.points = static_cast<int>(odds.size());
  const int all = estimate.points + estimate.unsteady;
  estimate.is_moving = all >= kMinToMove && estimate.unsteady > kMaxUnsteady * all;
  if (estimate.points < kMinPoints) return estimate;
  estimate.depth_m = geometry::median(depths);
  estimate.depth_sigma_m = geometry::median(sigmas);
  estimate.is_too_deep =
      too_deep > kMaxTooDeep * estimate.points || estimate.depth_m > params.max_depth_behind_m;
  if (!estimate.is_moving) estimate.log_odds = std::clamp(geometry::median(odds), -kMaxLogOdds, kMaxLogOdds);
  if (estimate.is_too_deep) estimate.log_odds = std::min(estimate.log_odds, 0.0);
  return estimate;
}

}  // namespace window_ingress::openness
