#include "window_ingress/detection/window_detector.hpp"

#include <algorithm>
#include <utility>

#include "detection/candidates/candidate_search.hpp"
#include "detection/candidates/nested_quads.hpp"
#include "detection/quad_sameness.hpp"
#include "detection/reference/reference_judge.hpp"
#include "detection/target_choice.hpp"
#include "window_ingress/parameters/fields.hpp"

namespace window_ingress::detection {
namespace {

constexpr int kSmallestSide = 16;   ///< no window can be found in a smaller image [px]
constexpr double kSureRing = 0.85;  ///< correlation of surroundings that identifies a window surely

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
  using View = TargetChoice::View;

  explicit Impl(const DetectorParams& params)
      : search(params), reference(params), choice(params, reference, trace) {}

  // Chooses among the candidates that the reference has judged.
  std::optional<WindowObservation> choose(const View& view) {
    done(timer, Stage::kReference);
    auto window = choice.choose(candidates, search.factor(), view);
    are_recorded = true;
    done(timer, Stage::kBorders);
    return window;
  }

  // Candidates that are already in the trace must not be counted there again as proposals of the search.
  void forgetProposals() {
    for (ScoredCandidate& candidate : candidates) candidate.proposal = 0.0;
  }

  // Gathers candidates that are windows by their geometry, and those that may be.
  void gatherAll() {
    candidates = search.kept();
    if (are_recorded) forgetProposals();
    const std::vector<ScoredCandidate> open = search.open();
    candidates.insert(candidates.end(), open.begin(), open.end());
  }

  std::optional<WindowObservation> judgeFrames(const View& view) {
    candidates = search.kept();
    const bool compared = reference.judgeFrames(candidates);
    if (!compared || !reference.knowsBorders()) judgeNestedQuads(view.image, search.factor(), candidates);
    return choose(view);
  }

  // Judges by the frame only: the background of a free-standing gate differs from the reference's.
  std::optional<WindowObservation> judgeFrameAlone(const View& view) {
    candidates = found_first;
    candidates.insert(candidates.end(), search.kept().begin(), search.kept().end());
    forgetProposals();
    if (!reference.judgeFrames(candidates)) return std::nullopt;
    for (ScoredCandidate& candidate : candidates)
      if (!candidate.located || !candidate.appearance) candidate.verdict = RejectReason::kDuplicate;
    return choose(view);
  }

  std::optional<WindowObservation> judgeSurroundings(const View& view) {
    if (!reference.judgeSurroundings(candidates)) return std::nullopt;
    return choose(view);
  }

  // Judges by the frame first, if there is one, because its borders are located best. The surroundings must
  // agree. Unless they do so surely, they are searched, too, and a different window found there wins.
  std::optional<WindowObservation> judge(const View& view) {
    std::optional<WindowObservation> window;
    if (!reference.frameless() || !reference.compares()) window = judgeFrames(view);
    if (!reference.knowsSurroundings()) return window;
    const double agreement = window ? choice.ringThere() : 0.0;
    if (window && agreement == 0.0) choice.takeBack(), window.reset();
    const auto ask_surroundings = [&] {
      const int chosen = trace.target;
      const auto other = judgeSurroundings(view);
      if (!other) return;
      if (window && Sameness(window->corners).samePlace(other->corners))
        choice.chooseAgain(chosen);
      else
        window = other;
    };
    if (agreement < kSureRing) gatherAll(), ask_surroundings();
    if (!window && !everywhere)
      candidates = everywhere.emplace(reference.placesEverywhere()), ask_surroundings();
    return window;
  }

  // Searches once more as if something stood before the window.
  std::optional<WindowObservation> judgeCovered(const View& view) {
    gatherAll();
    if (everywhere) candidates.insert(candidates.end(), everywhere->begin(), everywhere->end());
    const struct Cover {
      explicit Cover(ReferenceJudge& judge) : judge(judge) { judge.setCovered(true); }
      ~Cover() { judge.setCovered(false); }
      ReferenceJudge& judge;
    } cover(reference);
    return judgeSurroundings(view);
  }

  // If a decoy with the frame's paint but another shape was refused, a search for the paint would find it
  // again, less well visible.
  void searchOnColours() {
    const bool has_decoy =
        std::any_of(trace.candidates.begin(), trace.candidates.end(), [](const CandidateTrace& candidate) {
          return candidate.reject == RejectReason::kOtherFrame ||
                 candidate.reject == RejectReason::kOtherAspect;
        });
    found_first = search.kept();
    search.runOnColours(has_decoy ? std::nullopt : reference.paint(), trace);
    are_recorded = false;
  }

  std::optional<WindowObservation> detect(const View& view) {
    trace.clear();
    everywhere.reset();
    trace.detail = imageFault(view.image);
    if (!trace.detail.empty()) {
      trace.outcome = RejectReason::kBadImage;
      return std::nullopt;
    }
    search.run(view.image, view.camera, trace);
    are_recorded = false;
    reference.see(view.image, view.camera);
    auto window = judge(view);
    if (!window) {
      searchOnColours();
      window = judge(view);
    }
    if (!window && !reference.frameless()) window = judgeFrameAlone(view);
    if (!window) window = judgeCovered(view);
    explain(trace);
    return window;
  }

  CandidateSearch search;
  ReferenceJudge reference;
  DetectionTrace trace;
  TargetChoice choice;
  std::vector<ScoredCandidate> found_first, candidates;
  std::optional<std::vector<ScoredCandidate>> everywhere;  ///< in this image, computed on demand
  bool are_recorded = false;                               ///< the search's candidates are in the trace
  StageTimer* timer = nullptr;
};

WindowDetector::WindowDetector(const DetectorParams& params)
    : impl_(std::make_unique<Impl>(parameters::requireInRange(params, "detector"))) {}
WindowDetector::~WindowDetector() = default;

void WindowDetector::setParams(const DetectorParams& params) {
  WindowDetector next(params);
  next.shareReference(impl_->reference.reference());
  next.setTimer(impl_->timer);
  impl_.swap(next.impl_);
}

void WindowDetector::setTimer(StageTimer* timer) {
  impl_->timer = timer;
  impl_->search.setTimer(timer);
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
  return impl_->detect({image, stamp_sec, camera});
}

std::optional<WindowObservation> WindowDetector::passedOver(
    const WindowObservation& better, const std::function<bool(const geometry::Quadrilateral&)>& is_wanted,
    const cv::Mat& image, const geometry::PinholeCamera* camera) const {
  return impl_->choice.passedOver(better, is_wanted, {image, better.stamp_sec, camera});
}

std::optional<RefinedBorders> WindowDetector::bordersNear(const geometry::Quadrilateral& place,
                                                          const cv::Mat& image,
                                                          const geometry::PinholeCamera* camera) const {
  return impl_->choice.bordersNear(place, {image, 0.0, camera});
}

StageTimer* WindowDetector::timer() const { return impl_->timer; }
const DetectionTrace& WindowDetector::trace() const { return impl_->trace; }

ReferenceAppearance referenceFromImage(const cv::Mat& image, const DetectorParams& params) {
  DetectorParams wide = params;
  wide.gates.min_area = std::max(0.2, params.gates.min_area);
  wide.gates.max_area = 1.0;
  WindowDetector detector(wide);
  const auto window = detector.detect(image, 0.0);
  return window ? ReferenceAppearance::guessed(image, window->corners) : ReferenceAppearance(image);
}

}  // namespace window_ingress::detection
