#include "detection/alignment/ring_matcher.hpp"

#include <algorithm>

#include "detection/quad_sameness.hpp"

namespace window_ingress::detection {
namespace {

constexpr double kComparedPx = 20.0, kAlignedPx = 30.0;  ///< [px per mean side]
constexpr double kRoughStartPx = 15.0;          ///< first resolution of an alignment from a rough place
constexpr std::size_t kPlaces = 10;             ///< number of places aligned
constexpr std::size_t kPlacesSearched = 6;      ///< number of places from a search without edges, at most
constexpr std::size_t kFinePlaces = 2;          ///< number of these aligned at the finest resolution
constexpr int kVariants = 2;                    ///< rough loops per place from which an alignment starts
constexpr double kSure = 0.85, kBehind = 0.3;   ///< sure score; after one, skip what promises less by kBehind
constexpr double kHopeless = 0.15;              ///< correlation below which a covered place is skipped
constexpr double kPale = 0.8, kUnsharp = 1.25;  ///< contrast when unsharp; its gain at half the resolution
constexpr double kProposalWeight = 0.3;         ///< of the geometry score, while a comparison says little

using Candidates = std::vector<ScoredCandidate>;

void sortByScore(Candidates& candidates) {
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const ScoredCandidate& a, const ScoredCandidate& b) { return a.score > b.score; });
}

// Keeps the best of all candidates that end at one place.
void keep(const ScoredCandidate& candidate, Candidates& aligned) {
  const auto same = std::find_if(aligned.begin(), aligned.end(), [&](const ScoredCandidate& kept) {
    return Sameness(kept.quad).samePlace(candidate.quad);
  });
  if (same == aligned.end())
    aligned.push_back(candidate);
  else if (candidate.score > same->score)
    *same = candidate;
}

}  // namespace

std::vector<RingMatcher::Promise> RingMatcher::compareAll(Candidates& candidates) {
  std::vector<Promise> order;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const double correlation = alignment_.correlation(candidates[i].quad, kComparedPx);
    candidates[i].correlation = std::max(0.0, correlation);
    if (correlation > (covered_ ? kHopeless : -1.0))
      order.push_back({correlation + kProposalWeight * candidates[i].score, i});
  }
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.score > b.score; });
  return order;
}

Candidates RingMatcher::placesEverywhere(bool leaning) {
  Candidates candidates;
  for (const RingSearch::Place& place : search_.run(image_, kPlacesSearched, leaning)) {
    ScoredCandidate& candidate = candidates.emplace_back();
    candidate.quad = place.quad;
    candidate.found.source = CandidateSource::kReference;
    candidate.score = place.correlation;
  }
  return candidates;
}

std::optional<ScoredCandidate> RingMatcher::aligned(const ScoredCandidate& rough, double finest_px) {
  const auto found = alignment_.align(rough.quad, finest_px, kRoughStartPx);
  const auto quad = found ? geometry::canonical(found->quad) : std::nullopt;
  if (!quad) return std::nullopt;
  ScoredCandidate candidate = rough;
  candidate.quad = *quad;
  candidate.found.source = CandidateSource::kReference;
  candidate.verdict = RejectReason::kNone;
  candidate.proposal = 0.0;
  candidate.located = true;
  candidate.size = 1.0;
  candidate.match = alignment_.judge(candidate.quad, finest_px);
  candidate.correlation = std::max(0.0, candidate.match.correlation);
  candidate.score = 0.5 * (*candidate.correlation + std::max(0.0, candidate.match.faithful_uncovered));
  return candidate;
}

// An image less sharp than the reference shows less contrast; at half the resolution it shows more.
RingMatch RingMatcher::judged(const geometry::Quadrilateral& quad) {
  RingMatch match = alignment_.judge(quad, kFinestPx);
  if (match.contrast >= kPale) return match;
  const RingMatch coarse = alignment_.judge(quad, 0.5 * std::min(kFinestPx, geometry::meanSide(quad)));
  if (coarse.contrast > kUnsharp * match.contrast)
    match.faithful = coarse.faithful, match.faithful_uncovered = coarse.faithful_uncovered;
  return match;
}

Candidates RingMatcher::align(Candidates& candidates) {
  Candidates found;
  std::vector<std::size_t> places;
  struct {
    double score = 0.0, promise = 0.0;
  } best;
  for (const auto& [promise, i] : compareAll(candidates)) {
    if (places.size() >= kPlaces || (best.score > kSure && promise < best.promise - kBehind)) break;
    const geometry::Quadrilateral& newcomer = candidates[i].quad;
    const auto variants = std::count_if(places.begin(), places.end(), [&](std::size_t place) {
      return Sameness(candidates[place].quad).samePlace(newcomer);
    });
    if (variants >= kVariants) continue;
    places.push_back(i);
    const auto candidate = aligned(candidates[i], kAlignedPx);
    if (!candidate) continue;
    if (candidate->score > best.score) best = {candidate->score, promise};
    keep(*candidate, found);
  }
  sortByScore(found);
  for (std::size_t i = 0; i < std::min(found.size(), kFinePlaces); ++i)
    if (const auto candidate = aligned(found[i], kFinestPx)) found[i] = *candidate;
  sortByScore(found);
  return found;
}

}  // namespace window_ingress::detection
