#include "detection/tracking/edge_tracker.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "detection/borders/edge_profiles.hpp"
#include "detection/quads.hpp"

namespace window_ingress::detection {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3f;

constexpr int kProfiles = 18;           ///< across each side to find the border again
constexpr int kFineProfiles = 40;       ///< across each side to fit its line
constexpr double kMinSimilarity = 0.5;  ///< correlation of a side's profile with the remembered one, 0 to 1
constexpr double kMinInliers = 0.4;     ///< part of a side's profiles that must lie on its line
constexpr double kMinStretch =
    0.06;  ///< shortest part of a side in the image that is a border [longer image sides]
constexpr int kViewSteps = 64;

bool isInView(const Vector2d& p, const cv::Size& image, double margin) {
  return p.x() >= margin && p.y() >= margin && p.x() <= image.width - 1 - margin &&
         p.y() <= image.height - 1 - margin;
}

// Part of the stretch between two parallels to an axis.
bool clip(double from, double span, double low, double high, double& begin, double& end) {
  if (std::abs(span) < 1e-12) return from >= low && from <= high;
  const double a = (low - from) / span, b = (high - from) / span;
  begin = std::max(begin, std::min(a, b));
  end = std::min(end, std::max(a, b));
  return begin < end;
}

// Far outside the image a lens model folds back into it.
double largestRadius(const cv::Size& image, const geometry::PinholeCamera& lens) {
  double radius = 0.0;
  for (const Vector2d& corner : {Vector2d(0, 0), Vector2d(image.width - 1, 0), Vector2d(0, image.height - 1),
                                 Vector2d(image.width - 1, image.height - 1)})
    radius = std::max(radius, (lens.undistort(corner) - Vector2d(lens.cx, lens.cy)).norm());
  return radius;
}

std::optional<Stretch> throughLens(const Stretch& whole, const cv::Size& image, double margin,
                                   const geometry::PinholeCamera& lens) {
  const double radius = largestRadius(image, lens);
  const Vector2d step = (whole.to - whole.from) / kViewSteps;
  int best = 0, best_end = -1, run = 0;
  for (int i = 0; i <= kViewSteps; ++i) {
    const Vector2d p = whole.from + i * step;
    const bool seen =
        (p - Vector2d(lens.cx, lens.cy)).norm() <= radius && isInView(lens.distort(p), image, margin);
    run = seen ? run + 1 : 0;
    if (run > best) best = run, best_end = i;
  }
  if (best < 2) return std::nullopt;
  return Stretch{whole.from + (best_end - best + 1) * step, whole.from + best_end * step};
}

constexpr int kNextTo = 2;              // offset of the colour next to a border, clear of its blur [px]
constexpr float kMinEdgeChange = 6.0f;  // of colour that is an edge, over all channels [grey levels]
constexpr float kAlikePart = 0.4f;      // of the change across an edge: colours nearer than this are the same
constexpr float kAdaption = 0.05f;      // of the colour outside, an image
constexpr float kRisesAgain = 1.4f;     // an edge is so much steeper than what lies before it
constexpr int kTimes = 3;

Vector3f profileColour(const float* mean, int channels, int half, int offset) {
  Vector3f colour = Vector3f::Zero();
  for (int c = 0; c < channels; ++c) colour[c] = mean[c * (2 * half + 1) + half + offset];
  return colour;
}

constexpr double kNominalSidePx = 640.0;  // longer side of an image at which pixel parameters hold
constexpr double kViewMarginPx = 3.0;     // of a side from the border of the image
constexpr double kMaxOfASide = 0.8;       // of a short side must be in the image
constexpr double kReachSigmas = 3.0;
constexpr double kMinReachPx = 2.5;
constexpr double kLearningRate = 0.15;  // an image
constexpr double kPriorPx = 1.0;        // of the border beside stronger edges
constexpr double kRoughPx = 0.7;        // of the first fit
constexpr double kFrontReachPx = 3.2;   // of the front edge of a reveal from what was fitted
constexpr int kLookEvery = 6;           // images, for a reveal beside the border
constexpr int kMinFollowed = 6;

int longerSide(const cv::Mat& image) { return std::max(image.cols, image.rows); }

double scaleOf(const cv::Mat& image) { return std::max(1.0, longerSide(image) / kNominalSidePx); }

}  // namespace

