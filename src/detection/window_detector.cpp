#include "window_ingress/detection/window_detector.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>

#include "window_ingress/detection/border_refinement.hpp"
#include "window_ingress/detection/candidate_search.hpp"
#include "window_ingress/detection/reference_borders.hpp"
#include "window_ingress/detection/reference_shape.hpp"
#include "window_ingress/parameters/fields.hpp"

namespace window_ingress::detection {
namespace {

constexpr int kSmallestSide = 16;  ///< no window can be found in a smaller picture [px]
constexpr int kRefinementTries = 6;
constexpr double kMostCertain = 0.99;  ///< of a score before the reference is asked
constexpr double kSameWindow = 0.22;   ///< loops whose corners differ less, in its size, are of one window
constexpr std::size_t kPlacesLocated = 12;  ///< places at which the reference's borders are looked for
constexpr std::size_t kPlacesFine = 3;      ///< of these the best are looked at closely
constexpr int kVariantsLocated = 2;         ///< loops of one place from which they are looked for
constexpr double kSureWorth = 0.3;  ///< of located borders; then loops about the same place are forgotten
constexpr double kUnlocatedPart =
    0.7;  ///< of its score keeps a loop whose borders are not those of the reference
constexpr double kLocatedRadiusPx = 2.5;  ///< reach of the fit of borders that were located
constexpr double kLocatedSigmaPx = 1.0;   ///< how well they are located
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

// Loops of one window: no corner is further off than a part of its size.
bool isAbout(const geometry::Quadrilateral& a, const geometry::Quadrilateral& b) {
  const double reach = kSameWindow * kSameWindow * std::abs(geometry::signedArea(b));
  for (int i = 0; i < 4; ++i)
    if ((a[i] - b[i]).squaredNorm() > reach) return false;
  return true;
}

// Bayes: a score taken for a probability, but never for certainty, after evidence of these odds.
double updated(double score, double odds) {
  const double prior = std::min(score, kMostCertain);
  return prior * odds / (1.0 - prior + prior * odds);
}

}  // namespace

struct WindowDetector::Impl {
  explicit Impl(const DetectorParams& p)
      : params(p),
        search(p),
        nested(p.nested),
        borders(p.borders),
        shape(p.shape),
        refinement(p.refinement) {}

