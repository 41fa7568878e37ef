#include "window_ingress/detection/border_refinement.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "detection/borders/edge_profiles.hpp"
#include "detection/borders/lines.hpp"
#include "detection/borders/subpixel_border.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::detection {
namespace {

using Eigen::Vector2d;

constexpr int kSamples = 80;            ///< profiles across each side, at most one a pixel
constexpr double kNominalSide = 640.0;  ///< pixel parameters scale with longer sides of the image beyond [px]
constexpr double kWidePx = 1e3;         ///< no prior
constexpr double kShortestPx = 4.0;     ///< shortest side that can be fitted [px]
/// Front edge of a reveal: greatest distance from the fitted edge, and from a located start [px].
constexpr double kFrontWithinPx = 1.2, kLocatedWithinPx = 1.6;
constexpr double kWider = 1.8;   ///< factor of the reach where a located border is not within it
constexpr double kTurned = 2.5;  ///< factor of the reach for line ends, where most of a side is visible
constexpr double kMaxInliers = 0.7;
constexpr double kKnownSigmas = 3.0;
constexpr double kContradiction = 13.8;  ///< 99.9 % quantile of chi-squared with two degrees of freedom

/// Fits one side: samples its profiles once and derives everything from them.
struct FittedSide {
  const cv::Mat& image;
  const geometry::PinholeCamera* lens;
  const BorderStart& start;
  const int side;
  const Vector2d from, to;  ///< ends of the side, undistorted
  EdgeProfiles& profiles;
  SubpixelBorder& subpixel;
  const double pixel = pixelAcross(lens, from, to);
  const SideSigma known{start.known[side].px / pixel, start.known[side].rad / pixel};  ///< [profiles' pixels]
  const bool is_hidden = start.hidden == side;
  FittedBorder border{};
  bool shows_edge = false, fitted = false, seen = false;
  double inliers = 0.0;  ///< part of the profiles on the line

  // A known side without a border stays at its start. Returns false if an unknown one has none.
  bool run() {
    const double reach_px =
        known.known() ? std::min(start.radius_px, kKnownSigmas * known.px + 1.0) : start.radius_px;
    fitted = fitWithin(reach_px);
    if (!fitted && !known.known()) return false;
    if (!fitted && !shows_edge && !is_hidden) {  // accepts one further away if most of it is visible
      border = {};
      const bool found = fitWithin(kWider * reach_px);
      seen = seen && inliers > kMaxInliers;
      fitted = found && seen;
    }
    const double half = 0.5 * profiles.length();
    if (!fitted) border = {{}, -half, half, known.px, known.rad};
    return true;
  }

  bool fitWithin(double radius_px) {
    const double scale = std::max(1.0, std::max(image.cols, image.rows) / kNominalSide);
    const double last_px = scale * SubpixelBorderLimits().radius_px,
                 outlier_px = scale * SubpixelBorderLimits().outlier_px;
    const int reach = static_cast<int>(std::ceil(radius_px)) + static_cast<int>(std::ceil(last_px)) + 2;
    const int count =
        std::clamp(static_cast<int>((to - from).norm() * (1.0 - 2.0 * kEndMargin)), 4, kSamples);
    profiles.sample(image, lens, {from, to, count, kEndMargin, reach});
    shows_edge = subpixel.projectStrongest(profiles, radius_px);
    if (!fit({radius_px, 0.6 * radius_px, std::max(outlier_px, 0.35 * radius_px)})) return false;
    if (!fit({last_px, kWidePx, outlier_px})) return false;
    // A located start may be rotated, so a line visible along nearly all of a side may deviate further.
    const bool is_turned = known.known() && inliers > kMaxInliers;
    if (stray() > (is_turned ? kTurned * radius_px : radius_px)) return false;
    // A located start gives the position of the front edge; any other start only that of an edge near it.
    const double within = known.known() ? kLocatedWithinPx : kFrontWithinPx;
    const double off = known.known() ? border.line.at(border.middle()) : 0.0;
    subpixel.toFront({-within - off, within - off}, border);
    seen = stray() <= start.max_stray_px && !is_hidden;
    return seen && (!known.known() || average());
  }

  bool fit(const SubpixelBorderLimits& limits) {
    inliers = 0.0;
    if (!subpixel.run(limits, border)) return false;
    inliers = static_cast<double>(border.inliers) / profiles.count();
    return inliers >= kMinBorderInliers;
  }

