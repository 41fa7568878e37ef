#include "window_ingress/detection/border_refinement.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "detection/borders/border_fit.hpp"
#include "detection/borders/edge_profiles.hpp"
#include "detection/borders/lines.hpp"
#include "detection/quads.hpp"

namespace window_ingress::detection {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3f;

constexpr int kSamples = 80;  ///< profiles across each side, at most one a pixel
constexpr double kNominalSide =
    640.0;  ///< longer side of an image up to which pixel parameters hold as they are
constexpr double kFaintestChange =
    3.0;                             ///< of the mean colour over two pixels that may be an edge [grey levels]
constexpr double kWidePx = 1e3;      ///< no prior
constexpr double kShortestPx = 4.0;  ///< a side that can be fitted [px]
constexpr double kFrontWithinPx = 1.2;    ///< reach of the front edge of a reveal from what was fitted [px]
constexpr double kLocatedWithinPx = 1.6;  ///< and of that from a start that was located [px]
constexpr double kWider = 1.8;            ///< of the reach, where a located border is not in it
constexpr double kTurned = 2.5;           ///< of the reach, for the ends of a line that most of a side shows
constexpr double kMaxInliers = 0.7;

}  // namespace

/// Memory of one object, used again for each side.
struct BorderRefinement::Workspace {
  EdgeProfiles profiles;
  BorderFit fit;
  std::vector<float> mean;        // of all profiles, channel by channel
  std::vector<Vector3f> changes;  // of the mean colour over two pixels, by offset
  std::vector<float> sizes;       // of the changes
};

namespace {

/// One side while it is being fitted: profiles once, then everything from them.
class Side {
 public:
  Side(BorderRefinement::Workspace& memory, const BorderFitLimits& limits, const BorderStart& start)
      : memory_(memory), limits_(limits), start_(start) {}

  bool run(const cv::Mat& image, const geometry::PinholeCamera* lens, const Vector2d& a, const Vector2d& b) {
    return run(image, lens, a, b, start_.radius_px);
  }
  // Again, where nothing lies near the start: for a border further away that shows over most of its length.
  void runWider(const cv::Mat& image, const geometry::PinholeCamera* lens, const Vector2d& a,
                const Vector2d& b) {
    if (showsEdge()) return;
    border_ = FittedBorder();
    const bool found = run(image, lens, a, b, kWider * start_.radius_px);
    fitted_ = found && inliers_ > kMaxInliers;
  }
  bool fitted() const { return fitted_; }
  bool seen() const { return seen_; }
  double inliers() const { return inliers_; }
  Line line() const { return border_.inImage(memory_.profiles); }
  // The start as an answer; the less certain the further off the edge that was found and not believed.
  Line start() const {
    FittedBorder border;
    border.from = -0.5 * memory_.profiles.length(), border.to = -border.from;
    border.sigma_px = std::hypot(start_.fallback_sigma_px, 0.5 * stray_px_);
    border.sigma_rad = border.sigma_px * std::sqrt(12.0) / memory_.profiles.length();
    return border.inImage(memory_.profiles);
  }
  // Ends of the stretch that was seen, or of the start, on the line.
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
    count_ = std::clamp(static_cast<int>((b - a).norm() * (1.0 - 2.0 * kSkip)), 4, kSamples);
    memory_.profiles.sample(image, lens, {a, b, count_, kSkip, reach});
    chooseEdge(radius);
    memory_.fit.project(memory_.profiles, colour_);
    if (!fit({radius_px, 0.6 * radius_px, std::max(limits_.outlier_px, 0.35 * radius_px)})) return false;
    if (!fit({limits_.radius_px, kWidePx, limits_.outlier_px}) || stray() > reachOf(radius_px)) return false;
    toFront();
    stray_px_ = stray();
    seen_ = stray_px_ <= start_.max_stray_px;
    fitted_ = seen_ && stray_px_ <= start_.max_shift_px;
    return fitted_;
  }

  // A start that was located may be turned itself: a line that nearly all of the side shows may be, too.
  double reachOf(double radius_px) const {
    return located() && inliers_ > kMaxInliers ? kTurned * radius_px : radius_px;
  }
  bool located() const { return start_.fallback_sigma_px > 0.0; }

  // Something that may be a border lies near the start, only that no line fits it.
  bool showsEdge() const {
    const auto& sizes = memory_.sizes;
    for (std::size_t k = 1; k + 1 < sizes.size(); ++k)
      if (sizes[k] > kFaintestChange && sizes[k] >= sizes[k - 1] && sizes[k] >= sizes[k + 1]) return true;
    return false;
  }

  // A start that was located says where the front edge is, any other one but what is beside it.
  void toFront() {
    const double from = border_.line.at(border_.middle());
    const double near = kFrontWithinPx, wide = kLocatedWithinPx;
    memory_.fit.toFront({located() ? -wide - from : -near, located() ? wide - from : near, nullptr, nullptr},
                        border_);
  }

  // How far an end of the fitted line is from the start.
  double stray() const {
    const double half = 0.5 * memory_.profiles.length();
    return std::max(std::abs(border_.line.at(-half)), std::abs(border_.line.at(half)));
  }