  void learnReference();
  std::vector<std::size_t> places();
  std::optional<Rival> locate(const cv::Mat& image, const geometry::PinholeCamera* camera, const Rival& rough,
                              const ReferenceBorders::Effort& effort);
  std::vector<Rival> locateAll(const cv::Mat& image, const geometry::PinholeCamera* camera);
  bool judgeAppearance(const cv::Mat& image, const geometry::PinholeCamera* camera);
  void judgeLoops(const cv::Mat& image);
  std::optional<WindowObservation> choose(const cv::Mat& image, double stamp_sec,
                                          const geometry::PinholeCamera* camera);
  std::optional<Rejection> objection(const Rival& rival) const;
  std::optional<Rejection> objectionToShape(const cv::Mat& image, const geometry::PinholeCamera* camera,
                                            const RefinedBorders& fitted);
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
  ReferenceBorders borders;
  ReferenceShape shape;
  BorderRefinement refinement;
  std::shared_ptr<const ReferenceAppearance> reference;
  DetectionTrace trace;
  std::vector<Rival> rivals;
};

void WindowDetector::Impl::learnReference() {
  borders.forget();
  shape.forget();
  if (!reference || !imageFault(reference->picture()).empty()) return;
  borders.learn(reference->picture(), reference->opening());
  shape.learn(reference->picture(), reference->opening());
  if (const auto& aspect = shape.aspect()) borders.setAspect(aspect->value, aspect->sigma / aspect->value);
}

// Of all loops about the same place the likeliest ones; the others are variants of them.
std::vector<std::size_t> WindowDetector::Impl::places() {
  std::vector<std::size_t> leaders;
  for (std::size_t i = 0; i < rivals.size(); ++i) {
    int variants = 0;
    for (std::size_t leader : leaders) variants += isAbout(rivals[i].quad, rivals[leader].quad);
    if (variants < kVariantsLocated) leaders.push_back(i);
    if (leaders.size() == kPlacesLocated) break;
  }
  return leaders;
}

// The rival with its borders where the reference's are, if they are found near it.
std::optional<Rival> WindowDetector::Impl::locate(const cv::Mat& image, const geometry::PinholeCamera* camera,
                                                  const Rival& rough,
                                                  const ReferenceBorders::Effort& effort) {
  const auto found = borders.locate(image, rough.quad, camera, effort);
  if (!found) return std::nullopt;
  Rival rival = rough;
  rival.quad = found->quad;
  rival.candidate.source = CandidateSource::kReference;
  rival.located = true;
  rival.worth = found->worth;
  rival.geometry = rough.located ? rough.geometry : rough.score;
  rival.score = scoreWithReference(rival.geometry, rival.worth, params.score);
  rival.verdict.reject = found->holds_frame ? RejectReason::kOuterBorder : RejectReason::kNone;
  return rival;
}

// The borders of the reference at all places where they are found; the best are looked at closely.
std::vector<Rival> WindowDetector::Impl::locateAll(const cv::Mat& image,
                                                   const geometry::PinholeCamera* camera) {
  std::vector<Rival> located;
  for (std::size_t i : places())
    if (auto rival = locate(image, camera, rivals[i], ReferenceBorders::kCoarse)) located.push_back(*rival);
  sortByRank(located);
  for (std::size_t i = 0; i < std::min(located.size(), kPlacesFine); ++i)
    if (auto rival = locate(image, camera, located[i], ReferenceBorders::kFine)) located[i] = *rival;
  return located;
}

// Compares with the reference; false, and nothing changed, if no colour could be compared.
bool WindowDetector::Impl::judgeAppearance(const cv::Mat& image, const geometry::PinholeCamera* camera) {
  if (!reference || image.channels() != 3) return false;
  std::vector<Rival> compared = borders.known() ? locateAll(image, camera) : rivals;
  bool any = false;
  for (Rival& rival : compared) {
    rival.appearance = reference->compare(image, rival.quad, params.appearance);
    any = any || rival.appearance;
    if (rival.appearance) rival.score = updated(rival.score, rival.appearance->odds);
  }
  if (!any && !borders.known()) return false;
  if (!borders.known()) {
    rivals.swap(compared);
    return true;
  }
  for (Rival& rival : rivals) {
    const bool sure = std::any_of(compared.begin(), compared.end(), [&](const Rival& place) {
      return place.worth > kSureWorth && isAbout(rival.quad, place.quad);
    });
    rival.appearance = sure ? std::nullopt : reference->compare(image, rival.quad, params.appearance);
    if (rival.appearance)
      rival.score = updated(kUnlocatedPart * rival.score, rival.appearance->odds);
    else
      rival.verdict.reject = RejectReason::kDuplicate;
  }
  rivals.insert(rivals.end(), compared.begin(), compared.end());
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
  if (rival.appearance && rival.appearance->distance > rival.appearance->limit)
    return Rejection{RejectReason::kAppearance, rival.appearance->distance, rival.appearance->limit};
  if (rival.verdict.reject != RejectReason::kNone) return Rejection{rival.verdict.reject, rival.rank(), 0.0};
  const double least = rival.appearance ? params.min_score_reference : params.min_score;
  if (rival.score < least) return Rejection{RejectReason::kScore, rival.score, least};
  return std::nullopt;
}

std::optional<Rejection> WindowDetector::Impl::objectionToShape(const cv::Mat& image,
                                                                const geometry::PinholeCamera* camera,
                                                                const RefinedBorders& fitted) {
  if (const auto off = shape.inAspect(fitted.corners, fitted.corner_covariance, camera))
    return Rejection{RejectReason::kOtherAspect, off->value, off->limit};
  if (const auto off = shape.inFrame(image, fitted.corners, camera))
    return Rejection{RejectReason::kOtherFrame, off->value, off->limit};
  return std::nullopt;
}

std::optional<RefinedBorders> WindowDetector::Impl::refine(const Rival& rival, const cv::Mat& image,
                                                           const geometry::PinholeCamera* camera,
                                                           double& inliers) const {
  BorderStart start;
  start.quad = rival.quad;
  start.radius_px = rival.located ? kLocatedRadiusPx : 1.5 * search.factor() + 1.0;
  if (rival.located) start.fallback_sigma_px = kLocatedSigmaPx;
  return refinement.run(image, start, camera, &inliers);
}

WindowObservation WindowDetector::Impl::observe(const Rival& rival, const RefinedBorders& fitted,
                                                double stamp_sec) const {
  WindowObservation window;
  window.stamp_sec = stamp_sec;
  window.corners = fitted.corners;
  window.corner_covariance = fitted.corner_covariance;
  window.edges = fitted.edges;
  window.score = rival.score;
  window.has_appearance = rival.appearance.has_value();
  if (rival.appearance) window.bhattacharyya = rival.appearance->distance;
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
      if (const auto fault = objectionToShape(image, camera, *fitted)) {
        record(rival, fault->reason, fault->value, fault->limit);
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
  // That one is like another candidate, or worse, explains nothing.
  const auto rank = [](const CandidateTrace& c) {
    const bool tells = c.reject != RejectReason::kDuplicate && c.reject != RejectReason::kOutscored;
    return std::make_tuple(tells, c.score, c.reject);
  };
  const CandidateTrace* furthest = nullptr;
  for (const CandidateTrace& c : trace.candidates)
    if (!furthest || rank(c) > rank(*furthest)) furthest = &c;
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
  next->learnReference();
  impl_ = std::move(next);
}

void WindowDetector::setReference(const ReferenceAppearance& reference) {
  shareReference(std::make_shared<ReferenceAppearance>(reference));
}

void WindowDetector::shareReference(std::shared_ptr<const ReferenceAppearance> reference) {
  impl_->reference = std::move(reference);
  impl_->learnReference();
}

void WindowDetector::clearReference() {
  impl_->reference.reset();
  impl_->learnReference();
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
  if (!impl_->judgeAppearance(image, camera)) impl_->judgeLoops(image);
  auto window = impl_->choose(image, stamp_sec, camera);
  if (!window && impl_->borders.known() && impl_->trace.budget_exceeded) {
    impl_->trace = DetectionTrace();
    impl_->rivals = impl_->search.runAgain(impl_->trace);
    impl_->judgeAppearance(image, camera);
    window = impl_->choose(image, stamp_sec, camera);
  }
  if (!window) {
    impl_->rivals = impl_->search.runOnColours(impl_->trace);
    if (!impl_->rivals.empty()) {
      if (!impl_->judgeAppearance(image, camera)) impl_->judgeLoops(image);
      window = impl_->choose(image, stamp_sec, camera);
    }
  }
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
