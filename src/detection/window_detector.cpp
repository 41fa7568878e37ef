#include "window_ingress/detection/window_detector.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "window_ingress/detection/frame_model.hpp"
#include "window_ingress/parameters/fields.hpp"

namespace window_ingress::detection {
namespace {

constexpr int kSmallestSide = 16;  ///< no window can be found in a smaller picture [px]
constexpr int kRefinementTries = 6;
constexpr double kRingReach =
    0.2;  ///< how far a frame's border may lie from where it is foretold, in ring widths
constexpr double kUnframedScore = 0.75;  ///< of a candidate round which the reference's frame is not seen
constexpr double kForetoldStrayPx =
    1.0;  ///< a border further from where its frame foretells it is another one [px]
constexpr double kForetoldSigmaPx = 0.3;  ///< how well the frame foretells it [px]
constexpr double kLoopTolerancePx = 0.6;  ///< uncertainty of a loop's position on the search level [px]

void check(const DetectorParams& params) {
  const auto faults = parameters::outOfRange(params);
  if (!faults.empty()) throw std::invalid_argument("detector: " + parameters::joined(faults));
}

std::string imageFault(const cv::Mat& image) {
  if (image.empty()) return "the image is empty";
  if (image.type() != CV_8UC1 && image.type() != CV_8UC3)
    return "type " + std::to_string(image.type()) + " is neither CV_8UC1 nor CV_8UC3";
  if (std::min(image.cols, image.rows) < kSmallestSide)
    return std::to_string(image.cols) + " x " + std::to_string(image.rows) + " is smaller than " +
           std::to_string(kSmallestSide) + " px";
  return {};
}

double ringWidth(const geometry::Quadrilateral& outer, const geometry::Quadrilateral& inner) {
  return 0.5 * (std::sqrt(std::abs(geometry::signedArea(outer))) -
                std::sqrt(std::abs(geometry::signedArea(inner))));
}

geometry::Quadrilateral scaled(const geometry::Quadrilateral& quad, double factor) {
  return {factor * quad[0], factor * quad[1], factor * quad[2], factor * quad[3]};
}

// The same loop, or one with some sides swapped for those of a neighbouring loop. Loops round each other are
// not.
bool isVariant(const geometry::Quadrilateral& a, const geometry::Quadrilateral& b, double tolerance_px,
               const NestedLoopsParams& nested) {
  return geometry::intersectionOverUnion(a, b) > 0.6 && !isConcentric(a, b, tolerance_px, nested) &&
         !isConcentric(b, a, tolerance_px, nested);
}

}  // namespace

struct WindowDetector::Impl {
  /// A candidate that passed the gates on single candidates.
  struct Rival {
    Candidate candidate;
    geometry::Quadrilateral quad;  ///< pixels of the image as it came
    double score = 0.0;            ///< confidence, whatever its size
    double size = 1.0;             ///< preference for its size
    LoopVerdict verdict;
    std::optional<double> distance;
    std::optional<geometry::Quadrilateral> outer;  ///< border of the frame that foretells this one

    double rank() const { return score * size; }
  };

  explicit Impl(const DetectorParams& p)
      : params(p),
        preprocess(p.preprocess),
        edges(p.edges),
        lines(p.lines),
        closing(p.closing),
        contours(p.contours),
        segment_quads(p.segment_quads),
        gates(p.gates),
        nested(p.nested),
        refinement(p.refinement) {}

  void search(const cv::Mat& image);
  void admit(std::vector<Candidate>& found, const EdgeMap& map);
  void keepBest();
  void judgeLoops(const cv::Mat& image);
  void foretell();
  void learnFrame();
  std::optional<RefinedBorders> refine(const Rival& rival, const cv::Mat& image,
                                       const geometry::PinholeCamera* camera, double& inliers) const;
  void judgeAppearance(const cv::Mat& image);
  std::optional<WindowObservation> choose(const cv::Mat& image, double stamp_sec,
                                          const geometry::PinholeCamera* camera);
  void record(const Candidate& candidate, const Rejection& rejection);
  CandidateTrace& record(const Rival& rival, RejectReason reason, double value, double limit);
  WindowObservation observe(const Rival& rival, const RefinedBorders& borders, double stamp_sec) const;
  void explain();

