#include "detection/alignment/ring_view.hpp"

#include <cmath>

#include "detection/quads.hpp"
#include "window_ingress/geometry/median.hpp"
#include "window_ingress/geometry/unit_square.hpp"

namespace window_ingress::detection {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using geometry::Quadrilateral;

constexpr float kMaxGain = 2.0F;
constexpr float kUsualWeight =
    0.5F;  ///< mean of the samples', at least, where nothing stands before a segment
constexpr double kMaxCovered = 1.0 / 3.0;            ///< of the ring
constexpr float kHorizon = 1e-3F, kNowhere = -1e6F;  ///< least depth, relative to the centre's

// Of the samples that are seen.
RingMoments momentsOf(const float* ring, const float* image, const float* weights, int begin, int end) {
  RingMoments m;
  for (int i = begin; i < end; ++i) {
    const float w = weights[i], x = w * ring[i], y = w * image[i];
    m.n += w, m.x += x, m.y += y, m.xx += x * ring[i], m.yy += y * image[i], m.xy += x * image[i];
  }
  return m;
}

}  // namespace

double meanUncovered(std::vector<WeightedPart>& parts) {
  std::sort(parts.begin(), parts.end(),
            [](const WeightedPart& a, const WeightedPart& b) { return a.sum * b.weight < b.sum * a.weight; });
  double all = 0.0, sum = 0.0;
  for (const WeightedPart& part : parts) all += part.weight;
  double covered = kMaxCovered * all;
  for (const WeightedPart& part : parts) {
    const double hidden = std::min(covered, part.weight);
    covered -= hidden;
    sum += part.sum * (1.0 - hidden / part.weight);
  }
  return all > 0.0 ? sum / ((1.0 - kMaxCovered) * all) : -1.0;
}

Matrix3d mapFromCentre(const Quadrilateral& quad) {
  Matrix3d shift = Matrix3d::Identity();
  shift(0, 2) = shift(1, 2) = 0.5;
  return geometry::UnitSquare(quad).matrix() * shift;
}

void RingView::set(const RingModel& model, const cv::Mat& image, const geometry::PinholeCamera* camera,
                   bool covered) {
  model_ = &model;
  covered_ = covered;
  lens_ = lensOf(camera);
  pyramid_.set(image);
}

RingView::Scale RingView::scaleFor(double quad_side_px, double wanted_px) {
  const double most = std::min(wanted_px, model_->finest());
  const int level =
      std::clamp(static_cast<int>(std::lround(std::log2(quad_side_px / most))), 0, pyramid_.deepest());
  return {&model_->level(quad_side_px / (1 << level)), &pyramid_.level(level), level};
}

// Where the ring's samples lie on the image's level.
void RingView::place(const Matrix3d& map, int level) {
  const int count = ring_->size();
  at_x_.resize(count), at_y_.resize(count);
  const double factor = 1 << level, shift = 0.5 * (factor - 1.0);
  Matrix3d reduced = Matrix3d::Identity();
  if (!lens_) reduced << 1.0 / factor, 0, -shift / factor, 0, 1.0 / factor, -shift / factor, 0, 0, 1;
  const Eigen::Matrix3f m = (reduced * map / map(2, 2)).cast<float>();
  for (int i = 0; i < count; ++i) {
    const float x = ring_->x[i], y = ring_->y[i], depth = m(2, 0) * x + m(2, 1) * y + 1.0F;
    const float inverse = depth > kHorizon ? 1.0F / depth : kNowhere;
    at_x_[i] = (m(0, 0) * x + m(0, 1) * y + m(0, 2)) * inverse;
    at_y_[i] = (m(1, 0) * x + m(1, 1) * y + m(1, 2)) * inverse;
  }
  if (!lens_) return;
  for (int i = 0; i < count; ++i) {
    const Vector2d at = ImagePyramid::onLevel(lens_->distort(Vector2d(at_x_[i], at_y_[i])), level);
    at_x_[i] = static_cast<float>(at.x()), at_y_[i] = static_cast<float>(at.y());
  }
}

int RingView::readPixels(const cv::Mat& image, bool keeps_weights) {
  const auto count = at_x_.size();
  const auto row_step = image.step[0];
  const auto right = static_cast<float>(image.cols - 1), bottom = static_cast<float>(image.rows - 1);
  int seen = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const float x = at_x_[i], y = at_y_[i];
    const bool inside = x >= 0.0F && y >= 0.0F && x < right && y < bottom;
    weights_[i] = !inside ? 0.0F : keeps_weights && weights_[i] > 0.0F ? weights_[i] : 1.0F;
    seen += inside;
    if (!inside) {
      for (int c = 0; c < kRingChannels; ++c) values_[c * count + i] = 0.0F;
      continue;
    }
    const int column = static_cast<int>(x), row = static_cast<int>(y);
    const float u = x - static_cast<float>(column), v = y - static_cast<float>(row);
    const uchar *top = image.data + row * row_step + column * kRingChannels, *below = top + row_step;
    for (int c = 0; c < kRingChannels; ++c) {
      const float upper =
          static_cast<float>(top[c]) + u * static_cast<float>(top[c + kRingChannels] - top[c]);
      const float lower =
          static_cast<float>(below[c]) + u * static_cast<float>(below[c + kRingChannels] - below[c]);
      values_[c * count + i] = logOf(upper + v * (lower - upper));
    }
    model_->weighColour(values_[i], values_[count + i], values_[2 * count + i]);
  }
  return seen;
}

