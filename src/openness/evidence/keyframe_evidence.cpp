#include "window_ingress/openness/keyframe_evidence.hpp"

#include <algorithm>
#include <cmath>

#include "window_ingress/geometry/median.hpp"

namespace window_ingress::openness {
namespace {

constexpr double kBeforePlane_m = 0.1;  // a closed surface stands no further in front of the plane

double outside(double value, double low, double high) { return std::max({0.0, low - value, value - high}); }

constexpr int kMaxIds = 1000;
constexpr double kMaxTooDeep = 0.3;   // of the points
constexpr double kMaxSigmas = 3.0;    // deviation allowed for a static point
constexpr double kMaxUnsteady = 0.3;  // of the points
constexpr int kMinPoints = 5;         // needed for a verdict
constexpr int kMinToMove = 8;         // points needed to judge motion

// Depth from its part: D = d part / (1 - part).
double depthOf(double part, double distance_m) { return distance_m * part / std::max(1e-3, 1.0 - part); }
double depthSigma(double part, double sigma, double distance_m) {
  return distance_m * sigma / std::pow(std::max(1e-3, 1.0 - part), 2);
}

}  // namespace

DepthParts DepthParts::at(double distance_m, const OpennessParams& params) {
  const auto part = [&](double depth_m) { return depth_m / (distance_m + depth_m); };
  return {part(-std::min(kBeforePlane_m, 0.5 * distance_m)), part(params.max_depth_closed_m),
          part(params.min_depth_behind_m), part(params.max_depth_behind_m)};
}

double DepthParts::logOdds(double part, double sigma) const {
  const double closed = outside(part, closed_from, closed_to) / sigma;
  const double open = outside(part, open_from, open_to) / sigma;
  return 0.5 * (closed * closed - open * open);
}

void TrackEvidence::see(const PointParallax& parallax) {
  last_ = parallax;
  if (views_++ == 0 || parallax.part_sigma < best_.part_sigma) best_ = parallax;
  const bool further = samples_ == 0 || parallax.gain_px > kGrowth * ring_[(samples_ - 1) % kSamples].gain_px;
  if (further) ring_[samples_++ % kSamples] = {parallax.part, parallax.part_sigma, parallax.gain_px};
}

bool TrackEvidence::isSteady(double max_sigmas) const {
  if (views_ == 0 || std::abs(best_.across_px) > max_sigmas * best_.across_sigma_px) return false;
  for (int i = 0; i < std::min(samples_, kSamples); ++i)
    if (std::abs(ring_[i].part - best_.part) > max_sigmas * std::hypot(ring_[i].sigma, best_.part_sigma))
      return false;
  return true;
}

void KeyframeEvidence::begin(double key_stamp_sec) {
  key_stamp_sec_ = key_stamp_sec;
  entries_.clear();
}

void KeyframeEvidence::see(int id, const PointParallax& parallax, bool through, std::uint64_t beside) {
  if (id < 0 || id >= kMaxIds) return;
  if (static_cast<std::size_t>(id) >= entries_.size()) entries_.resize(static_cast<std::size_t>(id) + 1);
  Entry& entry = entries_[static_cast<std::size_t>(id)];
  entry.track.see(parallax);
  entry.through = through;
  entry.beside = beside;
  entry.current = true;
}

void KeyframeEvidence::mark(const DepthParts& parts, OpeningCells& cells) {
  for (Entry& entry : entries_) {
    const bool is_new = entry.current;
    entry.current = false;
    if (!is_new || !entry.track.isTested() || !entry.track.isSteady(kMaxSigmas)) continue;
    const double log_odds = parts.logOdds(entry.track.best().part, entry.track.best().part_sigma);
    if (log_odds < 0.0 && !entry.through) continue;
    cells.see(entry.track.last().place, log_odds);
    cells.seeBeside(entry.beside, log_odds);
  }
  cells.endImage();
}

KeyframeEstimate KeyframeEvidence::estimate(const DepthParts& parts, double distance_m,
                                            const OpennessParams& params) const {
  KeyframeEstimate estimate;
  int too_deep = 0;  // points further behind than any room
  std::vector<double> odds, depths, sigmas;
  for (const Entry& entry : entries_) {
    if (!entry.track.isTested()) continue;
    const PointParallax& best = entry.track.best();
    if (!entry.track.isSteady(kMaxSigmas)) {
      ++estimate.unsteady;
      continue;
    }
    const double log_odds = parts.logOdds(best.part, best.part_sigma);
    if (log_odds < 0.0 && !entry.through) continue;
    odds.push_back(log_odds);
    depths.push_back(depthOf(best.part, distance_m));
    sigmas.push_back(depthSigma(best.part, best.part_sigma, distance_m));
    too_deep += best.part - 2.0 * best.part_sigma > parts.open_to;
  }
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