  DetectorParams params;
  Preprocess preprocess;
  EdgeDetector edges;
  LineSupport lines;
  Closing closing;
  ContourPolygons contours;
  SegmentQuads segment_quads;
  CandidateGates gates;
  NestedLoops nested;
  BorderRefinement refinement;
  std::optional<ReferenceAppearance> reference;
  std::optional<FrameModel> frame;
  DetectionTrace trace;
  std::vector<Rival> rivals;
  int factor = 1;
  cv::Size level_size;
};

void WindowDetector::Impl::record(const Candidate& candidate, const Rejection& rejection) {
  trace.candidates.push_back({scaled(candidate.quad, factor), candidate.source, rejection.reason,
                              rejection.value, rejection.limit, 0.0, false, 0.0});
}

CandidateTrace& WindowDetector::Impl::record(const Rival& rival, RejectReason reason, double value,
                                             double limit) {
  trace.candidates.push_back({rival.quad, rival.candidate.source, reason, value, limit, rival.score,
                              rival.distance.has_value(), rival.distance.value_or(0.0)});
  return trace.candidates.back();
}

void WindowDetector::Impl::search(const cv::Mat& image) {
  const SearchLevel level = preprocess.run(image);
  factor = level.factor;
  level_size = level.image.size();
  const EdgeMap& map = edges.run(level.image);
  const std::vector<Segment> segments = lines.run(map);
  ContourPolygons::Result outlines = contours.run(closing.run(map.edges), closing.radiusPx(level_size));
  SegmentQuads::Result quads = segment_quads.run(segments, params.gates.min_area * level_size.area());
  trace.segments = static_cast<int>(segments.size());
  trace.contours = outlines.contours;
  trace.budget_exceeded = outlines.budget_exceeded || quads.budget_exceeded;
  for (CandidateTrace& rejected : outlines.rejected) {
    rejected.quad = scaled(rejected.quad, factor);
    trace.candidates.push_back(rejected);
  }
  admit(quads.candidates, map);
  admit(outlines.candidates, map);
}

void WindowDetector::Impl::admit(std::vector<Candidate>& found, const EdgeMap& map) {
  for (Candidate& candidate : found) {
    auto rejection = gates.shape(candidate, level_size);
    if (!rejection) {
      candidate.sides = measureSides(map, candidate.quad, params.side_support);
      rejection = gates.support(candidate);
    }
    if (rejection)
      record(candidate, *rejection);
    else
      rivals.push_back({candidate,
                        scaled(candidate.quad, factor),
                        windowScore(candidate, params.score),
                        sizeRank(candidate.quad, level_size, params.score),
                        {},
                        {},
                        {}});
  }
}

// Best first, each loop once, no more than the budget.
void WindowDetector::Impl::keepBest() {
  std::stable_sort(rivals.begin(), rivals.end(),
                   [](const Rival& a, const Rival& b) { return a.rank() > b.rank(); });
  std::vector<Rival> kept;
  for (const Rival& rival : rivals) {
    const auto twin = std::find_if(kept.begin(), kept.end(), [&](const Rival& better) {
      return isVariant(rival.candidate.quad, better.candidate.quad, kLoopTolerancePx, params.nested);
    });
    if (twin != kept.end())
      record(rival, RejectReason::kDuplicate, rival.score, twin->score);
    else if (static_cast<int>(kept.size()) >= params.max_candidates)
      record(rival, RejectReason::kOutscored, rival.score, kept.back().score);
    else
      kept.push_back(rival);
  }
  rivals.swap(kept);
}

void WindowDetector::Impl::judgeLoops(const cv::Mat& image) {
  std::vector<geometry::Quadrilateral> quads;
  std::vector<double> scores;
  for (const Rival& rival : rivals) quads.push_back(rival.quad), scores.push_back(rival.rank());
  const auto verdicts = nested.run(image, quads, scores, kLoopTolerancePx * factor);
  for (std::size_t i = 0; i < rivals.size(); ++i) rivals[i].verdict = verdicts[i];
}

// The borders that the frames' outer borders foretell, where the reference shows a frame.
void WindowDetector::Impl::foretell() {
  if (!frame) return;
  const std::size_t seen = rivals.size();
  for (std::size_t i = 0; i < seen; ++i) {
    Rival inner = rivals[i];
    inner.outer = rivals[i].quad;
    inner.quad = frame->inner(rivals[i].quad);
    inner.candidate.source = CandidateSource::kFrame;
    inner.verdict = {RejectReason::kNone, -1, true};
    if (geometry::isFinite(inner.quad) && geometry::isConvex(inner.quad)) rivals.push_back(inner);
  }
}

void WindowDetector::Impl::judgeAppearance(const cv::Mat& image) {
  if (!reference) return;
  for (Rival& rival : rivals) {
    rival.distance = reference->distance(image, rival.quad, params.appearance);
    if (rival.distance) rival.score *= 1.0 - *rival.distance;
    if (frame && !rival.outer) rival.score *= kUnframedScore;
  }
}

WindowObservation WindowDetector::Impl::observe(const Rival& rival, const RefinedBorders& borders,
                                                double stamp_sec) const {
  WindowObservation window;
  window.stamp_sec = stamp_sec;
  window.corners = borders.corners;
  window.corner_covariance = borders.corner_covariance;
  window.edges = borders.edges;
  window.score = rival.score;
  window.has_appearance = rival.distance.has_value();
  window.bhattacharyya = rival.distance.value_or(0.0);
  return window;
}

std::optional<WindowObservation> WindowDetector::Impl::choose(const cv::Mat& image, double stamp_sec,
                                                              const geometry::PinholeCamera* camera) {
  std::stable_sort(rivals.begin(), rivals.end(),
                   [](const Rival& a, const Rival& b) { return a.rank() > b.rank(); });
  std::optional<WindowObservation> window;
  int tries = 0;
  for (const Rival& rival : rivals) {
    const bool matched = rival.distance && *rival.distance <= params.appearance.max_distance;
    if (rival.distance && !matched) {
      record(rival, RejectReason::kAppearance, *rival.distance, params.appearance.max_distance);
    } else if (rival.verdict.reject != RejectReason::kNone && !matched) {
      record(rival, rival.verdict.reject, 0.0, 0.0);
    } else if (window) {
      record(rival, RejectReason::kOutscored, rival.score, window->score);
    } else if (rival.score < params.min_score) {
      record(rival, RejectReason::kScore, rival.score, params.min_score);
    } else if (tries >= kRefinementTries) {
      record(rival, RejectReason::kBudget, tries + 1, kRefinementTries);
    } else {
      ++tries;
      double inliers = 0.0;
      const auto borders = refine(rival, image, camera, inliers);
      if (!borders) {
        record(rival, RejectReason::kRefinement, inliers, params.refinement.min_inliers);
        continue;
      }
      window = observe(rival, *borders, stamp_sec);
      record(rival, RejectReason::kNone, rival.score, params.min_score).quad = borders->corners;
      trace.target = static_cast<int>(trace.candidates.size()) - 1;
    }
  }
  return window;
}

std::optional<RefinedBorders> WindowDetector::Impl::refine(const Rival& rival, const cv::Mat& image,
                                                           const geometry::PinholeCamera* camera,
                                                           double& inliers) const {
  const double radius_px = 1.5 * factor + 1.0;
  if (!rival.outer) return refinement.run(image, {rival.quad, radius_px}, camera, &inliers);
  const auto rough = refinement.run(image, {*rival.outer, radius_px}, camera, &inliers);
  if (!rough) return std::nullopt;
  const double reach_px = std::max(2.0, kRingReach * ringWidth(rough->corners, frame->inner(rough->corners)));
  const auto outer = refinement.run(
      image, {rough->corners, reach_px, EdgeChoice::kFirstOutward, kForetoldSigmaPx, 3.0}, camera, &inliers);
  if (!outer) return std::nullopt;
  const double stray_px = std::max(kForetoldStrayPx, 0.5 * reach_px);
  return refinement.run(
      image, {frame->inner(outer->corners), reach_px, EdgeChoice::kFirstInward, kForetoldSigmaPx, stray_px},
      camera, &inliers);
}

// The frame in the reference picture, found as windows are found.
void WindowDetector::Impl::learnFrame() {
  frame.reset();
  if (!reference || !imageFault(reference->picture()).empty()) return;
  Impl own(params);
  own.search(reference->picture());
  own.keepBest();
  std::vector<geometry::Quadrilateral> loops;
  for (const Rival& rival : own.rivals) {
    double inliers = 0.0;
    const auto fine = own.refine(rival, reference->picture(), nullptr, inliers);
    if (fine) loops.push_back(fine->corners);
  }
  frame = findFrame(reference->picture(), reference->opening(), loops, params.nested);
  if (!frame) return;
  const geometry::Quadrilateral& outer = frame->outer;
  const double reach_px = std::max(2.0, kRingReach * ringWidth(outer, reference->opening()));
  const auto fine = refinement.run(
      reference->picture(), {outer, reach_px, EdgeChoice::kFirstOutward, kForetoldSigmaPx, 3.0}, nullptr);
  if (fine) frame = FrameModel(fine->corners, reference->opening());
}

// Without a target: the reason of the candidate that came furthest.
void WindowDetector::Impl::explain() {
  if (trace.target >= 0) {
    trace.outcome = RejectReason::kNone;
    return;
  }
  const CandidateTrace* furthest = nullptr;
  for (const CandidateTrace& c : trace.candidates)
    if (!furthest || c.score > furthest->score || (c.score == furthest->score && c.reject > furthest->reject))
      furthest = &c;
  if (!furthest) {
    trace.detail =
        std::to_string(trace.contours) + " contours, " + std::to_string(trace.segments) + " segments";
    return;
  }
  trace.outcome = furthest->reject;
  trace.detail = describe(*furthest);
}

WindowDetector::WindowDetector(const DetectorParams& params) {
  check(params);
  impl_ = std::make_unique<Impl>(params);
}

WindowDetector::~WindowDetector() = default;

void WindowDetector::setParams(const DetectorParams& params) {
  check(params);
  auto next = std::make_unique<Impl>(params);
  next->reference = impl_->reference;
  next->learnFrame();
  impl_ = std::move(next);
}

void WindowDetector::setReference(const ReferenceAppearance& reference) {
  impl_->reference = reference;
  impl_->learnFrame();
}

void WindowDetector::clearReference() {
  impl_->reference.reset();
  impl_->frame.reset();
}

std::optional<WindowObservation> WindowDetector::detect(const cv::Mat& image, double stamp_sec,
                                                        const geometry::PinholeCamera* camera) {
  impl_->trace = DetectionTrace();
  impl_->rivals.clear();
  if (const std::string fault = imageFault(image); !fault.empty()) {
    impl_->trace.outcome = RejectReason::kBadImage;
    impl_->trace.detail = fault;
    return std::nullopt;
  }
  impl_->search(image);
  impl_->keepBest();
  impl_->judgeLoops(image);
  impl_->foretell();
  impl_->judgeAppearance(image);
  const auto window = impl_->choose(image, stamp_sec, camera);
  impl_->explain();
  return window;
}

const DetectionTrace& WindowDetector::trace() const { return impl_->trace; }

ReferenceAppearance referenceFromPicture(const cv::Mat& picture, const DetectorParams& params) {
  DetectorParams wide = params;
  wide.gates.min_area = std::max(0.2, params.gates.min_area);
  wide.gates.max_area = 1.0;
  WindowDetector detector(wide);
  const auto window = detector.detect(picture, 0.0);
  return window ? ReferenceAppearance(picture, window->corners) : ReferenceAppearance(picture);
}

}  // namespace window_ingress::detection
