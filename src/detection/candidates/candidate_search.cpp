#include "detection/candidates/candidate_search.hpp"

#include <algorithm>

#include "detection/candidates/candidate_gates.hpp"
#include "detection/candidates/side_support.hpp"
#include "detection/quad_sameness.hpp"

namespace window_ingress::detection {
namespace {

using geometry::Quadrilateral;

constexpr double kOpenScore = 0.5;        ///< score of a candidate with three sides
constexpr double kColourContrast = 16.0;  ///< of blobs in the colour-only image [grey levels]
constexpr double kPaintContrast = 8.0;    ///< of blobs in the image of one paint [grey levels]

Quadrilateral inFullImage(const Quadrilateral& quad, int factor) {
  return {toFullImage(quad[0], factor), toFullImage(quad[1], factor), toFullImage(quad[2], factor),
          toFullImage(quad[3], factor)};
}

// Combines with the support by edges, which may be less than the outline of a blob has shown.
void addEdges(const std::array<SideSupport, 4>& edges, std::array<SideSupport, 4>& sides) {
  for (int i = 0; i < 4; ++i) {
    sides[i].fraction = std::max(sides[i].fraction, edges[i].fraction);
    sides[i].contrast = std::max(sides[i].contrast, edges[i].contrast);
    sides[i].overshoot = edges[i].overshoot;
  }
}

}  // namespace

CandidateSearch::CandidateSearch(const DetectorParams& params)
    : params_(params),
      preprocess_(params.preprocess),
      edges_(params.edges),
      hough_(params.lines),
      dilation_(params.closing),
      contours_(params.contours),
      segment_quads_(params.segment_quads) {}

const std::vector<ScoredCandidate>& CandidateSearch::run(const cv::Mat& image,
                                                         const geometry::PinholeCamera* camera,
                                                         DetectionTrace& trace) {
  const SearchLevel level = preprocess_.run(image);
  factor_ = level.factor;
  level_size_ = level.image.size();
  undistortion_.set(camera, level_size_, factor_);
  done(timer_, Stage::kPreprocess);
  look(level.image);
  return combine(SegmentQuads::kQuick, trace);
}

// From edges to segments and outlines.
void CandidateSearch::look(const cv::Mat& level) {
  map_ = &edges_.run(level);
  done(timer_, Stage::kEdges);
  segments_ = &hough_.run(chains_.run(*map_, undistortion_), level_size_);
  done(timer_, Stage::kLines);
  keepOnSegments(chains_, hough_, level_size_, straight_);
  outlines_.candidates.clear();
  outlines_.rejected.clear();
  outlines_.contours = 0;
  outlines_.budget_exceeded = false;
  outline(straight_, CandidateSource::kContour);
  done(timer_, Stage::kOutlines);
}

void CandidateSearch::outline(const cv::Mat& mask, CandidateSource source) {
  const auto& found = contours_.run(dilation_.run(mask), dilation_.radiusPx(level_size_), source);
  outlines_.contours += found.contours;
  outlines_.budget_exceeded = outlines_.budget_exceeded || found.budget_exceeded;
  for (CandidateTrace rejected : found.rejected) {
    rejected.quad = inFullImage(rejected.quad, factor_);
    outlines_.rejected.push_back(rejected);
  }
  for (Candidate candidate : found.candidates) {
    for (Eigen::Vector2d& corner : candidate.quad) corner = undistortion_.undistort(corner);
    outlines_.candidates.push_back(candidate);
  }
}

void CandidateSearch::outlineBlobs(const cv::Mat& level, double contrast) {
  for (int channel = 0; channel < level.channels(); ++channel) {
    blobs_.take(level, channel);
    for (const auto sign : {BlobMasks::Sign::kAbove, BlobMasks::Sign::kBelow})
      outline(blobs_.run(sign, contrast), CandidateSource::kBlob);
  }
  done(timer_, Stage::kOutlines);
}

const std::vector<ScoredCandidate>& CandidateSearch::runOnColours(const std::optional<Eigen::Vector3f>& paint,
                                                                  DetectionTrace& trace) {
  const cv::Mat& colours = paint ? preprocess_.paintAlone(*paint) : preprocess_.coloursAlone();
  kept_.clear();
  if (colours.empty()) return kept_;
  done(timer_, Stage::kPreprocess);
  look(colours);
  outlineBlobs(colours, paint ? kPaintContrast : kColourContrast);
  return combine(SegmentQuads::kThorough, trace);
}

// Quadrilaterals from segments and contours, through the gates.
const std::vector<ScoredCandidate>& CandidateSearch::combine(const SegmentQuads::Effort& effort,
                                                             DetectionTrace& trace) {
  const SegmentQuads::Result& quads =
      segment_quads_.run(*segments_, params_.gates.min_area * level_size_.area(), effort);
  trace.segments = static_cast<int>(segments_->size());
  trace.contours = outlines_.contours;
  trace.budget_exceeded = outlines_.budget_exceeded || quads.budget_exceeded;
  trace.candidates.insert(trace.candidates.end(), outlines_.rejected.begin(), outlines_.rejected.end());
  admitted_.clear();
  admit(quads.candidates, trace);
  admit(outlines_.candidates, trace);
  keepBest(trace);
  done(timer_, Stage::kCandidates);
  return kept_;
}

const std::vector<ScoredCandidate>& CandidateSearch::open() {
  open_.clear();
  for (const Quadrilateral& quad : segment_quads_.open(*segments_)) {
    ScoredCandidate candidate;
    candidate.found.quad = quad;
    candidate.found.source = CandidateSource::kSegments;
    for (int i = 0; i < 4; ++i) candidate.found.seen[i] = undistortion_.distort(quad[i]);
    if (shapeFault(candidate.found, level_size_, params_.gates)) continue;
    candidate.quad = inFullImage(candidate.found.seen, factor_);
    candidate.score = kOpenScore;
    open_.push_back(candidate);
  }
  return open_;
}

void CandidateSearch::admit(const std::vector<Candidate>& found, DetectionTrace& trace) {
  for (const Candidate& one : found) {
    ScoredCandidate scored;
    scored.found = one;
    Candidate& candidate = scored.found;
    for (int i = 0; i < 4; ++i) candidate.seen[i] = undistortion_.distort(candidate.quad[i]);
    auto rejection = shapeFault(candidate, level_size_, params_.gates);
    if (!rejection) {
      addEdges(measureSides(*map_, undistortion_, candidate.quad), candidate.sides);
      rejection = supportFault(candidate, params_.gates);
    }
    scored.quad = inFullImage(candidate.seen, factor_);
    if (rejection) {
      trace.candidates.push_back(traceOf(scored, rejection->reason, rejection->value, rejection->limit));
      continue;
    }
    scored.score = windowScore(candidate);
    scored.size = sizeRank(candidate.quad, level_size_);
    scored.proposal = scored.rank();
    admitted_.push_back(scored);
  }
}

void CandidateSearch::keepBest(DetectionTrace& trace) {
  sortByRank(admitted_);
  kept_.clear();
  for (const ScoredCandidate& candidate : admitted_) {
    const Sameness same(candidate.found.quad);
    const auto twin = std::find_if(kept_.begin(), kept_.end(), [&](const ScoredCandidate& better) {
      return same.sameQuad(better.found.quad);
    });
    if (twin != kept_.end()) {
      trace.candidates.push_back(
          traceOf(candidate, RejectReason::kDuplicate, candidate.rank(), twin->rank()));
    } else if (static_cast<int>(kept_.size()) >= params_.max_candidates) {
      trace.candidates.push_back(
          traceOf(candidate, RejectReason::kOutscored, candidate.rank(), kept_.back().rank()));
    } else {
      kept_.push_back(candidate);
    }
  }
}

}  // namespace window_ingress::detection
