#include "detection/alignment/ring_matcher.hpp"

#include <algorithm>

#include "detection/quad_sameness.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {
namespace {

constexpr double kComparedPx = 20.0, kAlignedPx = 30.0,
                 kFinestPx = 200.0;         ///< [px per mean side]
constexpr double kRoughStartPx = 15.0;      ///< first resolution of an alignment from a rough place
constexpr std::size_t kPlaces = 10;         ///< number of places aligned
constexpr std::size_t kPlacesSearched = 6;  ///< number of places from a search without edges, at most
constexpr std::size_t kFinePlaces = 2;      ///< number of these aligned at the finest resolution
constexpr int kVariants = 2;                ///< rough loops per place from which an alignment starts
constexpr double kSure = 0.85,
                 kBehind = 0.3;     ///< sure score; after one, skip what promises less by kBehind
constexpr double kHopeless = 0.15;  ///< correlation below which a covered place is skipped
constexpr double kPale = 0.8,
                 kUnsharp = 1.25;        ///< contrast when unsharp; its gain at half the resolution
constexpr double kProposalWeight = 0.3;  ///< of the geometry score, while a comparison says little

void sortByScore(std::vector<ScoredCandidate>& candidates) {
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const ScoredCandidate& a, const ScoredCandidate& b) { return a.score > b.score; });
}

}  // namespace

// Orders the candidates, the most promising first.
void RingMatcher::compareAll(std::vector<ScoredCandidate>& candidates) {
  order_.clear();
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const RingMatch match = alignment_.compare(candidates[i].quad, kComparedPx);
    candidates[i].correlation = std::max(0.0, match.correlation);
    if (match.correlation > (covered_ ? kHopeless : -1.0))
      order_.emplace_back(match.correlation + kProposalWeight * candidates[i].score, i);
  }
  std::sort(order_.begin(), order_.end(), [](const auto& a, const auto& b) {
    return a.first > b.first || (a.first == b.first && a.second < b.second);
  });
}

std::vector<ScoredCandidate> RingMatcher::placesEverywhere(const cv::Mat& image, bool leaning) {
  std::vector<ScoredCandidate> candidates;
  if (!compares(image)) return candidates;
  for (const RingSearch::Place& place : search_.run(image, kPlacesSearched, leaning)) {
    ScoredCandidate candidate;
    candidate.quad = place.quad;
    candidate.found.source = CandidateSource::kReference;
    candidate.score = place.correlation;
    candidates.push_back(candidate);
  }
  return candidates;
}

std::optional<ScoredCandidate> RingMatcher::aligned(const ScoredCandidate& rough, double finest_px) {
  const auto found = alignment_.align(rough.quad, finest_px, kRoughStartPx);
  if (!found) return std::nullopt;
  const auto quad = geometry::canonical(found->quad);
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

// Keeps the best of all candidates that end at one place.
void RingMatcher::keep(const ScoredCandidate& candidate) {
  const auto same = std::find_if(aligned_.begin(), aligned_.end(), [&](const ScoredCandidate& kept) {
    return Sameness(kept.quad).samePlace(candidate.quad);
  });
  if (same == aligned_.end())
    aligned_.push_back(candidate);
  else if (candidate.score > same->score)
    *same = candidate;
}

std::optional<AlignedRing> RingMatcher::alignedAt(const cv::Mat& image, const geometry::PinholeCamera* camera,
                                                  const geometry::Quadrilateral& quad, double coarsest_px) {
  if (!compares(image)) return std::nullopt;
  alignment_.set(model_, image, camera, covered_);
  return alignment_.align(quad, kFinestPx, coarsest_px);
}

std::optional<AlignedRing> RingMatcher::uncovered(const cv::Mat& image, const geometry::PinholeCamera* camera,
                                                  const geometry::Quadrilateral& quad) {
  if (!compares(image)) return std::nullopt;
  alignment_.set(model_, image, camera, covered_);
  return alignment_.uncovered(quad, kFinestPx);
}

const std::vector<ScoredCandidate>& RingMatcher::align(const cv::Mat& image,
                                                       const geometry::PinholeCamera* camera,
                                                       std::vector<ScoredCandidate>& candidates) {
  aligned_.clear();
  if (!compares(image)) return aligned_;
  alignment_.set(model_, image, camera, covered_);
  compareAll(candidates);
  std::vector<std::size_t> places;
  struct {
    double score = 0.0, promise = 0.0;
  } best;
  for (const auto& [promise, i] : order_) {
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
    keep(*candidate);
  }
  sortByScore(aligned_);
  for (std::size_t i = 0; i < std::min(aligned_.size(), kFinePlaces); ++i)
    if (const auto candidate = aligned(aligned_[i], kFinestPx)) aligned_[i] = *candidate;
  sortByScore(aligned_);
  return aligned_;
}

}  // namespace window_ingress::detection
