#include "detection/target_choice.hpp"

#include <algorithm>

#include "detection/quad_sameness.hpp"
#include "window_ingress/detection/window_detector.hpp"
#include "window_ingress/geometry/image_border.hpp"

namespace window_ingress::detection {
namespace {

constexpr int kRefinementTries = 6;
constexpr double kLocatedRadiusPx = 2.5;  ///< search reach of the fit for located borders [px]
constexpr double kSearchRadius = 1.5;     ///< search reach for borders from the search [px of its level]
constexpr double kBlobRadius = 3.0;      ///< search reach for borders from a blob's outline [px of its level]
constexpr double kLocatedSigmaPx = 1.4;  ///< standard deviation of located borders [px]
constexpr double kAlignedStrayPx = 2.0;  ///< distance of fitted borders from the aligned surroundings [px]
constexpr double kCutAway = 0.01;        ///< how far a corner may lie outside the image [longer image sides]
constexpr int kFewestSeen = 3;           ///< borders that must be visible where the surroundings were aligned
constexpr double kWholeRing = 0.9;       ///< correlation above which nothing of the ring is hidden
constexpr int kAllSeen = 4;              ///< all borders are visible
constexpr double kVariantRadiusPx = 4.0;  ///< search reach for borders of a window that was passed over [px]

// Correlation of the next best place.
double runnerUp(const ScoredCandidate& target, const std::vector<ScoredCandidate>& candidates) {
  const Sameness same(target.quad);
  double best = 0.0;
  for (const ScoredCandidate& other : candidates)
    if (other.located && !same.sameWindow(other.quad)) best = std::max(best, other.correlation.value_or(0.0));
  return best;
}

// Observation of a window found by a search, with its fitted borders.
WindowObservation observationOf(const CandidateTrace& candidate, const RefinedBorders& borders,
                                double stamp_sec) {
  WindowObservation window;
  window.stamp_sec = stamp_sec;
  window.corners = borders.corners;
  window.corner_covariance = borders.corner_covariance;
  window.edges = borders.edges;
  window.score = candidate.score;
  window.has_appearance = candidate.has_appearance;
  window.bhattacharyya = candidate.bhattacharyya;
  window.correlation = candidate.correlation;
  return window;
}

}  // namespace

double TargetChoice::leastScore(const ScoredCandidate& candidate) const {
  if (candidate.correlation) return params_.min_correlation;
  return candidate.appearance ? params_.min_score_reference : params_.min_score;
}

// An aligned place must show its borders, because the opening may have been walled up. If all of its
// surroundings match, it is enough that the inside differs from the wall.
bool TargetChoice::showsOpening(const ScoredCandidate& candidate, const RefinedBorders& found) const {
  if (!candidate.correlation) return true;
  if (found.seen < reference_.bordersNeeded(candidate.match)) return false;
  return (found.seen >= kFewestSeen && !reference_.frameless()) || reference_.showsOpening(found.corners);
}

std::optional<Rejection> TargetChoice::objection(const ScoredCandidate& candidate) const {
  if (candidate.located && candidate.correlation)
    return reference_.objectionTo(candidate.match, candidate.appearance);
  if (candidate.appearance)
    if (const auto refused = reference_.objectionTo(*candidate.appearance)) return refused;
  if (candidate.verdict != RejectReason::kNone) return Rejection{candidate.verdict, candidate.rank(), 0.0};
  if (const double least = leastScore(candidate); candidate.score < least)
    return Rejection{RejectReason::kScore, candidate.score, least};
  return std::nullopt;
}

std::optional<RefinedBorders> TargetChoice::refine(const ScoredCandidate& candidate, const View& view,
                                                   double& inliers) const {
  BorderStart start;
  start.quad = candidate.quad;
  const bool is_blob = candidate.found.source == CandidateSource::kBlob;
  start.radius_px =
      candidate.located ? kLocatedRadiusPx : (is_blob ? kBlobRadius : kSearchRadius) * search_factor_ + 1.0;
  if (candidate.located) start.knowAll(kLocatedSigmaPx);
  if (candidate.correlation) start.max_stray_px = kAlignedStrayPx;
  return refineBorders(view.image, start, view.camera, &inliers);
}

// A hidden side is placed from the borders of the three others.
std::optional<RefinedBorders> TargetChoice::fitWhere(const AlignedRing& ring, const View& view) const {
  BorderStart start{ring.quad, kLocatedRadiusPx, ring.sides, kAlignedStrayPx, ring.hidden};
  auto found = refineBorders(view.image, start, view.camera);
  if (!found || !ring.hidden) return found;
  const auto whole = reference_.completed(found->corners, *ring.hidden);
  if (!whole) return found;
  start.quad = *whole;
  return refineBorders(view.image, start, view.camera);
}

std::optional<RefinedBorders> TargetChoice::bordersNear(const geometry::Quadrilateral& place,
                                                        const View& view) const {
  if (!view.camera) return std::nullopt;
  reference_.see(view.image, view.camera);
  const auto ring = reference_.surroundingsOf(place, RingMatcher::kFollowedStartPx);
  return ring ? fitWhere(*ring, view) : std::nullopt;
}

// Another window with common features is aligned, too; its borders contradict the alignment.
std::optional<Rejection> TargetChoice::judgeSurroundingsOf(const ScoredCandidate& candidate, const View& view,
                                                           RefinedBorders& fitted) {
  const auto ring = reference_.surroundingsOf(fitted.corners, RingMatcher::kFoundStartPx);
  ring_there_ = ring ? ring->correlation : 0.0;
  if (!ring) {
    if (reference_.frameTells(candidate.border_score)) return std::nullopt;
    return Rejection{RejectReason::kUnlike, 0.0, params_.min_correlation};
  }
  if (!candidate.correlation)
    if (auto fault = reference_.objectionTo(*ring, candidate.appearance)) return fault;
  const auto anew = fitWhere(*ring, view);
  if (!anew) return std::nullopt;
  const auto agreeing = std::count(anew->fitted.begin(), anew->fitted.end(), true);
  if (agreeing >= kFewestSeen || !reference_.objectionTo(fitted)) fitted = *anew;
  return std::nullopt;
}

// Tests the shape of four visible borders first, because the ring would impose the reference's shape on them.
std::optional<Rejection> TargetChoice::fit(const ScoredCandidate& candidate, const View& view,
                                           RefinedBorders& fitted) {
  double inliers = 0.0;
  const auto found = refine(candidate, view, inliers);
  if (!found || !showsOpening(candidate, *found))
    return Rejection{RejectReason::kRefinement, inliers, kMinBorderInliers};
  fitted = *found;
  if (candidate.correlation && found->seen == kAllSeen)
    if (const auto fault = reference_.objectionTo(fitted)) return fault;
  if (const auto fault = judgeSurroundingsOf(candidate, view, fitted)) return fault;
  const double least = -kCutAway * std::max(view.image.cols, view.image.rows);
  if (const double inside = geometry::distanceToBorder(fitted.corners, view.image.cols, view.image.rows);
      inside < least)
    return Rejection{RejectReason::kBorder, inside, least};
  if (const auto fault = reference_.objectionTo(fitted)) return fault;
  if (ring_there_ < kWholeRing && reference_.frameGoesOn(fitted.corners))
    return Rejection{RejectReason::kUnlike, ring_there_, kWholeRing};
  uncover(view, fitted);
  return std::nullopt;
}

// The edge of an object before a side may have been mistaken for the side's border.
void TargetChoice::uncover(const View& view, RefinedBorders& fitted) {
  const auto ring = reference_.uncovered(fitted.corners);
  const auto anew = ring ? fitWhere(*ring, view) : std::nullopt;
  if (anew && std::count(anew->fitted.begin(), anew->fitted.end(), true) >= kFewestSeen) fitted = *anew;
}

// Chooses the best candidate without an objection whose borders can be fitted.
std::optional<WindowObservation> TargetChoice::choose(std::vector<ScoredCandidate>& candidates,
                                                      int search_factor, const View& view) {
  search_factor_ = search_factor;
  sortByRank(candidates);
  std::optional<WindowObservation> window;
  double window_rank = 0.0;
  int tries = 0;
  for (const ScoredCandidate& candidate : candidates) {
    auto fault = objection(candidate);
    if (!fault && window) fault = Rejection{RejectReason::kOutscored, candidate.rank(), window_rank};
    if (!fault && ++tries > kRefinementTries)
      fault = Rejection{RejectReason::kBudget, static_cast<double>(tries), kRefinementTries};
    RefinedBorders fitted;
    if (!fault) fault = fit(candidate, view, fitted);
    if (fault) {
      record(candidate, fault->reason, fault->value, fault->limit);
      continue;
    }
    if (trace_.target >= 0) trace_.candidates[trace_.target].reject = RejectReason::kOutscored;
    record(candidate, RejectReason::kNone, candidate.score, leastScore(candidate));
    window = observationOf(trace_.candidates.back(), fitted, view.stamp_sec);
    window->runner_up = runnerUp(candidate, candidates);
    window_rank = candidate.rank();
    trace_.target = static_cast<int>(trace_.candidates.size()) - 1;
    trace_.candidates.back().quad = fitted.corners;
  }
  return window;
}

void TargetChoice::chooseAgain(int target) {
  trace_.candidates[static_cast<std::size_t>(trace_.target)].reject = RejectReason::kOutscored;
  trace_.candidates[static_cast<std::size_t>(target)].reject = RejectReason::kNone;
  trace_.target = target;
}

void TargetChoice::takeBack() {
  CandidateTrace& chosen = trace_.candidates[static_cast<std::size_t>(trace_.target)];
  chosen.reject = RejectReason::kUnlike, chosen.value = 0.0, chosen.limit = params_.min_correlation;
  trace_.target = -1;
}

std::optional<WindowObservation> TargetChoice::passedOver(const WindowObservation& better,
                                                          const IsWanted& is_wanted, const View& view) const {
  std::vector<const CandidateTrace*> others;
  for (const CandidateTrace& other : trace_.candidates)
    if (other.reject == RejectReason::kOutscored && is_wanted(other.quad)) others.push_back(&other);
  std::stable_sort(others.begin(), others.end(),
                   [](const auto* a, const auto* b) { return a->score > b->score; });
  for (const CandidateTrace* other : others) {
    if (Sameness(other->quad).sameWindow(better.corners)) return better;
    const auto borders = refineBorders(view.image, {other->quad, kVariantRadiusPx}, view.camera);
    if (borders) return observationOf(*other, *borders, view.stamp_sec);
  }
  return std::nullopt;
}

}  // namespace window_ingress::detection
