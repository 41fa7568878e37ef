#include "detection/alignment/ring_alignment.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace window_ingress::detection {
namespace {

using Eigen::Matrix3d;
using geometry::Quadrilateral;

constexpr int kCoarseSteps = 10, kFineSteps = 6, kLastSteps = 20;
constexpr double kStill_px = 0.04;  ///< a shorter step ends the alignment [px of the level]
constexpr int kPatience = 5;        ///< the alignment ends after this many steps without a better correlation
constexpr double kFurthest = 0.3;   ///< a corner may move this far from the start [mean sides]
constexpr float kMinGain = 0.15F;   ///< segments with a smaller gain are not used
constexpr double kMinAlike = 0.6;   ///< a segment below this part of the ring's correlation may be covered
constexpr double kByChance = 0.1;   ///< correlation that arises by chance where misfits count as covered
constexpr double kThreeSides = 0.75;   ///< least correlation of three sides that can determine the fourth
constexpr double kContradicts = 1.5;   ///< misfit above which one side of a view may be wrong [sigma]
constexpr double kHiddenSide = 0.05;   ///< gain in correlation without one side that shows it is hidden
constexpr double kKnownAspect = 0.03;  ///< standard deviation of its logarithm for three sides to suffice
constexpr float kFirstSpread = 0.2F;   ///< of the residuals, initially
constexpr float kStepSpread = 0.06F, kPerspectiveSpread = 0.04F;  ///< prior of a step [sides]
constexpr double kMinCorrelation = 0.05;                          ///< needed at a level to continue
constexpr double kDependent = 3.0;                                ///< samples per independent noise value
constexpr float kDimRing = 40.0F;     ///< the noise of a darker ring shows in the logarithms [grey levels]
constexpr double kLeastInView = 0.5;  ///< least visible part of the ring for a side to be known
constexpr double kFloorPx = 0.03;     ///< least standard deviation of a side
/// Tolerances of a frame: out of true, and standing out of the opening's plane [sides].
constexpr double kOutOfTrue = 0.0003, kStandsOut = 0.005;

void leaveOut(int side, std::vector<RingSegment>& segments) {
  const auto a_side = static_cast<std::ptrdiff_t>(segments.size() / 4);
  std::fill_n(segments.begin() + side * a_side, a_side, RingSegment());
}

}  // namespace

void RingAlignment::set(const RingModel& model, const cv::Mat& image, const geometry::PinholeCamera* camera) {
  view_.set(model, image, camera);
  prior_.reset();
  if (model.aspect)
    prior_ = camera ? RectanglePrior(*camera, *model.aspect) : RectanglePrior(image.size(), *model.aspect);
  leaves_out_ = prior_ && model.aspect->log_sigma <= kKnownAspect;
}

// Leaving out what does not fit raises the correlation by chance.
double RingAlignment::beyondChance(double correlation) const {
  return view_.covered() ? correlation - kByChance : correlation;
}

double RingAlignment::correlation(const Quadrilateral& quad, double side_px) {
  if (view_.look(quad, side_px) < RingView::kMinSeen) return -1.0;
  return beyondChance(correlationOf(view_.segments()).mean());
}

RingMatch RingAlignment::judge(const Quadrilateral& quad, double side_px) {
  double seen = view_.look(quad, side_px);
  if (view_.meanLog() < logOf(kDimRing))
    seen = view_.look(quad, 0.5 * std::min(side_px, geometry::meanSide(quad)));
  RingMatch match;
  if (seen >= RingView::kMinSeen) match = matchOf(view_);
  match.correlation = beyondChance(match.correlation);
  return match;
}

// `count` is at most kMost. The loops run per channel and without a branch, so that the compiler vectorizes
// them by fours.
RingAlignment::SlopeProducts RingAlignment::products(const RingSegment& segment, int begin, int count) const {
  const RingLevel& ring = view_.ring();
  const float outlier = robustFactor(spread_), gain = segment.gain, *weights = view_.weights() + begin;
  SlopeProducts p;
  for (int c = 0; c < kRingChannels; ++c) {
    const auto at = static_cast<std::size_t>(c * ring.size() + begin);
    const float *values = ring.values.data() + at, *residuals = residuals_.data() + at;
    const float *slopes_x = ring.slopes_x.data() + at, *slopes_y = ring.slopes_y.data() + at;
    const float mean = segment.ring_mean[c];
    for (int k = 0; k < count; ++k) {
      const float x = values[k] - mean, r = residuals[k];
      const float weight = weights[k] / (1.0F + outlier * r * r);
      const float a = gain * slopes_x[k], b = gain * slopes_y[k], wa = weight * a, wb = weight * b;
      p.aa[k] += wa * a, p.ab[k] += wa * b, p.bb[k] += wb * b;
      p.ar[k] += wa * r, p.br[k] += wb * r, p.ax[k] += wa * x, p.bx[k] += wb * x;
      p.a[c][k] = wa, p.b[c][k] = wb;
    }
  }
  return p;
}

