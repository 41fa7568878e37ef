#include "window_ingress/detection/border_refinement.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "detection/borders/edge_profiles.hpp"
#include "detection/borders/lines.hpp"
#include "detection/borders/subpixel_border.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::detection {
namespace {

using Eigen::Vector2d;

constexpr int kSamples = 80;  ///< profiles across each side, at most one a pixel
constexpr double kNominalSide =
    640.0;                           ///< pixel parameters scale with the image beyond this longer side [px]
constexpr double kWidePx = 1e3;      ///< no prior
constexpr double kShortestPx = 4.0;  ///< shortest side that can be fitted [px]
constexpr double kFrontWithinPx =
    1.2;  ///< front edge of a reveal: greatest distance from the fitted edge [px]
constexpr double kLocatedWithinPx =
    1.6;                         ///< front edge of a reveal: greatest distance from a located start [px]
constexpr double kWider = 1.8;   ///< factor of the reach where a located border is not within it
constexpr double kTurned = 2.5;  ///< factor of the reach for line ends, where most of a side is visible
constexpr double kMaxInliers = 0.7;
constexpr double kKnownSigmas = 3.0;
constexpr double kContradiction = 13.8;  ///< 99.9 % quantile of chi-squared with two degrees of freedom

}  // namespace

/// Buffers of one object, reused for each side.
struct BorderRefinement::Workspace {
  EdgeProfiles profiles;
  SubpixelBorder fit;
};

namespace {

/// Fits one side: samples its profiles once and derives everything from them.
class Side {
 public:
  Side(BorderRefinement::Workspace& memory, const SubpixelBorderLimits& limits, const BorderStart& start,
       int side, double pixel)
      : memory_(memory),
        limits_(limits),
        start_(start),
        known_{start.known[side].px / pixel, start.known[side].rad / pixel},
        is_hidden_(start.hidden == side) {}

  bool run(const cv::Mat& image, const geometry::PinholeCamera* lens, const Vector2d& a, const Vector2d& b) {
    return run(image, lens, a, b, reach());
  }
  // Second try where no edge lies near the start. Accepts a border further away if most of it is visible.
  void runWider(const cv::Mat& image, const geometry::PinholeCamera* lens, const Vector2d& a,
                const Vector2d& b) {
    if (shows_edge_ || is_hidden_) return;
    border_ = FittedBorder();
    const bool found = run(image, lens, a, b, kWider * reach());
    seen_ = seen_ && inliers_ > kMaxInliers;
    fitted_ = found && seen_;
  }
  bool fitted() const { return fitted_; }
  bool seen() const { return seen_; }
  double inliers() const { return inliers_; }
  Line line() const { return border_.inImage(memory_.profiles); }
  // The start, as the result.
  Line start() const {
    FittedBorder border;
    border.from = -0.5 * memory_.profiles.length(), border.to = -border.from;
    border.sigma_px = known_.px, border.sigma_rad = known_.rad;
    return border.inImage(memory_.profiles);
  }
  // Ends of the visible stretch on the line, or those of the start.
  std::pair<Vector2d, Vector2d> ends() const {
    const auto& p = memory_.profiles;
    const double half = 0.5 * p.length();
    if (!fitted_) return {p.point(-half, 0.0), p.point(half, 0.0)};
    return {p.point(border_.from, border_.line.at(border_.from)),
            p.point(border_.to, border_.line.at(border_.to))};
  }

 private:
  bool run(const cv::Mat& image, const geometry::PinholeCamera* lens, const Vector2d& a, const Vector2d& b,
           double radius_px) {
    const int radius = static_cast<int>(std::ceil(radius_px));
    const int reach = radius + static_cast<int>(std::ceil(limits_.radius_px)) + 2;
    count_ = std::clamp(static_cast<int>((b - a).norm() * (1.0 - 2.0 * kEndMargin)), 4, kSamples);
    memory_.profiles.sample(image, lens, {a, b, count_, kEndMargin, reach});
    shows_edge_ = memory_.fit.projectStrongest(memory_.profiles, radius_px);
    if (!fit({radius_px, 0.6 * radius_px, std::max(limits_.outlier_px, 0.35 * radius_px)})) return false;
    if (!fit({limits_.radius_px, kWidePx, limits_.outlier_px}) || stray() > reachOf(radius_px)) return false;
    toFront();
    seen_ = stray() <= start_.max_stray_px && !is_hidden_;
    fitted_ = seen_ && agrees();
    if (fitted_ && known_.known()) average();
    return fitted_;
  }

  double reach() const {
    return known_.known() ? std::min(start_.radius_px, kKnownSigmas * known_.px + 1.0) : start_.radius_px;
  }

