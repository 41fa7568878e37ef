#include "detection/alignment/ring_alignment.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "detection/quads.hpp"
#include "window_ingress/geometry/unit_square.hpp"

namespace window_ingress::detection {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using geometry::Quadrilateral;

constexpr double kCoarsestPx = 15.0;  ///< resolution at which an alignment starts [px a mean side]
constexpr int kCoarseSteps = 10, kSteps = 6;
constexpr double kStill_px = 0.03;  ///< a shorter step is the last one [px of the level]
constexpr double kFurthest = 0.3;   ///< a corner may move this far from the start [mean sides]
constexpr double kMinSeen = 0.3;    ///< part of the ring
constexpr float kNoise = 0.01F;     ///< of a logarithm of a colour
constexpr float kOutlier = 2.0F;    ///< scale of the robust weights, in standard deviations
constexpr float kMinGain = 0.15F;   ///< a segment that shows less of the reference tells nothing
constexpr float kMaxGain = 2.0F;
constexpr double kGainSpread =
    0.3;  ///< of a segment's contrast over the whole ring's: standard deviation [1]
constexpr int kCoverPasses = 3;
constexpr double kMaxCovered = 1.0 / 3.0;                  ///< of the ring
constexpr double kMinRingGain = 0.8, kMaxRingGain = 1.25;  ///< of the ring: another exposure or tone curve
constexpr float kHorizon = 1e-3F, kBeyond = -1e6F;         ///< least depth, relative to the centre's
constexpr float kFirstScale = 0.2F;                        ///< of the residuals, before they are known
constexpr float kStepSpread = 0.06F,
                kPerspectiveSpread = 0.04F;  ///< of a step, before anything is measured [sides]
constexpr double kMinCorrelation = 0.05;     ///< at a level, to go on

Matrix3d centred(const Quadrilateral& quad) {
  Matrix3d shift = Matrix3d::Identity();
  shift(0, 2) = shift(1, 2) = 0.5;
  return geometry::UnitSquare(quad).matrix() * shift;
}

bool cornersOf(const Matrix3d& map, Quadrilateral& quad) {
  static const double kX[] = {-0.5, 0.5, 0.5, -0.5}, kY[] = {-0.5, -0.5, 0.5, 0.5};
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d p = map * Eigen::Vector3d(kX[i], kY[i], 1.0);
    if (!(p.z() > 1e-6)) return false;
    quad[i] = p.hnormalized();
  }
  return geometry::isFinite(quad) && geometry::isConvex(quad);
}

}  // namespace

// Of the samples that are seen.
RingAlignment::Moments RingAlignment::momentsOf(const float* ring, const float* picture, const float* weights,
                                                int begin, int end) {
  Moments m;
  for (int i = begin; i < end; ++i) {
    const float w = weights[i], x = w * ring[i], y = w * picture[i];
    m.n += w, m.x += x, m.y += y, m.xx += x * ring[i], m.yy += y * picture[i], m.xy += x * picture[i];
  }
  return m;
}

void RingAlignment::CorrelationSum::add(float samples, float xx, float yy, float xy) {
  if (!(samples > 0.0F)) return;
  const float noise = kNoise * kNoise * samples;
  const double weight = samples * std::log1p(0.5F * (xx + yy) / noise);
  alike += weight * xy / std::sqrt((xx + noise) * (yy + noise));
  most += weight;
}

void RingAlignment::set(const RingModel& model, const cv::Mat& image, const geometry::PinholeCamera* camera) {
  model_ = &model;
  lens_ = camera && camera->hasDistortion() ? camera : nullptr;
  prior_.reset();
  if (camera && model.aspect()) prior_.emplace(*camera, *model.aspect());
  pyramid_.set(image);
}

