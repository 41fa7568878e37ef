#include "detection/tracking/edge_tracker.hpp"

#include <algorithm>
#include <cmath>

#include "detection/borders/edge_profiles.hpp"
#include "window_ingress/geometry/image_border.hpp"

namespace window_ingress::detection {
namespace {

using Eigen::Vector2d;

constexpr int kProfiles = 18;           ///< across each side, to find the border
constexpr int kFineProfiles = 40;       ///< across each side to fit its line
constexpr double kMinSimilarity = 0.5;  ///< least correlation of a side's profile with the memory, 0 to 1
constexpr double kMinInliers = 0.4;     ///< part of a side's profiles that must lie on its line
constexpr double kMinStretch = 0.06;    ///< least visible part of a side, to track it [longer image sides]
constexpr int kViewSteps = 64;
constexpr double kNominalSidePx = 640.0;  // pixel parameters hold up to this longer image side
constexpr double kViewMarginPx = 3.0;     // of a side from the border of the image
constexpr double kMaxOfASide = 0.8;       // part of a short side that must be in the image
constexpr double kReachSigmas = 3.0;
constexpr double kMinReachPx = 2.5;
constexpr double kPriorPx = 1.0;        // preference for the predicted border over stronger edges
constexpr double kRoughPx = 0.7;        // of the first fit
constexpr double kSameApartPx = 0.3;    // a larger change of the distance is no noise
constexpr double kApartRate = 0.3;      // part of that distance that one alignment replaces
constexpr double kFoundWithinPx = 4.0;  // greatest distance of an edge from the border to track
constexpr int kMinFollowed = 6;

// Clips the stretch to the band between two parallels to an axis.
bool clip(double from, double span, double low, double high, double& begin, double& end) {
  if (std::abs(span) < 1e-12) return from >= low && from <= high;
  const double a = (low - from) / span, b = (high - from) / span;
  begin = std::max(begin, std::min(a, b));
  end = std::min(end, std::max(a, b));
  return begin < end;
}

// The ideal image's radius; a lens model folds points further outside back into the image.
double largestRadius(const cv::Mat& image, const geometry::PinholeCamera& lens) {
  double radius = 0.0;
  for (const int x : {0, image.cols - 1})
    for (const int y : {0, image.rows - 1})
      radius = std::max(radius, (lens.undistort(Vector2d(x, y)) - Vector2d(lens.cx, lens.cy)).norm());
  return radius;
}

std::optional<Stretch> throughLens(const Stretch& whole, const cv::Mat& image, double margin,
                                   const geometry::PinholeCamera& lens) {
  const double radius = largestRadius(image, lens);
  const Vector2d step = (whole.to - whole.from) / kViewSteps;
  int best = 0, best_end = -1, run = 0;
  for (int i = 0; i <= kViewSteps; ++i) {
    const Vector2d p = whole.from + i * step;
    const bool seen = (p - Vector2d(lens.cx, lens.cy)).norm() <= radius &&
                      geometry::isInside(lens.distort(p), image.cols, image.rows, margin);
    run = seen ? run + 1 : 0;
    if (run > best) best = run, best_end = i;
  }
  if (best < 2) return std::nullopt;
  return Stretch{whole.from + (best_end - best + 1) * step, whole.from + best_end * step};
}

double scaleOf(const LensImage& view) { return std::max(1.0, view.longerSide() / kNominalSidePx); }

}  // namespace

std::optional<Stretch> stretchInView(const Stretch& whole, const LensImage& view, double margin_px) {
  const Vector2d span = whole.to - whole.from;
  if (!whole.from.allFinite() || !whole.to.allFinite() || !(span.squaredNorm() > 0.0)) return std::nullopt;
  if (view.lens) return throughLens(whole, view.image, margin_px, *view.lens);
  double begin = 0.0, end = 1.0;
  if (!clip(whole.from.x(), span.x(), margin_px, view.image.cols - 1 - margin_px, begin, end) ||
      !clip(whole.from.y(), span.y(), margin_px, view.image.rows - 1 - margin_px, begin, end))
    return std::nullopt;
  return Stretch{whole.from + begin * span, whole.from + end * span};
}

// The tracked edge beside a side.
Stretch EdgeTracker::edgeOf(const Stretch& side, double size_px) {
  middle_ = 0.5 * (side.from + side.to);
  const double length = side.length(), at = apart_.px(size_px), end = 0.5 * length * apart_.slope;
  if (!(length > 0.0)) return side;
  const Vector2d span = side.to - side.from, outwards = Vector2d(span.y(), -span.x()) / length;
  return {side.from - (at - end) * outwards, side.to - (at + end) * outwards};
}

FollowedBorder EdgeTracker::follow(const LensImage& view, const Stretch& predicted, double size_px,
                                   double sigma_px) {
  FollowedBorder border;
  const auto stretch = stretchInView(edgeOf(predicted, size_px), view, kViewMarginPx);
  if (!stretch) return border;
  const double wanted = std::min(kMinStretch * view.longerSide(), kMaxOfASide * predicted.length());
  border.in_view = stretch->length() >= wanted;
  border.sought = border.in_view && memory_.known();
  if (!border.sought) return border;
  const double pixel = pixelAcross(view.lens, stretch->from, stretch->to),
               most = std::clamp(kReach * view.longerSide(), kMinReachPx, double(EdgeTemplate::kMaxReach));
  const int reach =
      static_cast<int>(std::lround(std::clamp(kReachSigmas * sigma_px / pixel + 1.0, kMinReachPx, most)));
  const int count = std::clamp(static_cast<int>(stretch->length()), kMinFollowed, kProfiles);
  coarse_.sample(view.image, view.lens,
                 {stretch->from, stretch->to, count, kEndMargin, reach + half_px_ + 2, true});
  const auto match = memory_.match(coarse_, reach, size_px / coarse_.pixel());
  border.similarity = match ? match->similarity : 0.0;
  border.fitted = match && match->similarity >= kMinSimilarity && fit(view, match->line, size_px, border);
  return border;
}

bool EdgeTracker::fit(const LensImage& view, const OffsetLine& coarse, double size_px,
                      FollowedBorder& border) {
  const double scale = scaleOf(view), half = 0.5 * coarse_.length(),
               radius_px = scale * SubpixelBorderLimits().radius_px;
  const int count =
      std::clamp(static_cast<int>(2.0 * half * (1.0 - 2.0 * kEndMargin)), kMinFollowed, kFineProfiles);
  fine_.sample(view.image, view.lens,
               {coarse_.point(-half, coarse.at(-half)), coarse_.point(half, coarse.at(half)), count,
                kEndMargin, static_cast<int>(std::ceil(radius_px)) + 5});
  if (!soft_) soft_ = isColourSoft(fine_);
  fit_.project(fine_, *soft_ ? resolvedPart(memory_.colour()).normalized() : memory_.colour());
  FittedBorder fitted;
  SubpixelBorderLimits limits{radius_px, kPriorPx * scale,
                              std::max(kRoughPx, SubpixelBorderLimits().outlier_px) * scale};
  if (!fit_.run(limits, fitted)) return false;
  limits.outlier_px = SubpixelBorderLimits().outlier_px * scale;
  if (!fit_.run(limits, fitted)) return false;
  edge_ = fitted;
  seen_ = {coarse.offset + fitted.line.offset, coarse.slope + fitted.line.slope};
  const double shift = fine_.along().dot(fine_.middle() - middle_), pixel = fine_.pixel();
  fitted.line.offset += (apart_.px(size_px) + apart_.slope * shift) / pixel;
  fitted.line.slope += apart_.slope / pixel;
  fitted.sigma_px = std::hypot(fitted.sigma_px, apart_.sigma.px * size_px / pixel);
  fitted.sigma_rad = std::hypot(fitted.sigma_rad, apart_.sigma.rad / pixel);
  border.inliers = static_cast<double>(fitted.inliers) / std::max(1, fine_.insideCount());
  border.line = fitted.inImage(fine_);
  border.a = fine_.point(fitted.from, fitted.line.at(fitted.from));
  border.b = fine_.point(fitted.to, fitted.line.at(fitted.to));
  return border.inliers >= kMinInliers;
}

bool EdgeTracker::keepApart(const Line& border, double size_px, double furthest_px) {
  const double half = 0.5 * fine_.length();
  const auto outwards = [&](double position) {
    const Vector2d edge = fine_.point(position, edge_.line.at(position));
    return -border.distance(edge) / border.normal.dot(fine_.normal());
  };
  const double from = outwards(-half), to = outwards(half);
  if (!(std::max(std::abs(from), std::abs(to)) < furthest_px)) return false;
  const double slope = (to - from) / fine_.length();
  const double offset = 0.5 * (from + to) + slope * fine_.along().dot(middle_ - fine_.middle());
  const bool is_same =
      apart_.sigma.known() && std::abs(offset - apart_.px(size_px)) < kSameApartPx * fine_.pixel();
  const double rate = is_same ? kApartRate : 1.0;
  apart_.offset += rate * (offset / (size_px * size_px) - apart_.offset);
  apart_.slope += rate * (slope - apart_.slope);
  apart_.sigma = {border.sigma_px / size_px, border.sigma_rad};
  return true;
}

void EdgeTracker::learn(const LensImage& view, const Stretch& border, double size_px) {
  half_px_ = std::clamp(static_cast<int>(std::lround(kReach * view.longerSide())), 4, EdgeTemplate::kMaxHalf);
  coarse_.sample(view.image, view.lens, {border.from, border.to, kProfiles, kEndMargin, half_px_ + 3, true});
  apart_ = {};
  soft_.reset();
  memory_.clear();
  memory_.learn(coarse_, {}, half_px_, size_px / coarse_.pixel(), 1.0);
}

void EdgeTracker::learnNear(const LensImage& view, const Stretch& border, double size_px) {
  const double scale = scaleOf(view), radius_px = kFoundWithinPx * scale, half = 0.5 * border.length();
  const int count = std::clamp(static_cast<int>(border.length()), kMinFollowed, kFineProfiles);
  fine_.sample(view.image, view.lens,
               {border.from, border.to, count, kEndMargin, static_cast<int>(std::ceil(radius_px)) + 4});
  FittedBorder edge;
  const SubpixelBorderLimits limits{radius_px, kPriorPx * scale, kRoughPx * scale};
  if (!fit_.projectStrongest(fine_, radius_px) || !fit_.run(limits, edge) ||
      edge.inliers < kMinInliers * count || std::abs(edge.line.offset) < kSameApartPx)
    return learn(view, border, size_px);
  learn(view, {fine_.point(-half, edge.line.at(-half)), fine_.point(half, edge.line.at(half))}, size_px);
  apart_.offset = -fine_.pixel() * edge.line.offset / (size_px * size_px);
  apart_.slope = -fine_.pixel() * edge.line.slope;
}

}  // namespace window_ingress::detection