  // How far an end of the fitted line is from the start.
  double stray() const {
    const double half = 0.5 * profiles.length();
    return std::max(std::abs(border.line.at(-half)), std::abs(border.line.at(half)));
  }

  // Averages the fit with what is known of the side, by their information on offset and slope at its middle.
  // False, and nothing changed, if their Mahalanobis distance shows a contradiction.
  bool average() {
    const Eigen::Matrix2d knowledge =
        Vector2d(1.0 / (known.px * known.px), 1.0 / (known.rad * known.rad)).asDiagonal();
    const double at = border.middle(), across = 1.0 / (border.sigma_px * border.sigma_px);
    Eigen::Matrix2d measured;
    measured << across, at * across, at * across,
        at * at * across + 1.0 / (border.sigma_rad * border.sigma_rad);
    const Vector2d line(border.line.offset, border.line.slope), middle(1.0, at);
    const Eigen::Matrix2d both = knowledge.inverse() + measured.inverse();
    if (!(line.dot(both.ldlt().solve(line)) < kContradiction)) return false;
    const Eigen::Matrix2d covariance = (knowledge + measured).inverse();
    const Vector2d averaged = covariance * measured * line;
    border.line = {averaged.x(), averaged.y()};
    border.sigma_px = std::sqrt(middle.dot(covariance * middle));
    border.sigma_rad = std::sqrt(covariance(1, 1));
    return true;
  }

  Line line() const { return border.inImage(profiles); }
  Edge edge() const {
    return edgeThroughLens(line(), profiles.point(border.from, border.line.at(border.from)),
                           profiles.point(border.to, border.line.at(border.to)), lens);
  }
};

// Restores canonical order: a corner may have become the first by a fraction of a pixel.
void startAtTopLeft(RefinedBorders& borders) {
  const auto first = std::min_element(borders.corners.begin(), borders.corners.end(),
                                      [](const Vector2d& a, const Vector2d& b) { return a.sum() < b.sum(); });
  const auto shift = first - borders.corners.begin();
  const auto rotate = [shift](auto& of) { std::rotate(of.begin(), of.begin() + shift, of.end()); };
  rotate(borders.corners);
  rotate(borders.corner_covariance);
  rotate(borders.edges);
  rotate(borders.fitted);
  rotate(borders.known);
}

// Intersects the borders to corners in raw pixels; false if they form no convex quadrilateral.
bool finish(const std::array<Line, 4>& lines, const geometry::PinholeCamera* lens, RefinedBorders& borders) {
  for (int i = 0; i < 4; ++i) {
    const auto corner = meet(lines[(i + 3) % 4], lines[i]);
    if (!corner) return false;
    const LineCorner seen = throughLens(*corner, lens);
    borders.corners[i] = seen.point;
    borders.corner_covariance[i] = seen.covariance;
  }
  if (!geometry::isFinite(borders.corners) || !geometry::isConvex(borders.corners)) return false;
  startAtTopLeft(borders);
  return true;
}

}  // namespace

void BorderStart::knowAll(double sigma_px) {
  for (int i = 0; i < 4; ++i)
    known[i] = {sigma_px, sigma_px * std::sqrt(12.0) / std::max(1.0, (quad[(i + 1) % 4] - quad[i]).norm())};
}

std::optional<RefinedBorders> refineBorders(const cv::Mat& image, const BorderStart& start,
                                            const geometry::PinholeCamera* camera, double* worst_inliers) {
  const geometry::PinholeCamera* lens = geometry::lensOf(camera);
  const geometry::Quadrilateral quad = geometry::undistorted(start.quad, lens);
  thread_local EdgeProfiles profiles;  // keep their memory
  thread_local SubpixelBorder subpixel;
  std::array<Line, 4> lines;
  RefinedBorders borders;
  borders.known = start.known;
  double ignored = 1.0, &worst = worst_inliers ? *worst_inliers : ignored;
  worst = 1.0;
  for (int i = 0; i < 4; ++i) {
    const Vector2d &from = quad[i], &to = quad[(i + 1) % 4];
    if (!((to - from).norm() > kShortestPx)) return std::nullopt;
    FittedSide side{image, lens, start, i, from, to, profiles, subpixel};
    const bool found = side.run();
    worst = std::min(worst, side.inliers);
    if (!found) return std::nullopt;
    borders.seen += side.seen;
    borders.fitted[i] = side.fitted;
    lines[i] = side.line();
    borders.edges[i] = side.edge();
  }
  if (!finish(lines, lens, borders)) return std::nullopt;
  return borders;
}

}  // namespace window_ingress::detection