  // Where the side as a whole changes, and the direction in colour space in which it does.
  void chooseEdge(int radius) {
    const EdgeProfiles& p = memory_.profiles;
    memory_.mean.resize(static_cast<std::size_t>(3) * p.width());
    p.mean(0, p.count(), memory_.mean.data());
    const bool soft = isColourSoft(p);
    memory_.changes.clear();
    memory_.sizes.clear();
    for (int o = -radius; o <= radius; ++o) {
      Vector3f change;
      for (int c = 0; c < 3; ++c) {
        const float* mean = memory_.mean.data() + (p.channels() == 1 ? 0 : c) * p.width() + p.reach() + o;
        change[c] = mean[1] - mean[-1];
      }
      if (soft) change = resolvedPart(change);
      memory_.changes.push_back(change);
      memory_.sizes.push_back(change.norm());
    }
    const int at = strongest(memory_.sizes, radius);
    if (memory_.sizes[at] > 0.0f) colour_ = memory_.changes[at] / memory_.sizes[at];
  }

  static int strongest(const std::vector<float>& changes, double radius_px) {
    const int reach = static_cast<int>(changes.size()) / 2;
    int at = reach;
    double best = 0.0;
    for (int k = 0; k < static_cast<int>(changes.size()); ++k) {
      const double weight = changes[k] * std::exp(-0.5 * std::pow((k - reach) / (0.6 * radius_px), 2));
      if (weight > best) best = weight, at = k;
    }
    return at;
  }

  bool fit(const BorderFitLimits& limits) {
    BorderFitLimits all = limits;
    inliers_ = 0.0;
    if (!memory_.fit.run(all, border_)) return false;
    inliers_ = static_cast<double>(border_.inliers) / count_;
    return inliers_ >= BorderRefinement::kMinInliers;
  }

  BorderRefinement::Workspace& memory_;
  const BorderFitLimits& limits_;  // of the last pass, for this image's size
  const BorderStart& start_;
  int count_ = 0;
  FittedBorder border_;
  bool fitted_ = false, seen_ = false;
  double stray_px_ = 0.0, inliers_ = 0.0;
  Vector3f colour_ = Vector3f::Constant(1.0f / std::sqrt(3.0f));
};

// Canonical order again: a corner may have become the first by a fraction of a pixel.
void startAtTopLeft(RefinedBorders& borders) {
  const auto first = std::min_element(borders.corners.begin(), borders.corners.end(),
                                      [](const Vector2d& a, const Vector2d& b) { return a.sum() < b.sum(); });
  const auto shift = first - borders.corners.begin();
  std::rotate(borders.corners.begin(), borders.corners.begin() + shift, borders.corners.end());
  std::rotate(borders.corner_covariance.begin(), borders.corner_covariance.begin() + shift,
              borders.corner_covariance.end());
  std::rotate(borders.edges.begin(), borders.edges.begin() + shift, borders.edges.end());
}

// Corners of the image as it came from the borders; false if they are no window.
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

BorderRefinement::BorderRefinement() : memory_(std::make_unique<Workspace>()) {}
BorderRefinement::~BorderRefinement() = default;
BorderRefinement::BorderRefinement(BorderRefinement&&) noexcept = default;
BorderRefinement& BorderRefinement::operator=(BorderRefinement&&) noexcept = default;

std::optional<RefinedBorders> BorderRefinement::run(const cv::Mat& image, const BorderStart& start,
                                                    const geometry::PinholeCamera* camera,
                                                    double* worst_inliers) const {
  BorderFitLimits limits;
  const double scale = std::max(1.0, std::max(image.cols, image.rows) / kNominalSide);
  limits.radius_px *= scale;
  limits.outlier_px *= scale;
  const geometry::PinholeCamera* lens = camera && camera->hasDistortion() ? camera : nullptr;
  std::array<Line, 4> lines;
  RefinedBorders borders;
  borders.worst_inliers = 1.0;
  borders.seen = 0;
  bool good = true;
  for (int i = 0; i < 4 && good; ++i) {
    const Vector2d& from = start.quad[i];
    const Vector2d& to = start.quad[(i + 1) % 4];
    const Vector2d a = lens ? lens->undistort(from) : from, b = lens ? lens->undistort(to) : to;
    good = (b - a).norm() > kShortestPx;
    if (!good) break;
    Side side(*memory_, limits, start);
    good = side.run(image, lens, a, b) || start.fallback_sigma_px > 0.0;
    if (good && !side.fitted()) side.runWider(image, lens, a, b);
    borders.worst_inliers = std::min(borders.worst_inliers, side.inliers());
    borders.seen += side.seen();
    lines[i] = side.fitted() ? side.line() : side.start();
    const auto [begin, end] = side.ends();
    borders.edges[i] = edgeThroughLens(lines[i], begin, end, lens);
  }
  if (worst_inliers) *worst_inliers = borders.worst_inliers;
  if (!good || !finish(lines, lens, borders)) return std::nullopt;
  return borders;
}

}  // namespace window_ingress::detection