RingAlignment::Scale RingAlignment::scaleFor(double quad_side_px, double wanted_px) {
  const double most = std::min(wanted_px, model_->finest());
  const int level =
      std::clamp(static_cast<int>(std::lround(std::log2(quad_side_px / most))), 0, pyramid_.deepest());
  return {&model_->level(quad_side_px / (1 << level)), &pyramid_.level(level), level};
}

// Where the ring's samples lie on the image's level.
void RingAlignment::place(const Scale& scale, const Matrix3d& map) {
  const RingLevel& ring = *scale.ring;
  const int count = ring.size();
  at_x_.resize(count), at_y_.resize(count);
  const double factor = 1 << scale.level, shift = 0.5 * (factor - 1.0);
  Matrix3d level = Matrix3d::Identity();
  if (!lens_) level << 1.0 / factor, 0, -shift / factor, 0, 1.0 / factor, -shift / factor, 0, 0, 1;
  const Eigen::Matrix3f m = (level * map / map(2, 2)).cast<float>();
  for (int i = 0; i < count; ++i) {
    const float x = ring.x[i], y = ring.y[i], depth = m(2, 0) * x + m(2, 1) * y + 1.0F;
    const float inverse = depth > kHorizon ? 1.0F / depth : kBeyond;
    at_x_[i] = (m(0, 0) * x + m(0, 1) * y + m(0, 2)) * inverse;
    at_y_[i] = (m(1, 0) * x + m(1, 1) * y + m(1, 2)) * inverse;
  }
  if (!lens_) return;
  for (int i = 0; i < count; ++i) {
    const Vector2d at = ImagePyramid::onLevel(lens_->distort(Vector2d(at_x_[i], at_y_[i])), scale.level);
    at_x_[i] = static_cast<float>(at.x()), at_y_[i] = static_cast<float>(at.y());
  }
}

template <int kChannels>
int RingAlignment::readPixels(const cv::Mat& picture) {
  const auto count = at_x_.size();
  const auto row_step = picture.step[0];
  const auto right = static_cast<float>(picture.cols - 1), bottom = static_cast<float>(picture.rows - 1);
  int seen = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const float x = at_x_[i], y = at_y_[i];
    const bool inside = x >= 0.0F && y >= 0.0F && x < right && y < bottom;
    weights_[i] = inside ? 1.0F : 0.0F;
    seen += inside;
    if (!inside) {
      for (int c = 0; c < kChannels; ++c) values_[c * count + i] = 0.0F;
      continue;
    }
    const int column = static_cast<int>(x), row = static_cast<int>(y);
    const float u = x - static_cast<float>(column), v = y - static_cast<float>(row);
    const uchar *top = picture.data + row * row_step + column * kChannels, *below = top + row_step;
    for (int c = 0; c < kChannels; ++c) {
      const float upper = static_cast<float>(top[c]) + u * static_cast<float>(top[c + kChannels] - top[c]);
      const float lower =
          static_cast<float>(below[c]) + u * static_cast<float>(below[c + kChannels] - below[c]);
      values_[c * count + i] = logOf(upper + v * (lower - upper));
    }
    if (kChannels == 3) model_->weighColour(values_[i], values_[count + i], values_[2 * count + i]);
  }
  return seen;
}

// The image under the ring's samples; returns the part of them that lies in it.
double RingAlignment::read(const Scale& scale, const Matrix3d& map) {
  place(scale, map);
  const std::size_t count = at_x_.size();
  channels_ = scale.picture->channels();
  values_.resize(channels_ * count);
  weights_.resize(count);
  const int seen = channels_ == 1 ? readPixels<1>(*scale.picture) : readPixels<3>(*scale.picture);
  return static_cast<double>(seen) / static_cast<double>(std::max<std::size_t>(1, count));
}