std::optional<Stretch> stretchInView(const Stretch& whole, const cv::Size& image, double margin_px,
                                     const geometry::PinholeCamera* lens) {
  const Vector2d span = whole.to - whole.from;
  if (!whole.from.allFinite() || !whole.to.allFinite() || !(span.squaredNorm() > 0.0)) return std::nullopt;
  if (lens) return throughLens(whole, image, margin_px, *lens);
  double begin = 0.0, end = 1.0;
  if (!clip(whole.from.x(), span.x(), margin_px, image.width - 1 - margin_px, begin, end) ||
      !clip(whole.from.y(), span.y(), margin_px, image.height - 1 - margin_px, begin, end))
    return std::nullopt;
  return Stretch{whole.from + begin * span, whole.from + end * span};
}

// Outwards from the border: other colours, then an edge, then the remembered one.
std::optional<int> FrontBorder::partedAt(const float* mean, int channels, int half) const {
  const auto strangeness = [&](int o) { return (profileColour(mean, channels, half, o) - outside_).norm(); };
  const float change = strangeness(1);
  if (change < kMinEdgeChange || strangeness(kNextTo) < kAlikePart * change) return std::nullopt;
  int reached = kNextTo + 1;
  while (reached <= half && strangeness(reached) >= kAlikePart * change) ++reached;
  if (reached >= half) return std::nullopt;
  // A wide blur ends gently, an edge of its own rises again.
  float least = std::numeric_limits<float>::infinity(), steepest = 0.0f;
  int best = 0;
  for (int o = 1; o <= reached; ++o) {
    const float fall = strangeness(o - 1) - strangeness(o + 1);
    if (o >= kNextTo && fall > kRisesAgain * std::max(0.0f, least) && fall > steepest)
      steepest = fall, best = o;
    least = std::min(least, fall);
  }
  if (best == 0) return std::nullopt;
  return best;
}

// The light changes; reveals do not become frames.
Vector3f FrontBorder::likest(const float* mean, int channels, int half) const {
  Vector3f likest = outside_;
  float least = std::numeric_limits<float>::infinity();
  for (int o = kNextTo; o <= half; ++o) {
    const Vector3f colour = profileColour(mean, channels, half, o);
    const float distance = (colour - outside_).norm();
    if (distance < least) least = distance, likest = colour;
  }
  return likest;
}

std::optional<double> FrontBorder::look(const EdgeProfiles& profiles, const OffsetLine& border, int half_px) {
  const int half = std::min(half_px, kHalf), channels = profiles.channels();
  std::array<float, 3 * (2 * kHalf + 1)> mean;
  if (half <= kNextTo || profiles.meanAlong(border, half, mean.data()) == 0) return std::nullopt;
  const Vector3f next = profileColour(mean.data(), channels, half, kNextTo);
  if (!known_) {
    outside_ = next;
    known_ = true;
    parted_ = 0;
    return std::nullopt;
  }
  const auto at = partedAt(mean.data(), channels, half);
  parted_ = at ? parted_ + 1 : 0;
  outside_ += kAdaption * (likest(mean.data(), channels, half) - outside_);
  if (parted_ < kTimes) return std::nullopt;
  parted_ = 0;
  return *at;
}

