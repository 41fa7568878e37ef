#include "detection/reference/reference_judge.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "detection/candidates/candidate_score.hpp"
#include "detection/quad_sameness.hpp"
#include "detection/reference/haze.hpp"

namespace window_ingress::detection {
namespace {

constexpr double kMaxCertain = 0.99;        ///< of a score, before the reference is compared
constexpr std::size_t kPlacesLocated = 12;  ///< places at which the reference's borders are searched
constexpr std::size_t kPlacesFine = 3;      ///< best places, which are searched finely
constexpr int kVariantsLocated = 2;         ///< loops per place from which the search starts
constexpr float kColourOfFrames = 1.75F;    ///< weight of colour where the reference shows a frame
constexpr double kFaithful = 0.75, kFaithfulUncovered = 0.88;  ///< limits round a frame, see RingMatch
constexpr double kFaithfulBehind = 0.9;                    ///< the limit for a covered wall without a frame
constexpr double kSureUncovered = 0.92;                    ///< hardly anything but the target reaches this
constexpr double kNeverSure = 2.0;                         ///< more than any correlation
constexpr double kSureOfWall = 0.68, kSureOfFrame = 0.85;  ///< correlations that suffice without colours
constexpr int kAllBorders = 4;
constexpr int kOpenBorders = 3;            ///< borders whose inside must differ from the outside
constexpr double kMinClearContrast = 0.8;  ///< of a ring without haze, over its correlation
constexpr double kMaxThroughHaze = 0.45;   ///< distance: 0.25 and less in fog, 0.7 for other paint
constexpr double kStepFrom = 0.015, kStepTo = 0.06, kStepReach = 0.08;  ///< from a border [mean sides]
constexpr double kMinStep = 0.12;       ///< relative difference of mean colours; true openings have 0.2 to 1
constexpr double kUnlocatedPart = 0.7;  ///< factor of the score of a loop that lacks the reference's borders

// Bayes: treats the score as a probability below certainty, and applies these odds.
double updated(double score, double odds) {
  const double prior = std::min(score, kMaxCertain);
  return prior * odds / (1.0 - prior + prior * odds);
}

// The likeliest loops at each place; the others are variants of them.
std::vector<const ScoredCandidate*> placesOf(const std::vector<ScoredCandidate>& candidates) {
  std::vector<const ScoredCandidate*> places;
  for (const ScoredCandidate& candidate : candidates) {
    if (places.size() == kPlacesLocated) break;
    const auto variants = std::count_if(places.begin(), places.end(), [&](const ScoredCandidate* place) {
      return Sameness(place->quad).samePlace(candidate.quad);
    });
    if (variants < kVariantsLocated) places.push_back(&candidate);
  }
  return places;
}

}  // namespace

ReferenceJudge::ReferenceJudge(const DetectorParams& params)
    : appearance_(params.appearance), min_correlation_(params.min_correlation) {}

void ReferenceJudge::see(const cv::Mat& image, const geometry::PinholeCamera* camera) {
  image_ = bgr_ = image;
  camera_ = camera;
  compares_ = reference_ && isGrey(image) == is_grey_;
  if (compares_ && image.channels() == 1) {
    cv::cvtColor(image, converted_, cv::COLOR_GRAY2BGR);
    bgr_ = converted_;
  }
  if (knowsSurroundings()) ring_.see(bgr_, camera);
}

void ReferenceJudge::learn(std::shared_ptr<const ReferenceAppearance> reference) {
  reference_ = std::move(reference);
  borders_ = {}, ring_ = {}, shape_ = {};
  beyond_ = {}, open_borders_ = 0;
  frame_colours_.reset();
  is_grey_ = reference_ && isGrey(reference_->image());
  if (!reference_ || !reference_->openingIsKnown()) return;
  const cv::Mat& image = reference_->image();
  const geometry::Quadrilateral& opening = reference_->opening();
  if (!ReferenceAppearance::faultOf(image, opening).empty()) return;
  see(image, nullptr);
  borders_.learn(bgr_, opening);
  shape_.learn(image, opening);
  ring_.learn(bgr_, opening, frameless() ? 1.0F : kColourOfFrames, shape_.aspect(), !frameless());
  open_borders_ = openBorders(opening);
  beyond_ = framesBeyond(bgr_, opening, nullptr, sides_);
  if (!frameless()) frame_colours_ = ringColours(image, opening, 1);
}

// The candidate with its borders moved to the reference's, if they are found near it.
std::optional<ScoredCandidate> ReferenceJudge::locate(const ScoredCandidate& rough,
                                                      const ReferenceBorders::Effort& effort) {
  const auto found = borders_.locate(bgr_, rough.quad, camera_, effort);
  if (!found) return std::nullopt;
  ScoredCandidate candidate = rough;
  candidate.quad = found->quad;
  candidate.found.source = CandidateSource::kReference;
  candidate.proposal = 0.0;
  candidate.located = true;
  candidate.border_score = found->border_score;
  candidate.geometry = rough.located ? rough.geometry : rough.score;
  candidate.score = scoreWithReference(candidate.geometry, candidate.border_score);
  candidate.verdict = RejectReason::kNone;
  return candidate;
}

// Finds the reference's borders at all places, and searches the best ones finely.
std::vector<ScoredCandidate> ReferenceJudge::locateAll(const std::vector<ScoredCandidate>& candidates) {
  std::vector<ScoredCandidate> located;
  for (const ScoredCandidate* place : placesOf(candidates))
    if (auto candidate = locate(*place, ReferenceBorders::kCoarse)) located.push_back(*candidate);
  sortByRank(located);
  for (std::size_t i = 0; i < std::min(located.size(), kPlacesFine); ++i)
    if (auto candidate = locate(located[i], ReferenceBorders::kFine)) located[i] = *candidate;
  return located;
}

// Compares the candidates' frames with the reference's; false if none can be compared.
bool ReferenceJudge::weigh(std::vector<ScoredCandidate>& candidates) const {
  bool any = false;
  for (ScoredCandidate& candidate : candidates) {
    candidate.appearance = reference_->compare(image_, candidate.quad, appearance_);
    any = any || candidate.appearance;
    if (candidate.appearance) candidate.score = updated(candidate.score, candidate.appearance->odds);
  }
  return any;
}

// Lowers the score of loops whose borders were not located. Drops those where borders were surely located.
void ReferenceJudge::weighOthers(const std::vector<ScoredCandidate>& located,
                                 std::vector<ScoredCandidate>& candidates) const {
  for (ScoredCandidate& candidate : candidates) {
    const bool sure = std::any_of(located.begin(), located.end(), [&](const ScoredCandidate& place) {
      return place.border_score > ReferenceBorders::kSureBorderScore &&
             Sameness(place.quad).samePlace(candidate.quad);
    });
    candidate.appearance = sure ? std::nullopt : reference_->compare(image_, candidate.quad, appearance_);
    if (sure)
      candidate.verdict = RejectReason::kDuplicate;
    else
      candidate.score =
          updated(kUnlocatedPart * candidate.score, candidate.appearance ? candidate.appearance->odds : 1.0);
  }
}

std::optional<Eigen::Vector3f> ReferenceJudge::paint() const {
  return frame_colours_ ? frame_colours_->means.paint() : std::nullopt;
}

bool ReferenceJudge::judgeFrames(std::vector<ScoredCandidate>& candidates) {
  if (!compares_) return false;
  if (!borders_.known()) return weigh(candidates);
  auto located = locateAll(candidates);
  weigh(located);
  weighOthers(located, candidates);
  candidates.insert(candidates.end(), located.begin(), located.end());
  return true;
}

bool ReferenceJudge::judgeSurroundings(std::vector<ScoredCandidate>& candidates) {
  if (!knowsSurroundings()) return false;
  auto located = ring_.align(candidates);
  for (ScoredCandidate& candidate : located)
    candidate.appearance = reference_->compare(image_, candidate.quad, appearance_);
  for (ScoredCandidate& candidate : candidates) candidate.verdict = RejectReason::kDuplicate;
  candidates.insert(candidates.end(), located.begin(), located.end());
  return true;
}

// A frame in its own paint is found by that paint. There, leaning places would fit three sides of another
// window.
std::vector<ScoredCandidate> ReferenceJudge::placesEverywhere() {
  if (!knowsSurroundings()) return {};
  return ring_.placesEverywhere(!hasOwnFrame());
}

std::optional<Rejection> ReferenceJudge::objectionTo(const AppearanceMatch& match) const {
  if (match.isLike()) return std::nullopt;
  return Rejection{RejectReason::kAppearance, match.distance, match.limit};
}

// Round a frame, correlation counts only as far as contrasts match the reference; covered parts may be left
// out. All of the ring counts if the frame's colours match, too.
std::optional<Rejection> ReferenceJudge::objectionTo(const RingMatch& match,
                                                     const std::optional<AppearanceMatch>& frame) const {
  const auto below = [this](double value, double least) -> std::optional<Rejection> {
    least = std::max(min_correlation_, least);
    if (value >= least) return std::nullopt;
    return Rejection{RejectReason::kUnlike, value, least};
  };
  if (frameless() && covered_ && match.faithful_uncovered < kFaithfulBehind)
    return below(match.faithful_uncovered, kFaithfulBehind);
  if (frameless()) return below(match.correlation, 0.0);
  if (match.correlation >= sureCorrelation()) return std::nullopt;
  const auto objection = below(match.faithful_uncovered, kFaithfulUncovered);
  return objection && frame && frame->isLike() ? below(match.faithful, kFaithful) : objection;
}

bool ReferenceJudge::hasOwnFrame() const {
  return reference_ && !frameless() && reference_->isDistinct(appearance_);
}

bool ReferenceJudge::frameTells(double border_score) const {
  return !knowsSurroundings() || (hasOwnFrame() && border_score > ReferenceBorders::kSureBorderScore);
}

// A frame's own colours tell the frame from one in another paint, which correlates as well.
double ReferenceJudge::sureCorrelation() const {
  if (frameless()) return kSureOfWall;
  return hasOwnFrame() ? kNeverSure : kSureOfFrame;
}

int ReferenceJudge::bordersNeeded(const RingMatch& match) const {
  if (match.correlation >= sureCorrelation()) return 0;
  if (covered_) return kAllBorders;
  return match.faithful >= kFaithful && match.faithful_uncovered >= kSureUncovered ? 2 : 3;
}

std::optional<Rejection> ReferenceJudge::objectionTo(const AlignedRing& ring,
                                                     const std::optional<AppearanceMatch>& frame) {
  const RingMatch match = ring_.judged(ring.quad);
  const bool is_pale = match.contrast < kMinClearContrast * match.correlation;
  const auto seen = is_pale && frame_colours_ ? ringColours(image_, ring.quad, 1) : std::nullopt;
  if (seen && distanceThroughHaze(frame_colours_->means, seen->means).value_or(1.0) < kMaxThroughHaze)
    return std::nullopt;
  return objectionTo(match, frame);
}

std::optional<AlignedRing> ReferenceJudge::surroundingsOf(const geometry::Quadrilateral& corners,
                                                          double coarsest_px) {
  if (!knowsSurroundings()) return std::nullopt;
  const auto ring = ring_.alignedAt(corners, coarsest_px);
  if (!ring || ring->correlation < min_correlation_) return std::nullopt;
  return ring;
}

std::optional<AlignedRing> ReferenceJudge::uncovered(const geometry::Quadrilateral& corners) {
  return knowsSurroundings() ? ring_.uncovered(corners) : std::nullopt;
}

int ReferenceJudge::openBorders(const geometry::Quadrilateral& corners) {
  measureSides(bgr_, corners, camera_, {kStepReach, kStepReach}, sides_);
  return static_cast<int>(std::count_if(sides_.begin(), sides_.end(), [](const SideProfile& side) {
    Eigen::Vector3f within, without;
    return side.mean(-kStepTo, -kStepFrom, within) && side.mean(kStepFrom, kStepTo, without) &&
           (within - without).norm() > 0.5 * kMinStep * (within + without).norm();
  }));
}

bool ReferenceJudge::frameGoesOn(const geometry::Quadrilateral& corners) {
  if (!knowsBorders() || frameless() || !compares_) return false;
  const FrameEnds here = framesBeyond(bgr_, corners, camera_, sides_);
  for (int side = 0; side < 4; ++side)
    for (int end = 0; end < 2; ++end)
      if (here[side][end] && !beyond_[side][end]) return true;
  return false;
}

bool ReferenceJudge::showsOpening(const geometry::Quadrilateral& corners) {
  return openBorders(corners) >= std::min(kOpenBorders, open_borders_);
}

std::optional<Rejection> ReferenceJudge::objectionTo(const RefinedBorders& fitted) {
  const auto fault = shape_.inAspect(fitted.corners, fitted.corner_covariance, image_.size(), camera_);
  if (fault || (!hasOwnFrame() && knowsSurroundings())) return fault;
  return shape_.inFrame(image_, fitted.corners, camera_);
}

}  // namespace window_ingress::detection
