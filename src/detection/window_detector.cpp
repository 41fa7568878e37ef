#include "window_ingress/detection/window_detector.hpp"

#include <algorithm>
#include <stdexcept>

#include "detection/candidates/candidate_search.hpp"
#include "detection/candidates/nested_quads.hpp"
#include "detection/quads.hpp"
#include "detection/reference/reference_judge.hpp"
#include "window_ingress/detection/border_refinement.hpp"
#include "window_ingress/parameters/fields.hpp"

namespace window_ingress::detection {
namespace {

constexpr int kSmallestSide = 16;  ///< no window can be found in a smaller image [px]
constexpr int kRefinementTries = 6;
constexpr double kLocatedRadiusPx = 2.5;  ///< reach of the fit of borders that were located
constexpr double kLocatedSigmaPx = 1.0;   ///< how well they are located
constexpr int kFewestSeen =
    3;  ///< borders that show where the surroundings were aligned: a wall may be closed there
constexpr double kAlignedShiftPx = 0.8;  ///< and from where the wall round a hole was aligned, to count
constexpr double kAlignedStray = 0.025;  ///< as `kAlignedStrayPx`, of borders found by the frame [mean sides]

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

}  // namespace

struct WindowDetector::Impl {
  explicit Impl(const DetectorParams& p) : params(p), search(p), reference(p) {}

  std::optional<WindowObservation> judge(const cv::Mat& image, double stamp_sec,
                                         const geometry::PinholeCamera* camera);
  std::optional<WindowObservation> judgeFrames(const cv::Mat& image, double stamp_sec,
                                               const geometry::PinholeCamera* camera);
  void searchOnColours();
  std::optional<WindowObservation> judgeSurroundings(const cv::Mat& image, double stamp_sec,
                                                     const geometry::PinholeCamera* camera);
  std::optional<WindowObservation> choose(const cv::Mat& image, double stamp_sec,
                                          const geometry::PinholeCamera* camera);
  std::optional<Rejection> objection(const ScoredCandidate& rival) const;
  std::optional<RefinedBorders> refine(const ScoredCandidate& rival, const cv::Mat& image,
                                       const geometry::PinholeCamera* camera, double& inliers) const;
  bool showsOpening(const RefinedBorders& fitted, const cv::Mat& image,
                    const geometry::PinholeCamera* camera);
  std::optional<Rejection> judgeSurroundingsOf(const ScoredCandidate& rival, const cv::Mat& image,
                                               const geometry::PinholeCamera* camera, RefinedBorders& fitted);
  double leastScore(const ScoredCandidate& rival) const;
  double runnerUp(const ScoredCandidate& target) const;
  void record(const ScoredCandidate& rival, RejectReason reason, double value, double limit) {
    trace.candidates.push_back(traceOf(rival, reason, value, limit));
  }