  // Tests the Mahalanobis distance between the prior of a side and its fit.
  bool agrees() const {
    if (!known_.known()) return true;
    const Eigen::Matrix2d both = knownInformation().inverse() + fittedInformation().inverse();
    const Vector2d apart(border_.line.offset, border_.line.slope);
    return apart.dot(both.ldlt().solve(apart)) < kContradiction;
  }

  // Information matrices of offset and slope at the middle of the side.
  Eigen::Matrix2d knownInformation() const {
    return Vector2d(1.0 / (known_.px * known_.px), 1.0 / (known_.rad * known_.rad)).asDiagonal();
  }
  Eigen::Matrix2d fittedInformation() const {
    const double at = border_.middle(), across = 1.0 / (border_.sigma_px * border_.sigma_px);
    Eigen::Matrix2d information;
    information << across, at * across, at * across,
        at * at * across + 1.0 / (border_.sigma_rad * border_.sigma_rad);
    return information;
  }

  void average() {
    const Eigen::Matrix2d fitted = fittedInformation(), covariance = (knownInformation() + fitted).inverse();
    const Vector2d line = covariance * fitted * Vector2d(border_.line.offset, border_.line.slope);
    const Vector2d middle(1.0, border_.middle());
    border_.line = {line.x(), line.y()};
    border_.sigma_px = std::sqrt(middle.dot(covariance * middle));
    border_.sigma_rad = std::sqrt(covariance(1, 1));
  }

  // A located start may be rotated. A line visible along nearly all of a side may therefore deviate further.
  double reachOf(double radius_px) const {
    return known_.known() && inliers_ > kMaxInliers ? kTurned * radius_px : radius_px;
  }

  // A located start gives the position of the front edge; any other start only that of an edge near it.
  void toFront() {
    const double from = border_.line.at(border_.middle());
    const double near = kFrontWithinPx, wide = kLocatedWithinPx;
    memory_.fit.toFront(
        known_.known() ? TwoStepEdgeLimits{-wide - from, wide - from} : TwoStepEdgeLimits{-near, near},
        border_);
  }

  // How far an end of the fitted line is from the start.
  double stray() const {
    const double half = 0.5 * memory_.profiles.length();
    return std::max(std::abs(border_.line.at(-half)), std::abs(border_.line.at(half)));
  }

  bool fit(const SubpixelBorderLimits& limits) {
    inliers_ = 0.0;
    if (!memory_.fit.run(limits, border_)) return false;
    inliers_ = static_cast<double>(border_.inliers) / count_;
    return inliers_ >= BorderRefinement::kMinInliers;
  }

  BorderRefinement::Workspace& memory_;
  const SubpixelBorderLimits& limits_;  // of the last pass, for this image's size
  const BorderStart& start_;
  const SideSigma known_;  // in the profiles' pixels
  const bool is_hidden_;
  int count_ = 0;
  FittedBorder border_;
  bool shows_edge_ = false, fitted_ = false, seen_ = false;
  double inliers_ = 0.0;
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

BorderRefinement::BorderRefinement() : memory_(std::make_unique<Workspace>()) {}
BorderRefinement::~BorderRefinement() = default;
BorderRefinement::BorderRefinement(BorderRefinement&&) noexcept = default;
BorderRefinement& BorderRefinement::operator=(BorderRefinement&&) noexcept = default;

std::optional<RefinedBorders> BorderRefinement::run(const cv::Mat& image, const BorderStart& start,
                                                    const geometry::PinholeCamera* camera,
                                                    double* worst_inliers) const {
  SubpixelBorderLimits limits;
  const double scale = std::max(1.0, std::max(image.cols, image.rows) / kNominalSide);
  limits.radius_px *= scale;
  limits.outlier_px *= scale;
  const geometry::PinholeCamera* lens = geometry::lensOf(camera);
  std::array<Line, 4> lines;
  RefinedBorders borders;
  double worst = 1.0;
  borders.known = start.known;
  bool good = true;
  for (int i = 0; i < 4 && good; ++i) {
    const Vector2d& from = start.quad[i];
    const Vector2d& to = start.quad[(i + 1) % 4];
    const Vector2d a = lens ? lens->undistort(from) : from, b = lens ? lens->undistort(to) : to;
    good = (b - a).norm() > kShortestPx;
    if (!good) break;
    Side side(*memory_, limits, start, i, pixelAcross(lens, a, b));
    good = side.run(image, lens, a, b) || start.known[i].known();
    if (good && !side.fitted()) side.runWider(image, lens, a, b);
    worst = std::min(worst, side.inliers());
    borders.seen += side.seen();
    borders.fitted[i] = side.fitted();
    lines[i] = side.fitted() ? side.line() : side.start();
    const auto [begin, end] = side.ends();
    borders.edges[i] = edgeThroughLens(lines[i], begin, end, lens);
  }
  if (worst_inliers) *worst_inliers = worst;
  if (!good || !finish(lines, lens, borders)) return std::nullopt;
  return borders;
}

}  // namespace window_ingress::detection
