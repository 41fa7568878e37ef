#include "window_ingress/detection/candidate_search.hpp"

#include <algorithm>
#include <cmath>

#include "window_ingress/detection/window_score.hpp"

namespace window_ingress::detection {
namespace {

using geometry::Quadrilateral;

constexpr double kSameLoopPx =
    1.0;  ///< corners of the same loop differ less than this on the search level [px]
constexpr double kVariantPart = 0.2;  ///< loops whose corners differ less, in its size, belong to one window
constexpr int kMostVariants = 6;      ///< of one window that are looked at
constexpr double kSameLoopPart = 0.005;  ///< plus this part of its size

Quadrilateral inFullImage(const Quadrilateral& quad, int factor) {
  return {toFullImage(quad[0], factor), toFullImage(quad[1], factor), toFullImage(quad[2], factor),
          toFullImage(quad[3], factor)};
}

double cornerDistance(const Quadrilateral& a, const Quadrilateral& b) {
  double worst = 0.0;
  for (int i = 0; i < 4; ++i) worst = std::max(worst, (a[i] - b[i]).squaredNorm());
  return std::sqrt(worst);
}

}  // namespace

CandidateTrace traceOf(const Rival& rival, RejectReason reason, double value, double limit) {
  return {rival.quad,
          rival.candidate.source,
          reason,
          value,
          limit,
          rival.score,
          rival.appearance.has_value(),
          rival.appearance ? rival.appearance->distance : 0.0};
}

void sortByRank(std::vector<Rival>& rivals) {
  std::stable_sort(rivals.begin(), rivals.end(),
                   [](const Rival& a, const Rival& b) { return a.rank() > b.rank(); });
}

CandidateSearch::CandidateSearch(const DetectorParams& params)
    : params_(params),
      preprocess_(params.preprocess),
      edges_(params.edges),
      runs_(params.runs),
      lines_(params.lines),
      closing_(params.closing),
      contours_(params.contours),
      segment_quads_(params.segment_quads),
      gates_(params.gates) {}

std::vector<Rival> CandidateSearch::run(const cv::Mat& image, const geometry::PinholeCamera* camera,
                                        DetectionTrace& trace) {
  const SearchLevel level = preprocess_.run(image);
  factor_ = level.factor;
  level_size_ = level.image.size();
  lens_.set(camera, level_size_, factor_);
  look(level.image);
  return combine(SegmentQuads::kQuick, trace);
}

// From edges to segments and outlines.
void CandidateSearch::look(const cv::Mat& level) {
  map_ = &edges_.run(level);
  segments_ = &lines_.run(runs_.run(*map_, lens_), level_size_);
  keepOnSegments(runs_, lines_, level_size_, straight_);
  outlines_ = contours_.run(closing_.run(straight_), closing_.radiusPx(level_size_));
  for (CandidateTrace& rejected : outlines_.rejected) rejected.quad = inFullImage(rejected.quad, factor_);
  for (Candidate& outline : outlines_.candidates)
    for (Eigen::Vector2d& corner : outline.quad) corner = lens_.undistort(corner);
}

std::vector<Rival> CandidateSearch::runOnColours(DetectionTrace& trace) {
  const cv::Mat& colours = preprocess_.coloursAlone();
  if (colours.empty()) return {};
  look(colours);
  return combine(SegmentQuads::kThorough, trace);
}

std::vector<Rival> CandidateSearch::runAgain(DetectionTrace& trace) {
  return combine(SegmentQuads::kThorough, trace);
}

// Quadrilaterals from segments and contours, through the gates.
std::vector<Rival> CandidateSearch::combine(const SegmentQuads::Effort& effort, DetectionTrace& trace) {
  const SegmentQuads::Result& quads =
      segment_quads_.run(*segments_, params_.gates.min_area * level_size_.area(), effort);
  trace.segments = static_cast<int>(segments_->size());
  trace.contours = outlines_.contours;
  trace.budget_exceeded = outlines_.budget_exceeded || quads.budget_exceeded;
  trace.candidates.insert(trace.candidates.end(), outlines_.rejected.begin(), outlines_.rejected.end());
  std::vector<Rival> rivals;
  admit(quads.candidates, *map_, rivals, trace);
  admit(outlines_.candidates, *map_, rivals, trace);
  return best(rivals, trace);
}

void CandidateSearch::admit(const std::vector<Candidate>& found, const EdgeMap& map,
                            std::vector<Rival>& rivals, DetectionTrace& trace) {
  for (const Candidate& one : found) {
    Rival rival;
    rival.candidate = one;
    Candidate& candidate = rival.candidate;
    for (int i = 0; i < 4; ++i) candidate.seen[i] = lens_.distort(candidate.quad[i]);
    auto rejection = gates_.shape(candidate, level_size_);
    if (!rejection) {
      candidate.sides = measureSides(map, lens_, candidate.quad, params_.side_support);
      rejection = gates_.support(candidate);
    }
    rival.quad = inFullImage(candidate.seen, factor_);
    if (rejection) {
      trace.candidates.push_back(traceOf(rival, rejection->reason, rejection->value, rejection->limit));
      continue;
    }
    rival.score = windowScore(candidate, params_.score);
    rival.size = sizeRank(candidate.quad, level_size_, params_.score);
    rivals.push_back(rival);
  }
}

// How many of those kept are loops of the same window.
int CandidateSearch::variants(const Rival& rival, const std::vector<Rival>& kept) {
  const double near_px = kVariantPart * std::sqrt(std::abs(geometry::signedArea(rival.candidate.quad)));
  return static_cast<int>(std::count_if(kept.begin(), kept.end(), [&](const Rival& better) {
    return cornerDistance(rival.candidate.quad, better.candidate.quad) < near_px;
  }));
}

std::vector<Rival> CandidateSearch::best(std::vector<Rival>& rivals, DetectionTrace& trace) const {
  sortByRank(rivals);
  std::vector<Rival> kept;
  for (const Rival& rival : rivals) {
    const double near_px =
        kSameLoopPx + kSameLoopPart * std::sqrt(std::abs(geometry::signedArea(rival.candidate.quad)));
    const auto twin = std::find_if(kept.begin(), kept.end(), [&](const Rival& better) {
      return cornerDistance(rival.candidate.quad, better.candidate.quad) < near_px;
    });
    if (twin != kept.end())
      trace.candidates.push_back(traceOf(rival, RejectReason::kDuplicate, rival.rank(), twin->rank()));
    else if (static_cast<int>(kept.size()) >= params_.max_candidates ||
             variants(rival, kept) >= kMostVariants)
      trace.candidates.push_back(traceOf(rival, RejectReason::kOutscored, rival.rank(), kept.back().rank()));
    else
      kept.push_back(rival);
  }
  return kept;
}

}  // namespace window_ingress::detection