RingMatch RingAlignment::compare(const Quadrilateral& quad, double side_px) {
  const Quadrilateral ideal = undistorted(quad, lens_);
  if (!geometry::isFinite(ideal) || !geometry::isConvex(ideal)) return {};
  const Scale scale = scaleFor(meanSide(ideal), side_px);
  const double seen = read(scale, centred(ideal));
  if (seen < kMinSeen) return {-1.0, seen};
  correlation_ = {};
  for (int s = 0; s < scale.ring->segmentCount(); ++s) measure(*scale.ring, s);
  return {correlation_.correlation(), seen};
}

RingMatch RingAlignment::judge(const Quadrilateral& quad, double side_px) {
  RingMatch match = compare(quad, side_px);
  if (!(correlation_.most > 0.0) || match.seen < kMinSeen) return match;
  const RingLevel& ring = *scaleFor(meanSide(undistorted(quad, lens_)), side_px).ring;
  shareOut(ring);
  match.contrast = weighContrasts();
  for (const Share& share : shares_) match.faithful += share.faithful / correlation_.most;
  for (int n = 0; n < kCoverPasses; ++n) coverOutliers(ring);
  shareOut(ring);
  weighContrasts();
  match.uncovered = uncovered(&Share::alike);
  match.faithful_uncovered = uncovered(&Share::faithful);
  return match;
}

// What each segment adds.
void RingAlignment::shareOut(const RingLevel& ring) {
  correlation_ = {};
  shares_.clear();
  for (int s = 0; s < ring.segmentCount(); ++s) {
    const CorrelationSum before = correlation_;
    const Segment segment = measure(ring, s);
    if (correlation_.most > before.most)
      shares_.push_back({correlation_.alike - before.alike, correlation_.most - before.most, segment.gain,
                         kGainSpread * kGainSpread + segment.noise / segment.xx, 0.0});
  }
}

// Where most of the ring fits well, what does not is something before it; where nothing fits, all counts.
void RingAlignment::coverOutliers(const RingLevel& ring) {
  residuals_.assign(values_.size(), 0.0F);
  const std::size_t count = ring.x.size();
  for (int s = 0; s < ring.segmentCount(); ++s) {
    const Segment segment = measure(ring, s);
    for (int c = 0; c < channels_; ++c) {
      const Moments& m = segment.moments[c];
      for (std::size_t i = segment.begin, at = c * count + i; static_cast<int>(i) < segment.end; ++i, ++at)
        residuals_[at] = values_[at] - m.meanY() - segment.gain * (ring.values[at] - m.meanX());
    }
  }
  weigh(ring.size());
  const float outlier = 1.0F / (kOutlier * scale_ * kOutlier * scale_);
  for (std::size_t i = 0; i < count; ++i) {
    if (weights_[i] == 0.0F) continue;
    float squares = 0.0F;
    for (int c = 0; c < channels_; ++c) squares += residuals_[c * count + i] * residuals_[c * count + i];
    weights_[i] = 1.0F / (1.0F + outlier * squares);
  }
}

// A frame in another paint correlates with the reference's; its contrast with the wall is another.
double RingAlignment::weighContrasts() {
  scratch_.clear();
  for (const Share& share : shares_)
    if (share.alike > 0.0 && share.gain > 0.0) scratch_.push_back(static_cast<float>(share.gain));
  if (scratch_.empty()) return 1.0;
  const auto middle = scratch_.begin() + static_cast<std::ptrdiff_t>(scratch_.size() / 2);
  std::nth_element(scratch_.begin(), middle, scratch_.end());
  const double contrast = std::clamp<double>(*middle, kMinRingGain, kMaxRingGain);
  for (Share& share : shares_) {
    if (share.alike <= 0.0 || share.gain <= 0.0) continue;
    const double off = std::log(share.gain / contrast);
    share.faithful = share.alike * std::exp(-0.5 * off * off / share.variance);
  }
  return *middle;
}