  DetectorParams params;
  CandidateSearch search;
  ReferenceJudge reference;
  BorderRefinement refinement;
  DetectionTrace trace;
  std::vector<ScoredCandidate> rivals;
  StageTimer* watch = nullptr;
};

double WindowDetector::Impl::leastScore(const ScoredCandidate& rival) const {
  if (rival.correlation) return params.min_correlation;
  return rival.appearance ? params.min_score_reference : params.min_score;
}

std::optional<Rejection> WindowDetector::Impl::objection(const ScoredCandidate& rival) const {
  if (rival.correlation && rival.located) return reference.objectionTo(rival.match);
  if (rival.appearance)
    if (const auto refused = reference.objectionTo(*rival.appearance)) return refused;
  if (rival.verdict.reject != RejectReason::kNone) return Rejection{rival.verdict.reject, rival.rank(), 0.0};
  if (const double least = leastScore(rival); rival.score < least)
    return Rejection{RejectReason::kScore, rival.score, least};
  return std::nullopt;
}

std::optional<RefinedBorders> WindowDetector::Impl::refine(const ScoredCandidate& rival, const cv::Mat& image,
                                                           const geometry::PinholeCamera* camera,
                                                           double& inliers) const {
  BorderStart start;
  start.quad = rival.quad;
  start.radius_px = rival.located ? kLocatedRadiusPx : 1.5 * search.factor() + 1.0;
  if (rival.located) start.fallback_sigma_px = kLocatedSigmaPx;
  if (!rival.correlation) return refinement.run(image, start, camera, &inliers);
  start.max_stray_px = kAlignedStrayPx;
  if (reference.frameless()) start.max_shift_px = kAlignedShiftPx;
  return refinement.run(image, start, camera, &inliers);
}

// Correlation of the next best place.
double WindowDetector::Impl::runnerUp(const ScoredCandidate& target) const {
  const Sameness same(target.quad);
  double best = 0.0;
  for (const ScoredCandidate& other : rivals)
    if (other.located && !same.sameWindow(other.quad)) best = std::max(best, other.correlation.value_or(0.0));
  return best;
}

// The surroundings alone fit where a wall was closed, too.
bool WindowDetector::Impl::showsOpening(const RefinedBorders& fitted, const cv::Mat& image,
                                        const geometry::PinholeCamera* camera) {
  return fitted.seen >= kFewestSeen &&
         (!reference.frameless() || reference.showsOpening(image, fitted.corners, camera));
}

// Borders that do not lie where the surroundings fit are those of something before them: fitted anew there.
// Without a camera nothing keeps the surroundings from shearing, and the borders are left.
std::optional<Rejection> WindowDetector::Impl::judgeSurroundingsOf(const ScoredCandidate& rival,
                                                                   const cv::Mat& image,
                                                                   const geometry::PinholeCamera* camera,
                                                                   RefinedBorders& fitted) {
  const auto ring = reference.surroundingsOf(fitted.corners, image, camera);
  if (!ring) return std::nullopt;
  if (auto fault = reference.objectionTo(ring->match)) return fault;
  const double stray_px = std::max(kAlignedStrayPx, kAlignedStray * meanSide(ring->quad));
  if (!camera || furthestCorner(ring->quad, fitted.corners) <= stray_px) return std::nullopt;
  ScoredCandidate aligned = rival;
  aligned.quad = ring->quad;
  aligned.located = true;
  aligned.correlation = ring->match.correlation;
  double inliers = 0.0;
  if (const auto anew = refine(aligned, image, camera, inliers)) fitted = *anew;
  return std::nullopt;
}

// The best to which there is no objection and whose borders can be fitted.
std::optional<WindowObservation> WindowDetector::Impl::choose(const cv::Mat& image, double stamp_sec,
                                                              const geometry::PinholeCamera* camera) {
  sortByRank(rivals);
  std::optional<WindowObservation> window;
  int tries = 0;
  for (const ScoredCandidate& rival : rivals) {
    if (const auto fault = objection(rival)) {
      record(rival, fault->reason, fault->value, fault->limit);
    } else if (window) {
      record(rival, RejectReason::kOutscored, rival.score, window->score);
    } else if (++tries > kRefinementTries) {
      record(rival, RejectReason::kBudget, tries, kRefinementTries);
    } else {
      double inliers = 0.0;
      auto fitted = refine(rival, image, camera, inliers);
      if (!fitted) {
        record(rival, RejectReason::kRefinement, inliers, BorderRefinement::kMinInliers);
        continue;
      }
      if (rival.correlation && !showsOpening(*fitted, image, camera)) {
        record(rival, RejectReason::kRefinement, inliers, BorderRefinement::kMinInliers);
        continue;
      }
      auto fault = rival.correlation ? std::nullopt : judgeSurroundingsOf(rival, image, camera, *fitted);
      if (!fault) fault = reference.objectionTo(*fitted, image, camera);
      if (fault) {
        record(rival, fault->reason, fault->value, fault->limit);
        continue;
      }
      record(rival, RejectReason::kNone, rival.score, leastScore(rival));
      window = observationOf(trace.candidates.back(), *fitted, stamp_sec);
      window->runner_up = runnerUp(rival);
      trace.target = static_cast<int>(trace.candidates.size()) - 1;
      trace.candidates.back().quad = fitted->corners;
    }
  }
  return window;
}

std::optional<WindowObservation> WindowDetector::Impl::judgeFrames(const cv::Mat& image, double stamp_sec,
                                                                   const geometry::PinholeCamera* camera) {
  rivals = search.kept();
  const bool compared = reference.judgeFrames(image, camera, rivals);
  if (!compared || !reference.knowsBorders()) judgeNestedQuads(image, search.factor(), rivals);
  done(watch, Stage::kReference);
  return choose(image, stamp_sec, camera);
}

std::optional<WindowObservation> WindowDetector::Impl::judgeSurroundings(
    const cv::Mat& image, double stamp_sec, const geometry::PinholeCamera* camera) {
  rivals = search.kept();
  rivals.insert(rivals.end(), search.doubtful().begin(), search.doubtful().end());
  const auto& open = search.open();
  rivals.insert(rivals.end(), open.begin(), open.end());
  if (!reference.judgeSurroundings(image, camera, rivals)) return std::nullopt;
  done(watch, Stage::kReference);
  return choose(image, stamp_sec, camera);
}

// By the frame, where there is one; what that does not find, by all that lies round the opening.
std::optional<WindowObservation> WindowDetector::Impl::judge(const cv::Mat& image, double stamp_sec,
                                                             const geometry::PinholeCamera* camera) {
  std::optional<WindowObservation> window;
  if (!reference.frameless() || !reference.compares(image)) window = judgeFrames(image, stamp_sec, camera);
  if (!window) window = judgeSurroundings(image, stamp_sec, camera);
  done(watch, Stage::kBorders);
  return window;
}

// What has the paint of the reference's frame and another shape has been seen and refused: to look for that
// paint would bring it again, less well seen.
void WindowDetector::Impl::searchOnColours() {
  const bool has_decoy =
      std::any_of(trace.candidates.begin(), trace.candidates.end(), [](const CandidateTrace& candidate) {
        return candidate.reject == RejectReason::kOtherFrame ||
               candidate.reject == RejectReason::kOtherAspect;
      });
  const auto paint = reference.paint();
  if (paint && !has_decoy)
    search.runOnPaint(*paint, trace);
  else
    search.runOnColours(trace);
}

WindowDetector::WindowDetector(const DetectorParams& params) {
  check(params);
  impl_ = std::make_unique<Impl>(params);
}

WindowDetector::~WindowDetector() = default;

void WindowDetector::setParams(const DetectorParams& params) {
  check(params);
  auto next = std::make_unique<Impl>(params);
  next->reference.learn(impl_->reference.reference());
  StageTimer* const watch = impl_->watch;
  impl_ = std::move(next);
  setWatch(watch);
}

void WindowDetector::setWatch(StageTimer* watch) {
  impl_->watch = watch;
  impl_->search.setWatch(watch);
}

void WindowDetector::setReference(const ReferenceAppearance& reference) {
  shareReference(std::make_shared<ReferenceAppearance>(reference));
}

void WindowDetector::shareReference(std::shared_ptr<const ReferenceAppearance> reference) {
  impl_->reference.learn(std::move(reference));
}

void WindowDetector::clearReference() { impl_->reference.learn(nullptr); }

std::optional<WindowObservation> WindowDetector::detect(const cv::Mat& image, double stamp_sec,
                                                        const geometry::PinholeCamera* camera) {
  impl_->trace.clear();
  if (const std::string fault = imageFault(image); !fault.empty()) {
    impl_->trace.outcome = RejectReason::kBadImage;
    impl_->trace.detail = fault;
    return std::nullopt;
  }
  impl_->search.run(image, camera, impl_->trace);
  auto window = impl_->judge(image, stamp_sec, camera);
  if (!window && impl_->reference.frameless() && impl_->trace.budget_exceeded) {
    impl_->trace.clear();
    impl_->search.runAgain(impl_->trace);
    window = impl_->judge(image, stamp_sec, camera);
  }
  if (!window) {
    impl_->searchOnColours();
    window = impl_->judge(image, stamp_sec, camera);
  }
  explain(impl_->trace);
  return window;
}

StageTimer* WindowDetector::watch() const { return impl_->watch; }

const DetectionTrace& WindowDetector::trace() const { return impl_->trace; }

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

ReferenceAppearance referenceFromImage(const cv::Mat& image, const DetectorParams& params) {
  DetectorParams wide = params;
  wide.gates.min_area = std::max(0.2, params.gates.min_area);
  wide.gates.max_area = 1.0;
  WindowDetector detector(wide);
  const auto window = detector.detect(image, 0.0);
  return window ? ReferenceAppearance::guessed(image, window->corners) : ReferenceAppearance(image);
}

}  // namespace window_ingress::detection
