#include "detection/tracking/quad_tracker.hpp"

#include <algorithm>
#include <optional>

#include "detection/borders/lines.hpp"
#include "window_ingress/geometry/image_border.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {
namespace {

using Eigen::Vector2d;
using geometry::Quadrilateral;

constexpr double kMaxShapeChange = 0.06;  // of aspect, skew and keystone, unpredicted, per frame [sides]
constexpr int kMinSides = 2;
constexpr double kMinSlackPx = 2.0;   // least tolerance of the shape, for any window size
constexpr double kGoodInliers = 0.8;  // part of profiles on a line that counts as all
constexpr double kBeyondEnd = 0.3;    // of a corner beyond the visible part of a side [its lengths]
constexpr double kBeyondEndPx = 6.0;
/// Greatest distance of the tracked edge from a visible border [px], and from an invisible one [sizes].
constexpr double kApartPx = 2.5, kApartUnseen = 0.08;
/// A side gives no position for an edge if its border is this uncertain and it is this close to the image's
/// border [longer image sides], where few surroundings are visible.
constexpr double kVaguePx = 0.5, kCutPart = 0.05;

// Change between two quadrilaterals after removal of place, size and roll [px].
double warpBetween(const Quadrilateral& before, const Quadrilateral& after) {
  const Vector2d from = geometry::centroid(before), to = geometry::centroid(after);
  double dot = 0.0, cross = 0.0, norm = 1e-9;
  for (int i = 0; i < 4; ++i) {
    const Vector2d a = before[i] - from, b = after[i] - to;
    dot += a.dot(b), cross += a.x() * b.y() - a.y() * b.x(), norm += a.squaredNorm();
  }
  double worst = 0.0;
  for (int i = 0; i < 4; ++i) {
    const Vector2d a = before[i] - from;
    const Vector2d turned((dot * a.x() - cross * a.y()) / norm, (cross * a.x() + dot * a.y()) / norm);
    worst = std::max(worst, (after[i] - to - turned).norm());
  }
  return worst;
}

bool reaches(const FollowedBorder& border, const Vector2d& corner) {
  const double beyond = std::min((border.a - corner).norm(), (border.b - corner).norm());
  return beyond <= kBeyondEndPx + kBeyondEnd * (border.b - border.a).norm();
}

// Distance from the border of the image.
double marginOf(const LensImage& view, const Vector2d& p) {
  return geometry::distanceToBorder(p, view.image.cols, view.image.rows);
}

// The corner between two borders, if visible.
std::optional<LineCorner> seenCorner(const LensImage& view, const FollowedBorder& before,
                                     const FollowedBorder& after) {
  if (!before.fitted || !after.fitted) return std::nullopt;
  const auto corner = meet(before.line, after.line);
  if (!corner || !reaches(before, corner->point) || !reaches(after, corner->point)) return std::nullopt;
  const LineCorner seen = throughLens(*corner, view.lens);
  if (!(marginOf(view, seen.point) >= 0.0)) return std::nullopt;
  return seen;
}

}  // namespace

void QuadTracker::learn(const LensImage& view, const Quadrilateral& quad, bool is_known) {
  const auto learn = is_known ? &EdgeTracker::learnNear : &EdgeTracker::learn;
  for (int i = 0; i < 4; ++i)
    (edges_[i].*learn)(view, {quad[i], quad[(i + 1) % 4]}, geometry::meanSide(quad));
}

bool QuadTracker::follow(const LensImage& view, QuadMotion& motion) {
  const Quadrilateral predicted = motion.predicted();
  in_view_ = sought_ = fitted_ = 0;
  for (int i = 0; i < 4; ++i) {
    borders_[i] = edges_[i].follow(view, {predicted[i], predicted[(i + 1) % 4]},
                                   geometry::meanSide(predicted), motion.sigmaAcross(i));
    in_view_ += borders_[i].in_view;
    sought_ += borders_[i].sought;
    fitted_ += borders_[i].fitted;
  }
  if (fitted_ < kMinSides || fitted_ < sought_ - 1) return false;
  for (int i = 0; i < 4; ++i)
    if (borders_[i].fitted) motion.correct(i, borders_[i].line);
  if (fitted_ == 4) placeCorners(motion);
  return keepsShape(motion);
}