// Without the segments that fit worst: something may stand before them.
double RingAlignment::uncovered(double Share::*part) {
  std::sort(shares_.begin(), shares_.end(),
            [part](const Share& a, const Share& b) { return a.*part * b.weight < b.*part * a.weight; });
  double covered = kMaxCovered * correlation_.most, sum = 0.0;
  for (const Share& share : shares_) {
    const double hidden = std::min(covered, share.weight);
    covered -= hidden;
    sum += share.*part * (1.0 - hidden / share.weight);
  }
  return sum / ((1.0 - kMaxCovered) * correlation_.most);
}

// What one segment shows of the reference, channel by channel and in all.
RingAlignment::Segment RingAlignment::measure(const RingLevel& ring, int s) {
  Segment segment{ring.segments[s], ring.segments[s + 1], {}, 0.0F, 0.0F, 0.0F};
  float yy = 0.0F, xy = 0.0F, samples = 0.0F;
  for (int c = 0; c < channels_; ++c) {
    const std::size_t at = static_cast<std::size_t>(c) * ring.size();
    const Moments m = segment.moments[c] =
        momentsOf(ring.values.data() + at, values_.data() + at, weights_.data(), segment.begin, segment.end);
    segment.xx += m.varX(), yy += m.varY(), xy += m.cov(), samples += m.n;
  }
  correlation_.add(samples, segment.xx, yy, xy);
  segment.noise = kNoise * kNoise * samples;
  segment.xx += segment.noise;
  segment.gain = segment.xx > 0.0F ? std::min(kMaxGain, xy / segment.xx) : 0.0F;
  return segment;
}

// Residuals with the segments' gains and offsets taken off, and the normal equations with both left free.
void RingAlignment::accumulate(const RingLevel& ring, const Segment& segment, NormalSum& normal,
                               DerivativeSum& right, Matrix8f& explained) {
  DerivativeSum of_ring;  // derivatives times the ring's values
  std::array<DerivativeSum, 3> of_one;
  const float outlier = 1.0F / (kOutlier * scale_ * kOutlier * scale_);
  const std::size_t count = ring.x.size();
  for (int i = segment.begin; i < segment.end; ++i) {
    if (weights_[i] == 0.0F) continue;
    const float* monomials = ring.monomials.data() + static_cast<std::size_t>(16) * i;
    float aa = 0.0F, ab = 0.0F, bb = 0.0F, ar = 0.0F, br = 0.0F, ax = 0.0F, bx = 0.0F;
    std::size_t at = i;
    for (int c = 0; c < channels_; ++c, at += count) {
      const Moments& m = segment.moments[c];
      const float x = ring.values[at] - m.meanX(), r = values_[at] - m.meanY() - segment.gain * x;
      residuals_[at] = r;
      const float weight = 1.0F / (1.0F + outlier * r * r);
      const float a = segment.gain * ring.slopes_x[at], b = segment.gain * ring.slopes_y[at];
      const float wa = weight * a, wb = weight * b;
      aa += wa * a, ab += wa * b, bb += wb * b, ar += wa * r, br += wb * r, ax += wa * x, bx += wb * x;
      of_one[c].add(monomials, wa, wb);
    }
    normal.add(monomials, aa, ab, bb);
    right.add(monomials, ar, br);
    of_ring.add(monomials, ax, bx);
  }
  const auto take = [&explained](const Vector8f& v, float by) {
    explained.noalias() += v * (v.transpose() / by);
  };
  for (int c = 0; c < channels_; ++c)
    if (segment.moments[c].n > 0.0F) take(of_one[c].vector(), segment.moments[c].n);
  take(of_ring.vector(), segment.xx);
}