// Residuals after removal of a segment's gain and offsets, and normal equations with both left free.
void RingAlignment::accumulate(const RingSegment& segment, NormalSum& normal, DerivativeSum& right,
                               Matrix8f& explained) {
  DerivativeSum of_ring;  // derivatives times the ring's values
  std::array<DerivativeSum, kRingChannels> of_one;
  view_.leaveOver(segment, residuals_);
  for (int begin = segment.begin; begin < segment.end; begin += SlopeProducts::kMost) {
    const int count = std::min(SlopeProducts::kMost, segment.end - begin);
    const SlopeProducts p = products(segment, begin, count);
    const float* monomials = view_.ring().monomials.data() + static_cast<std::size_t>(16) * begin;
    normal.add(monomials, p.aa.data(), p.ab.data(), p.bb.data(), count);
    right.add(monomials, p.ar.data(), p.br.data(), count);
    of_ring.add(monomials, p.ax.data(), p.bx.data(), count);
    for (int c = 0; c < kRingChannels; ++c) of_one[c].add(monomials, p.a[c].data(), p.b[c].data(), count);
  }
  const auto take = [&explained](const Vector8f& v, float by) {
    explained.noalias() += v * (v.transpose() / by);
  };
  for (const DerivativeSum& of_channel : of_one) take(of_channel.vector(), segment.seen);
  take(of_ring.vector(), segment.xx);
}

// How well the ring fits; where the shape is known, covered parts do not count.
double RingAlignment::fit() {
  if (!leaves_out_) return correlationOf(segments_).mean();
  parts_.clear();
  for (const RingSegment& segment : segments_) addParts(segment.alike, segment, parts_);
  return meanUncovered(parts_);
}

// The change of the homography that removes most of the residuals; none if the samples do not determine one.
std::optional<Matrix3d> RingAlignment::change(const Matrix3d& map) {
  NormalSum normal_sum;
  DerivativeSum right;
  Matrix8f explained = Matrix8f::Zero();  // by gains and offsets
  residuals_.assign(view_.ring().x.size() * kRingChannels, 0.0F);
  const double least = leaves_out_ ? kMinAlike * correlationOf(segments_).mean() : -1.0;
  for (const RingSegment& segment : segments_)
    if (segment.gain > kMinGain && segment.alike >= least * segment.weight)
      accumulate(segment, normal_sum, right, explained);
  spread_ = view_.spreadOf(residuals_, spread_);
  normal_ = normal_sum.matrix() - explained;
  const float noise = spread_ * spread_;
  for (int k = 0; k < 8; ++k) {
    const float spread = k < 6 ? kStepSpread : kPerspectiveSpread;
    normal_(k, k) += noise / (spread * spread);
  }
  Vector8f toward = right.vector();
  if (prior_) prior_->addTo(map, noise, normal_, toward);
  return homographyOf(normal_.ldlt().solve(toward));
}

// Gauss-Newton steps. Keeps the map that fits best, returns its correlation.
double RingAlignment::refine(const RingView::Scale& scale, const Quadrilateral& start, Matrix3d& map,
                             int most_steps, const std::optional<int>& hidden) {
  double best = -1.0;
  Matrix3d at = map;
  const double reach_px = kFurthest * geometry::meanSide(start);
  int best_step = 0;
  double best_fit = -1.0;
  for (int n = 0;; ++n) {
    if (view_.look(scale, at, n > 0) < RingView::kMinSeen) break;
    segments_ = view_.segments();
    if (hidden) leaveOut(*hidden, segments_);
    const auto step = change(at);
    if (const double fits = fit(); fits > best_fit) {
      best_fit = fits, best_step = n, map = at;
      best = beyondChance(correlationOf(segments_).mean());
      information_ = normal_ / (spread_ * spread_);
    }
    if (!step || n == most_steps || n - best_step == kPatience) break;
    at = at * step->inverse();
    at /= at(2, 2);
    const auto quad = cornersOf(at);
    if (!quad || geometry::furthestCorner(*quad, start) > reach_px) break;
    if ((*step - Matrix3d::Identity()).cwiseAbs().maxCoeff() * scale.ring->side_px < kStill_px)
      n = most_steps - 1;
  }
  return best;
}

// Visible part of the ring beside a side, at the last place looked at; 1 where the reference shows none.
double RingAlignment::partInView(int side) const {
  const int a_side = view_.ring().segmentCount() / 4;
  const int begin = view_.ring().segments[side * a_side], end = view_.ring().segments[(side + 1) * a_side];
  const auto hidden = std::count(view_.weights() + begin, view_.weights() + end, 0.0F);
  return end > begin ? 1.0 - static_cast<double>(hidden) / (end - begin) : 1.0;
}