void QuadTracker::placeCorners(QuadMotion& motion) const {
  Quadrilateral quad;
  for (int i = 0; i < 4; ++i) {
    const auto corner = meet(borders_[(i + 3) % 4].line, borders_[i].line);
    if (!corner) return;
    quad[i] = corner->point;
  }
  motion.place(quad);
}

bool QuadTracker::keepsShape(const QuadMotion& motion) const {
  const Quadrilateral now = motion.quad();
  if (!geometry::isFinite(now) || !geometry::isConvex(now) || !(geometry::signedArea(now) > 0.0))
    return false;
  const double slack_px = std::max(kMinSlackPx, kMaxShapeChange * geometry::meanSide(now));
  return warpBetween(motion.predicted(), now) <= slack_px;
}

void QuadTracker::describe(const LensImage& view, const QuadMotion& motion, WindowObservation& window) const {
  const Quadrilateral quad = motion.quad();
  const auto first = std::min_element(quad.begin(), quad.end(),
                                      [](const Vector2d& a, const Vector2d& b) { return a.sum() < b.sum(); });
  const int start = static_cast<int>(first - quad.begin());
  for (int i = 0; i < 4; ++i) {
    const FollowedBorder &before = borders_[(start + i + 3) % 4], &after = borders_[(start + i) % 4];
    window.edges[i] = after.fitted ? edgeThroughLens(after.line, after.a, after.b, view.lens) : Edge();
    const auto corner = seenCorner(view, before, after);
    window.corner_visible[i] = corner.has_value();
    window.corners[i] = corner ? corner->point : Vector2d(Vector2d::Zero());
    window.corner_covariance[i] = corner ? corner->covariance : Eigen::Matrix2d(Eigen::Matrix2d::Zero());
  }
}

void QuadTracker::keep(const Quadrilateral& quad) {
  for (int i = 0; i < 4; ++i)
    if (borders_[i].fitted) edges_[i].keep(geometry::meanSide(quad));
}

bool QuadTracker::realign(const LensImage& view, const RefinedBorders& borders, QuadMotion& motion) {
  const Quadrilateral quad = geometry::undistorted(borders.corners, view.lens), followed = motion.quad();
  int first = 0;  // index of the corner that corresponds to the first tracked one
  for (int i = 1; i < 4; ++i)
    if ((quad[i] - followed[0]).norm() < (quad[first] - followed[0]).norm()) first = i;
  Quadrilateral placed;
  for (int i = 0; i < 4; ++i) placed[i] = quad[(first + i) % 4];
  bool learned = false;
  for (int i = 0; i < 4; ++i) {
    const Vector2d &from = placed[i], &to = placed[(i + 1) % 4];
    const Edge& edge = borders.edges[(first + i) % 4];
    const Vector2d along = (to - from).normalized();
    const double pixel = pixelAcross(view.lens, from, to);
    const Line border{0.5 * (from + to), {along.y(), -along.x()}, pixel * edge.sigma_px, edge.sigma_rad};
    const bool shows = borders.fitted[(first + i) % 4];
    const double furthest_px = shows ? kApartPx * pixel : kApartUnseen * geometry::meanSide(followed);
    const SideSigma& known = borders.known[(first + i) % 4];
    const bool is_cut = std::min(marginOf(view, from), marginOf(view, to)) < kCutPart * view.longerSide();
    const bool is_vague = (!known.known() || known.px > kVaguePx * pixel) && (is_cut || !shows);
    if (borders_[i].fitted &&
        (is_vague || edges_[i].keepApart(border, geometry::meanSide(followed), furthest_px)))
      continue;
    edges_[i].learnNear(view, {from, to}, geometry::meanSide(quad));
    learned = true;
  }
  if (learned) motion.place(placed);
  return learned;
}

double QuadTracker::quality() const {
  double sum = 0.0;
  for (const FollowedBorder& border : borders_)
    if (border.fitted) sum += std::max(0.0, border.similarity) * std::min(1.0, border.inliers / kGoodInliers);
  return sum / std::max(1, sought_);
}

}  // namespace window_ingress::detection