// The change of the homography that takes off most of the residuals; none if nothing tells.
std::optional<Matrix3d> RingAlignment::change(const RingLevel& ring, const Matrix3d& map) {
  NormalSum normal_sum;
  DerivativeSum right;
  Matrix8f explained = Matrix8f::Zero();  // by gains and offsets
  residuals_.assign(values_.size(), 0.0F);
  correlation_ = {};
  for (int s = 0; s < ring.segmentCount(); ++s) {
    const Segment segment = measure(ring, s);
    if (segment.gain > kMinGain) accumulate(ring, segment, normal_sum, right, explained);
  }
  weigh(ring.size());
  Matrix8f normal = normal_sum.matrix() - explained;
  const float noise = scale_ * scale_;
  for (int k = 0; k < 8; ++k) {
    const float spread = k < 6 ? kStepSpread : kPerspectiveSpread;
    normal(k, k) += noise / (spread * spread);
  }
  Vector8f toward = right.vector();
  if (prior_) prior_->addTo(map, noise, normal, toward);
  const Vector8f p = normal.ldlt().solve(toward);
  if (!p.allFinite()) return std::nullopt;
  Matrix3d change = Matrix3d::Identity();
  change.row(0) += Eigen::RowVector3f(p[0], p[1], p[2]).cast<double>();
  change.row(1) += Eigen::RowVector3f(p[3], p[4], p[5]).cast<double>();
  change(2, 0) += p[6], change(2, 1) += p[7];
  if (!(std::abs(change.determinant()) > 0.1)) return std::nullopt;
  return change;
}

// The residuals' standard deviation, from their median.
void RingAlignment::weigh(int count) {
  scratch_.clear();
  for (std::size_t i = 0; i < residuals_.size(); i += 3)
    if (weights_[i % count] > 0.0F) scratch_.push_back(std::abs(residuals_[i]));
  if (scratch_.empty()) return;
  const auto middle = scratch_.begin() + static_cast<std::ptrdiff_t>(scratch_.size() / 2);
  std::nth_element(scratch_.begin(), middle, scratch_.end());
  scale_ = std::max(kNoise, 1.48F * *middle);
}

// Steps of Gauss and Newton; of all maps passed the one with the best correlation is kept.
RingMatch RingAlignment::refine(const Scale& scale, const Quadrilateral& start, Matrix3d& map,
                                int most_steps) {
  RingMatch best;
  Matrix3d at = map;
  const double reach_px = kFurthest * meanSide(start);
  for (int n = 0;; ++n) {
    const double seen = read(scale, at);
    if (seen < kMinSeen) break;
    const auto step = change(*scale.ring, at);
    if (correlation_.correlation() > best.correlation) best = {correlation_.correlation(), seen}, map = at;
    if (!step || n == most_steps) break;
    at = at * step->inverse();
    at /= at(2, 2);
    Quadrilateral quad;
    if (!cornersOf(at, quad) || furthestCorner(quad, start) > reach_px) break;
    if ((*step - Matrix3d::Identity()).cwiseAbs().maxCoeff() * scale.ring->side_px < kStill_px)
      n = most_steps - 1;
  }
  return best;
}

std::optional<AlignedRing> RingAlignment::align(const Quadrilateral& start, double finest_px) {
  const Quadrilateral ideal = undistorted(start, lens_);
  if (!geometry::isFinite(ideal) || !geometry::isConvex(ideal)) return std::nullopt;
  Matrix3d map = centred(ideal);
  map /= map(2, 2);
  const double side_px = meanSide(ideal), finest = std::min(finest_px, side_px);
  scale_ = kFirstScale;
  AlignedRing found;
  int last_level = -1;
  for (double wanted = std::min(kCoarsestPx, finest);; wanted *= 2.0) {
    const Scale scale = scaleFor(side_px, std::min(wanted, finest));
    if (scale.level != last_level)
      found.match = refine(scale, ideal, map, last_level < 0 ? kCoarseSteps : kSteps);
    if (found.match.correlation < kMinCorrelation) return std::nullopt;
    last_level = scale.level;
    if (wanted >= finest) break;
  }
  if (!cornersOf(map, found.quad)) return std::nullopt;
  found.quad = distorted(found.quad, lens_);
  return found;
}

}  // namespace window_ingress::detection