double RingView::look(const Scale& scale, const Matrix3d& map, bool nearby) {
  ring_ = scale.ring;
  place(map, scale.level);
  const std::size_t count = at_x_.size();
  values_.resize(kRingChannels * count);
  weights_.resize(count);
  const int seen = readPixels(*scale.image, covered_ && nearby);
  if (covered_) coverOutliers(nearby ? 1 : kCoverPasses);
  return static_cast<double>(seen) / static_cast<double>(std::max<std::size_t>(1, count));
}

double RingView::look(const Quadrilateral& quad, double side_px) {
  const Quadrilateral ideal = undistorted(quad, lens_);
  if (!geometry::isFinite(ideal) || !geometry::isConvex(ideal)) return 0.0;
  return look(scaleFor(meanSide(ideal), side_px), mapFromCentre(ideal));
}

float RingView::meanLog() const {
  float sum = 0.0F, seen = 0.0F;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const float weight = weights_[i % weights_.size()];
    sum += weight * values_[i], seen += weight;
  }
  return seen > 0.0F ? sum / seen : 0.0F;
}

RingSegment RingView::segment(int s) const {
  RingSegment segment;
  segment.begin = ring_->segments[s], segment.end = ring_->segments[s + 1];
  float yy = 0.0F, xy = 0.0F, samples = 0.0F;
  for (int c = 0; c < kRingChannels; ++c) {
    const std::size_t at = static_cast<std::size_t>(c) * ring_->size();
    const RingMoments m = segment.moments[c] = momentsOf(ring_->values.data() + at, values_.data() + at,
                                                         weights_.data(), segment.begin, segment.end);
    segment.xx += m.varX(), yy += m.varY(), xy += m.cov(), samples += m.n;
  }
  if (!(samples > 0.0F)) return segment;
  segment.noise = kNoise * kNoise * samples;
  segment.weight = samples * std::log1p(0.5F * (segment.xx + yy) / segment.noise);
  segment.xx += segment.noise;
  segment.alike = segment.weight * xy / std::sqrt(segment.xx * (yy + segment.noise));
  segment.gain = std::min(kMaxGain, xy / segment.xx);
  if (!covered_) return segment;
  const auto seen = std::count_if(weights_.begin() + segment.begin, weights_.begin() + segment.end,
                                  [](float weight) { return weight > 0.0F; });
  const float usual = kUsualWeight * static_cast<float>(seen * kRingChannels);
  segment.covered_weight = segment.weight * std::max(0.0F, usual / samples - 1.0F);
  return segment;
}

void RingView::coverOutliers(int passes) {
  for (int n = 0; n < passes; ++n) weighByResiduals();
}

// A step of iteratively reweighted least squares: gains and offsets of the segments follow from the weights.
void RingView::weighByResiduals() {
  const std::size_t count = ring_->x.size();
  residuals_.assign(count * kRingChannels, 0.0F);
  for (int s = 0; s < ring_->segmentCount(); ++s) {
    const RingSegment fitted = segment(s);
    for (int c = 0; c < kRingChannels; ++c) {
      const RingMoments& m = fitted.moments[c];
      for (std::size_t i = fitted.begin, at = c * count + i; static_cast<int>(i) < fitted.end; ++i, ++at)
        residuals_[at] = values_[at] - m.meanY() - fitted.gain * (ring_->values[at] - m.meanX());
    }
  }
  const float outlier = robustFactor(spreadOf(residuals_, kNoise));
  for (std::size_t i = 0; i < count; ++i) {
    if (weights_[i] == 0.0F) continue;
    float squares = 0.0F;
    for (int c = 0; c < kRingChannels; ++c) squares += residuals_[c * count + i] * residuals_[c * count + i];
    weights_[i] = 1.0F / (1.0F + outlier * squares);
  }
}

float RingView::spreadOf(const std::vector<float>& residuals, float before) {
  scratch_.clear();
  for (std::size_t i = 0; i < residuals.size(); i += 3)
    if (weights_[i % weights_.size()] > 0.0F) scratch_.push_back(std::abs(residuals[i]));
  if (scratch_.empty()) return before;
  return std::max(kNoise, 1.48F * geometry::median(scratch_));
}

}  // namespace window_ingress::detection