// From the spread of the residuals, and the tolerances of frames.
std::array<SideSigma, 4> RingAlignment::sidesOf(const Matrix3d& map) const {
  std::array<SideSigma, 4> sides{};
  const auto quad = cornersOf(map);
  if (!prior_ || !quad) return sides;
  const Eigen::Matrix<double, 8, 8> covariance = kDependent * information_.cast<double>().inverse();
  const auto views = prior_->viewsOfSides(map);
  const bool framed = view_.model().framed;
  for (int i = 0; i < 4; ++i) {
    if (partInView(i) < kLeastInView || (framed && views[i].from_beyond)) continue;
    const int next = (i + 1) % 4;
    const Eigen::Vector2d along = (*quad)[next] - (*quad)[i];
    const double length = along.norm();
    const Eigen::Vector2d normal = Eigen::Vector2d(along.y(), -along.x()) / length;
    const RowVector8d from = slopeAcross(map, i, normal), to = slopeAcross(map, next, normal);
    const auto spread = [&](const RowVector8d& v) { return std::sqrt((v * covariance * v.transpose())(0)); };
    const double uneven =
        kFloorPx / length + (framed ? kOutOfTrue + kStandsOut * views[i].tangent : 0.0);  // [sides]
    sides[i] = {std::hypot(spread(0.5 * (from + to)), uneven * length),
                std::hypot(spread(to - from) / length, uneven * std::sqrt(12.0))};
    if (!std::isfinite(sides[i].px) || !std::isfinite(sides[i].rad)) sides[i] = {};
  }
  return sides;
}

std::optional<AlignedRing> RingAlignment::align(const Quadrilateral& start, double finest_px,
                                                double coarsest_px) {
  const Quadrilateral ideal = geometry::undistorted(start, view_.lens());
  if (!geometry::isFinite(ideal) || !geometry::isConvex(ideal)) return std::nullopt;
  Matrix3d map = mapFromCentre(ideal);
  map /= map(2, 2);
  const double side_px = geometry::meanSide(ideal), finest = std::min(finest_px, side_px);
  spread_ = kFirstSpread;
  double correlation = -1.0;
  int last_level = -1;
  bool is_last = false;
  for (double wanted = std::min(coarsest_px, finest); !is_last; wanted *= 2.0) {
    const RingView::Scale scale = view_.scaleFor(side_px, std::min(wanted, finest));
    is_last = wanted >= finest;
    const int steps = is_last ? kLastSteps : last_level < 0 ? kCoarseSteps : kFineSteps;
    if (scale.level != last_level || is_last) correlation = refine(scale, ideal, map, steps);
    if (correlation < kMinCorrelation) return std::nullopt;
    last_level = scale.level;
  }
  return ringAt(map, correlation);
}

// The ring at the last place that `refine` found.
std::optional<AlignedRing> RingAlignment::ringAt(const Matrix3d& map, double correlation) const {
  const auto quad = cornersOf(map);
  if (!quad || correlation < kMinCorrelation) return std::nullopt;
  return AlignedRing{geometry::distorted(*quad, view_.lens()), correlation, sidesOf(map), std::nullopt};
}

// The side that something covers: three sides fit far better without it. Nothing otherwise.
std::optional<int> RingAlignment::hiddenSide() {
  const std::vector<RingSegment>& segments = view_.segments();
  double most = std::max(kThreeSides, correlationOf(segments).mean() + kHiddenSide);
  std::optional<int> hidden;
  for (int side = 0; side < 4; ++side) {
    std::vector<RingSegment> others = segments;
    leaveOut(side, others);
    if (const double fits = correlationOf(others).mean(); fits > most) most = fits, hidden = side;
  }
  return hidden;
}

std::optional<AlignedRing> RingAlignment::uncovered(const Quadrilateral& quad, double finest_px) {
  const Quadrilateral ideal = geometry::undistorted(quad, view_.lens());
  if (!leaves_out_ || !geometry::isFinite(ideal) || !geometry::isConvex(ideal)) return std::nullopt;
  Matrix3d map = mapFromCentre(ideal);
  map /= map(2, 2);
  if (prior_->misfit(map) < kContradicts) return std::nullopt;
  const double side_px = geometry::meanSide(ideal);
  const RingView::Scale scale = view_.scaleFor(side_px, std::min(finest_px, side_px));
  view_.look(scale, map);
  const auto hidden = hiddenSide();
  const auto start = hidden ? prior_->completed(map, *hidden) : std::nullopt;
  if (!start) return std::nullopt;
  map = start->map;
  const double correlation = refine(scale, ideal, map, kLastSteps, hidden);
  auto found = ringAt(map, correlation);
  if (!found) return std::nullopt;
  found->hidden = hidden;
  found->sides[*hidden] = {start->sigma_px, start->sigma_px * std::sqrt(12.0) / side_px};
  return found;
}

std::optional<Quadrilateral> RingAlignment::completed(const Quadrilateral& quad, int side) const {
  const Quadrilateral ideal = geometry::undistorted(quad, view_.lens());
  if (!prior_ || !geometry::isFinite(ideal) || !geometry::isConvex(ideal)) return std::nullopt;
  const auto view = prior_->completed(mapFromCentre(ideal), side);
  const auto whole = view ? cornersOf(view->map) : std::nullopt;
  if (!whole) return std::nullopt;
  return geometry::distorted(*whole, view_.lens());
}

}  // namespace window_ingress::detection
