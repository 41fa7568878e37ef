#include "window_ingress/detection/window_detector.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "window_ingress/detection/candidate_search.hpp"
#include "window_ingress/detection/target_borders.hpp"
#include "window_ingress/parameters/fields.hpp"

namespace window_ingress::detection {
namespace {

constexpr int kSmallestSide = 16;  ///< no window can be found in a smaller picture [px]
constexpr int kRefinementTries = 6;
constexpr double kUnframedScore = 0.75;   ///< of a candidate round which the reference's frame is not seen
constexpr double kLoopTolerancePx = 0.6;  ///< uncertainty of a loop's position on the search level [px]
constexpr double kVariantOverlap =
    0.6;  ///< loops that overlap more, and are not round each other, are one window

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

// One with some sides swapped for those of a neighbouring loop. Loops round each other are not.
bool isVariant(const geometry::Quadrilateral& a, const geometry::Quadrilateral& b, double tolerance_px,
               const NestedLoopsParams& nested) {
  const double size = std::max(std::abs(geometry::signedArea(a)), std::abs(geometry::signedArea(b)));
  if ((geometry::centroid(a) - geometry::centroid(b)).squaredNorm() > size) return false;
  return geometry::intersectionOverUnion(a, b) > kVariantOverlap &&
         !isConcentric(a, b, tolerance_px, nested) && !isConcentric(b, a, tolerance_px, nested);
}

}  // namespace

struct WindowDetector::Impl {
  explicit Impl(const DetectorParams& p) : params(p), search(p), nested(p.nested), borders(p.refinement) {}

  void learnFrame();
  void foretell();
  bool judgeAppearance(const cv::Mat& image);
  void judgeLoops(const cv::Mat& image);
  std::optional<WindowObservation> choose(const cv::Mat& image, double stamp_sec,
                                          const geometry::PinholeCamera* camera);
  std::optional<Rejection> objection(const Rival& rival) const;
  std::optional<RefinedBorders> refine(const Rival& rival, const cv::Mat& image,
                                       const geometry::PinholeCamera* camera, double& inliers) const;
  WindowObservation observe(const Rival& rival, const RefinedBorders& fitted, double stamp_sec) const;
  void record(const Rival& rival, RejectReason reason, double value, double limit) {
    trace.candidates.push_back(traceOf(rival, reason, value, limit));
  }
  void explain();

  DetectorParams params;
  CandidateSearch search;
  NestedLoops nested;
  TargetBorders borders;
  std::optional<ReferenceAppearance> reference;
  std::optional<FrameModel> frame;
  DetectionTrace trace;
  std::vector<Rival> rivals;
};

// The frame in the reference picture, found as windows are found.
void WindowDetector::Impl::learnFrame() {
  frame.reset();
  if (!reference || !imageFault(reference->picture()).empty()) return;
  CandidateSearch own(params);
  DetectionTrace ignored;
  const auto loops = own.run(reference->picture(), nullptr, ignored);
  frame = borders.learn(reference->picture(), reference->opening(), loops, own.factor(), params.nested);
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
    if (geometry::isFinite(inner.quad) && geometry::isConvex(inner.quad)) rivals.push_back(inner);
  }
}

// Compares all with the reference; false, and nothing changed, if no colour could be compared.
bool WindowDetector::Impl::judgeAppearance(const cv::Mat& image) {
  if (!reference || image.channels() != 3) return false;
  const std::size_t seen = rivals.size();
  foretell();
  bool compared = false;
  for (Rival& rival : rivals) {
    rival.distance = reference->distance(image, rival.quad, params.appearance);
    compared = compared || rival.distance;
  }
  if (!compared) {
    rivals.resize(seen);
    return false;
  }
  for (Rival& rival : rivals) {
    if (rival.distance) rival.score = scoreWithReference(rival.score, *rival.distance, params.score);
    if (frame && !rival.outer) rival.score *= kUnframedScore;
  }
  return true;
}

