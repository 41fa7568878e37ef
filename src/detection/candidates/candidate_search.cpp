#include "detection/candidates/candidate_search.hpp"

#include <algorithm>
#include <utility>

#include "detection/candidates/candidate_gates.hpp"
#include "detection/candidates/candidate_score.hpp"
#include "detection/candidates/side_support.hpp"
#include "detection/quad_sameness.hpp"

namespace window_ingress::detection {
namespace {

using geometry::Quadrilateral;

constexpr double kOpenScore = 0.5;        ///< score of a candidate with three sides
constexpr double kColourContrast = 16.0;  ///< of blobs in the colour-only image [grey levels]
constexpr double kPaintContrast = 8.0;    ///< of blobs in the image of one paint [grey levels]

Quadrilateral inFullImage(Quadrilateral quad, int factor) {
  for (Eigen::Vector2d& corner : quad) corner = toFullImage(corner, factor);
  return quad;
}

}  // namespace

CandidateSearch::CandidateSearch(const DetectorParams& params)
    : params_(params), hough_(params.lines), segment_quads_(params.segment_quads) {}

const std::vector<ScoredCandidate>& CandidateSearch::run(const cv::Mat& image,
                                                         const geometry::PinholeCamera* camera,
                                                         DetectionTrace& trace) {
  level_ = preprocess(image, params_.preprocess, std::move(level_.image));
  lens_ = lensOfLevel(camera, level_);
  done(timer_, Stage::kPreprocess);
  look(level_.image);
  return combine(SegmentQuads::kQuick, trace);
}

// From edges to segments and outlines.
void CandidateSearch::look(const cv::Mat& image) {
  map_ = cannyEdges(image, params_.edges, std::move(map_));
  done(timer_, Stage::kEdges);
  segments_ = &hough_.run(chains_.run(map_, lens()), image.size());
  done(timer_, Stage::kLines);
  outlines_ = {};
  straight_ = edgesOnSegments(chains_, hough_, image.size(), std::move(straight_));
  outline(straight_, CandidateSource::kContour);
  done(timer_, Stage::kOutlines);
}

void CandidateSearch::outline(const cv::Mat& mask, CandidateSource source) {
  const int dilation_px = closeGaps(mask, params_.closing, closed_);
  addOutlines(closed_, dilation_px, params_.contours, source, outlines_);
}

const std::vector<ScoredCandidate>& CandidateSearch::runOnColours(const std::optional<Eigen::Vector3f>& paint,
                                                                  DetectionTrace& trace) {
  const cv::Mat colours = paint ? paintAlone(level_.image, *paint) : coloursAlone(level_.image);
  kept_.clear();
  if (colours.empty()) return kept_;
  done(timer_, Stage::kPreprocess);
  look(colours);
  for (int channel = 0; channel < colours.channels(); ++channel)
    for (const cv::Mat& blobs : blobMasks(colours, channel, paint ? kPaintContrast : kColourContrast))
      outline(blobs, CandidateSource::kBlob);
  done(timer_, Stage::kOutlines);
  return combine(SegmentQuads::kThorough, trace);
}

// Quadrilaterals from segments and contours, through the gates.
const std::vector<ScoredCandidate>& CandidateSearch::combine(const SegmentQuads::Effort& effort,
                                                             DetectionTrace& trace) {
  const SegmentQuads::Result quads =
      segment_quads_.run(*segments_, params_.gates.min_area * level_.image.size().area(), effort);
  trace.segments += static_cast<int>(segments_->size());
  trace.contours += outlines_.contours;
  trace.budget_exceeded |= outlines_.budget_exceeded || quads.budget_exceeded;
  for (CandidateTrace rejected : outlines_.rejected) {
    rejected.quad = inFullImage(rejected.quad, level_.factor);
    trace.candidates.push_back(rejected);
  }
  admitted_.clear();
  for (const Candidate& candidate : quads.candidates) admit(candidate, trace);
  for (Candidate candidate : outlines_.candidates) {
    candidate.quad = geometry::undistorted(candidate.seen, lens());
    admit(candidate, trace);
  }
  keepBest(trace);
  done(timer_, Stage::kCandidates);
  return kept_;
}

std::vector<ScoredCandidate> CandidateSearch::open() {
  std::vector<ScoredCandidate> open;
  for (const Candidate& found : segment_quads_.open()) {
    ScoredCandidate candidate = placed(found);
    candidate.score = kOpenScore;
    if (!shapeFault(candidate.found, level_.image.size(), params_.gates)) open.push_back(candidate);
  }
  return open;
}

// Adds its places in the raw images.
ScoredCandidate CandidateSearch::placed(const Candidate& found) const {
  ScoredCandidate candidate;
  candidate.found = found;
  candidate.found.seen = geometry::distorted(found.quad, lens());
  candidate.quad = inFullImage(candidate.found.seen, level_.factor);
  return candidate;
}

void CandidateSearch::admit(const Candidate& found, DetectionTrace& trace) {
  ScoredCandidate scored = placed(found);
  Candidate& candidate = scored.found;
  auto rejection = shapeFault(candidate, level_.image.size(), params_.gates);
  if (!rejection) {
    const auto edges = measureSides(map_, lens(), candidate.quad);
    for (int i = 0; i < 4; ++i) {  // edges may show less than the outline of a blob has shown
      SideSupport& side = candidate.sides[i];
      side = {std::max(side.fraction, edges[i].fraction), std::max(side.contrast, edges[i].contrast),
              edges[i].overshoot};
    }
    rejection = supportFault(candidate, params_.gates);
  }
  if (rejection) {
    trace.candidates.push_back(traceOf(scored, *rejection));
    return;
  }
  scored.score = windowScore(candidate);
  scored.size = sizeRank(candidate.quad, level_.image.size());
  scored.proposal = scored.rank();
  admitted_.push_back(scored);
}

void CandidateSearch::keepBest(DetectionTrace& trace) {
  sortByRank(admitted_);
  kept_.clear();
  for (const ScoredCandidate& candidate : admitted_) {
    const Sameness same(candidate.found.quad);
    const auto twin = std::find_if(kept_.begin(), kept_.end(), [&](const ScoredCandidate& better) {
      return same.sameQuad(better.found.quad);
    });
    const bool is_known = twin != kept_.end();
    if (!is_known && static_cast<int>(kept_.size()) < params_.max_candidates) {
      kept_.push_back(candidate);
      continue;
    }
    trace.budget_exceeded |= !is_known;
    const RejectReason reason = is_known ? RejectReason::kDuplicate : RejectReason::kBudget;
    const double better_rank = is_known ? twin->rank() : kept_.back().rank();
    trace.candidates.push_back(traceOf(candidate, {reason, candidate.rank(), better_rank}));
  }
}

}  // namespace window_ingress::detection