FollowedBorder EdgeTracker::follow(const cv::Mat& image, const geometry::PinholeCamera* lens,
                                   const Stretch& predicted, double size_px, double sigma_px) {
  FollowedBorder border;
  const auto stretch = stretchInView(predicted, image.size(), kViewMarginPx, lens);
  if (!stretch) return border;
  const double wanted = std::min(kMinStretch * longerSide(image), kMaxOfASide * predicted.length());
  border.in_view = stretch->length() >= wanted;
  border.sought = border.in_view && memory_.known();
  if (!border.sought) return border;
  const double most = std::max(kMinReachPx, kReach * longerSide(image));
  const int reach =
      static_cast<int>(std::lround(std::clamp(kReachSigmas * sigma_px + 1.0, kMinReachPx, most)));
  const int count = std::clamp(static_cast<int>(stretch->length()), kMinFollowed, kProfiles);
  coarse_.sample(image, lens, {stretch->from, stretch->to, count, kSkip, reach + half_px_ + 2, true});
  const auto match = memory_.match(coarse_, reach, size_px);
  border.similarity = match ? match->similarity : 0.0;
  border.fitted = match && match->similarity >= kMinSimilarity && fit(image, lens, match->line, border);
  return border;
}

bool EdgeTracker::fit(const cv::Mat& image, const geometry::PinholeCamera* lens, const OffsetLine& coarse,
                      FollowedBorder& border) {
  const double scale = scaleOf(image), half = 0.5 * coarse_.length(),
               radius_px = scale * BorderFitLimits().radius_px;
  const int count =
      std::clamp(static_cast<int>(2.0 * half * (1.0 - 2.0 * kSkip)), kMinFollowed, kFineProfiles);
  fine_.sample(image, lens,
               {coarse_.point(-half, coarse.at(-half)), coarse_.point(half, coarse.at(half)), count, kSkip,
                static_cast<int>(std::ceil(radius_px)) + 5});
  if (!soft_) soft_ = isColourSoft(fine_);
  fit_.project(fine_, *soft_ ? resolvedPart(memory_.colour()).normalized() : memory_.colour());
  FittedBorder fitted;
  BorderFitLimits limits{radius_px, kPriorPx * scale,
                         std::max(kRoughPx, BorderFitLimits().outlier_px) * scale};
  if (!fit_.run(limits, fitted)) return false;
  limits.outlier_px = BorderFitLimits().outlier_px * scale;
  if (!fit_.run(limits, fitted)) return false;
  if (edge_.apart > 0.0 || ++frames_ % kLookEvery == 0)
    edge_ = fit_.toFront({-kFrontReachPx, kFrontReachPx, front_.outside(), &edge_}, fitted);
  border.inliers = static_cast<double>(fitted.inliers) / std::max(1, fine_.insideCount());
  border.line = fitted.inImage(fine_);
  border.a = fine_.point(fitted.from, fitted.line.at(fitted.from));
  border.b = fine_.point(fitted.to, fitted.line.at(fitted.to));
  seen_ = {coarse.offset + fitted.line.offset, coarse.slope + fitted.line.slope};
  return border.inliers >= kMinInliers;
}

void EdgeTracker::keep(const cv::Mat& image, const geometry::PinholeCamera* lens, double size_px) {
  const auto out_px = front_.look(coarse_, seen_, half_px_);
  if (!out_px) return memory_.learn(coarse_, seen_, half_px_, size_px, kLearningRate);
  const double half = 0.5 * coarse_.length();
  learn(image, lens,
        {coarse_.point(-half, seen_.at(-half) + *out_px), coarse_.point(half, seen_.at(half) + *out_px)},
        size_px);
}

void EdgeTracker::learn(const cv::Mat& image, const geometry::PinholeCamera* lens, const Stretch& border,
                        double size_px) {
  half_px_ = std::clamp(static_cast<int>(std::lround(kReach * longerSide(image))), 4, EdgeTemplate::kMaxHalf);
  coarse_.sample(image, lens, {border.from, border.to, kProfiles, kSkip, half_px_ + 3, true});
  edge_ = TwoStepEdge();
  frames_ = -1;
  soft_.reset();
  memory_.clear();
  memory_.learn(coarse_, {}, half_px_, size_px, 1.0);
  front_.forget();
  front_.look(coarse_, {}, half_px_);
}

}  // namespace window_ingress::detection