// Without a reference: of the variants of a loop the best, of loops round each other the opening's front.
void WindowDetector::Impl::judgeLoops(const cv::Mat& image) {
  const double tolerance_px = kLoopTolerancePx * search.factor();
  std::vector<Rival*> loops;
  for (Rival& rival : rivals) {
    const auto better = std::find_if(loops.begin(), loops.end(), [&](const Rival* loop) {
      return isVariant(rival.quad, loop->quad, tolerance_px, params.nested);
    });
    if (better == loops.end())
      loops.push_back(&rival);
    else
      rival.verdict.reject = RejectReason::kDuplicate;
  }
  std::vector<geometry::Quadrilateral> quads;
  std::vector<double> ranks;
  for (const Rival* loop : loops) quads.push_back(loop->quad), ranks.push_back(loop->rank());
  const auto verdicts = nested.run(image, quads, ranks, tolerance_px);
  for (std::size_t i = 0; i < loops.size(); ++i) loops[i]->verdict = verdicts[i];
  // A frame is one thing: its inner border is as sure as its outer one.
  for (std::size_t i = 0; i < loops.size(); ++i)
    if (verdicts[i].reject == RejectReason::kOuterBorder) {
      Rival& inner = *loops[verdicts[i].other];
      inner.score = std::max(inner.score, loops[i]->score);
    }
}

std::optional<Rejection> WindowDetector::Impl::objection(const Rival& rival) const {
  if (rival.distance && *rival.distance > params.appearance.max_distance)
    return Rejection{RejectReason::kAppearance, *rival.distance, params.appearance.max_distance};
  if (rival.verdict.reject != RejectReason::kNone) return Rejection{rival.verdict.reject, rival.rank(), 0.0};
  if (rival.score < params.min_score) return Rejection{RejectReason::kScore, rival.score, params.min_score};
  return std::nullopt;
}

std::optional<RefinedBorders> WindowDetector::Impl::refine(const Rival& rival, const cv::Mat& image,
                                                           const geometry::PinholeCamera* camera,
                                                           double& inliers) const {
  return rival.outer ? borders.foretold(image, rival, *frame, search.factor(), camera, &inliers)
                     : borders.seen(image, rival, search.factor(), camera, &inliers);
}

WindowObservation WindowDetector::Impl::observe(const Rival& rival, const RefinedBorders& fitted,
                                                double stamp_sec) const {
  WindowObservation window;
  window.stamp_sec = stamp_sec;
  window.corners = fitted.corners;
  window.corner_covariance = fitted.corner_covariance;
  window.edges = fitted.edges;
  window.score = rival.score;
  window.has_appearance = rival.distance.has_value();
  window.bhattacharyya = rival.distance.value_or(0.0);
  return window;
}

// The best to which there is no objection and whose borders can be fitted.
std::optional<WindowObservation> WindowDetector::Impl::choose(const cv::Mat& image, double stamp_sec,
                                                              const geometry::PinholeCamera* camera) {
  sortByRank(rivals);
  std::optional<WindowObservation> window;
  int tries = 0;
  for (const Rival& rival : rivals) {
    if (const auto fault = objection(rival)) {
      record(rival, fault->reason, fault->value, fault->limit);
    } else if (window) {
      record(rival, RejectReason::kOutscored, rival.score, window->score);
    } else if (++tries > kRefinementTries) {
      record(rival, RejectReason::kBudget, tries, kRefinementTries);
    } else {
      double inliers = 0.0;
      const auto fitted = refine(rival, image, camera, inliers);
      if (!fitted) {
        record(rival, RejectReason::kRefinement, inliers, params.refinement.min_inliers);
        continue;
      }
      window = observe(rival, *fitted, stamp_sec);
      record(rival, RejectReason::kNone, rival.score, params.min_score);
      trace.target = static_cast<int>(trace.candidates.size()) - 1;
      trace.candidates.back().quad = fitted->corners;
    }
  }
  return window;
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
  if (const std::string fault = imageFault(image); !fault.empty()) {
    impl_->trace.outcome = RejectReason::kBadImage;
    impl_->trace.detail = fault;
    return std::nullopt;
  }
  impl_->rivals = impl_->search.run(image, camera, impl_->trace);
  if (!impl_->judgeAppearance(image)) impl_->judgeLoops(image);
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
