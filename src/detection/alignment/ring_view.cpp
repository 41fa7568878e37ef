#include "detection/alignment/ring_view.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>

#include "window_ingress/geometry/unit_square.hpp"

namespace window_ingress::detection {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using geometry::Quadrilateral;

constexpr float kMaxGain = 2.0F;
constexpr float kUsualWeight = 0.5F;                 ///< least mean sample weight of an uncovered segment
constexpr double kMaxCovered = 1.0 / 3.0;            ///< of the ring
constexpr float kHorizon = 1e-3F, kNowhere = -1e6F;  ///< least depth over the centre's; outside any image

using Ints = std::int32_t __attribute__((vector_size(16)));

// The colours in their byte positions: green is 256 and red 65536 times too large, exact as float.
Channels unscaled(std::uint32_t bytes) {
  const auto all = static_cast<std::int32_t>(bytes);
  return __builtin_convertvector(Ints{all, all, all, all} & Ints{0xff, 0xff00, 0xff0000, 0}, Channels);
}

// Interpolates between two adjacent pixels. Reads only their six bytes.
Channels unscaledBetween(const uchar* left, float u) {
  std::uint32_t first = 0, last = 0;
  std::memcpy(&first, left, 4), std::memcpy(&last, left + 2, 4);
  const Channels colour = unscaled(first);
  return colour + u * (unscaled(last >> 8) - colour);
}

// Bilinear interpolation.
Channels colourAt(const cv::Mat& image, float x, float y) {
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  const float u = x - static_cast<float>(column), v = y - static_cast<float>(row);
  const uchar* pixel = image.data + row * image.step[0] + column * kRingChannels;
  const Channels upper = unscaledBetween(pixel, u), lower = unscaledBetween(pixel + image.step[0], u);
  return (upper + v * (lower - upper)) * Channels{1.0F, 1.0F / 256.0F, 1.0F / 65536.0F, 0.0F};
}

Channels logsOf(Channels colour) {
  const auto whole = __builtin_convertvector(colour, Ints);
  const auto log = [&whole](int c, int more) { return kLogsOfColours[whole[c] + more]; };
  const Channels low{log(0, 0), log(1, 0), log(2, 0), 0.0F}, high{log(0, 1), log(1, 1), log(2, 1), 0.0F};
  return low + (colour - __builtin_convertvector(whole, Channels)) * (high - low);
}

// Weighted moments of ring (x) and image (y) over one segment.
struct RingMoments {
  float n = 0.0F;
  Channels x{}, y{}, xx{}, yy{}, xy{};
};

// \param ring, image channel by channel, `count` samples each
RingMoments momentsOf(const float* ring, const float* image, const float* weights, int count, int begin,
                      int end) {
  const auto at = [count](const float* of, int i) {
    return Channels{of[i], of[count + i], of[2 * count + i], 0.0F};
  };
  RingMoments m;
  for (int i = begin; i < end; ++i) {
    const Channels x = at(ring, i), y = at(image, i), wx = weights[i] * x, wy = weights[i] * y;
    m.n += weights[i], m.x += wx, m.y += wy, m.xx += wx * x, m.yy += wy * y, m.xy += wx * y;
  }
  return m;
}

// Median of non-negative numbers, as geometry::median but faster: orders only values that share the median's
// leading bits. Changes `values`.
float middleOf(std::vector<float>& values) {
  const auto begins = [](float value) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof(bits));
    return bits >> 20;  // sign, exponent, three more bits
  };
  std::array<std::size_t, 2048> counts{};
  for (const float value : values) ++counts[begins(value)];
  std::size_t left = values.size() / 2, middle = 0;
  for (; counts[middle] <= left; ++middle) left -= counts[middle];
  const auto is_other = [&](float value) { return begins(value) != middle; };
  values.erase(std::remove_if(values.begin(), values.end(), is_other), values.end());
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(left), values.end());
  return values[left];
}

}  // namespace

WeightedSum correlationOf(const std::vector<RingSegment>& segments) {
  WeightedSum all;
  for (const RingSegment& segment : segments) all.sum += segment.alike, all.weight += segment.weight;
  return all;
}

void addParts(double value, const RingSegment& segment, std::vector<WeightedSum>& parts) {
  if (segment.weight > 0.0) parts.push_back({value, segment.weight});
  if (segment.covered_weight > 0.0) parts.push_back({0.0, segment.covered_weight});
}

double meanUncovered(std::vector<WeightedSum>& parts) {
  std::sort(parts.begin(), parts.end(),
            [](const WeightedSum& a, const WeightedSum& b) { return a.sum * b.weight < b.sum * a.weight; });
  double all = 0.0, sum = 0.0;
  for (const WeightedSum& part : parts) all += part.weight;
  double covered = kMaxCovered * all;
  for (const WeightedSum& part : parts) {
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

void RingView::set(const RingModel& model, const cv::Mat& image, const geometry::PinholeCamera* camera) {
  model_ = &model;
  lens_ = geometry::lensOf(camera);
  pyramid_.set(image);
}

RingView::Scale RingView::scaleFor(double quad_side_px, double wanted_px) {
  const double most = std::min(wanted_px, model_->levels.back().side_px);
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
  const auto right = static_cast<float>(image.cols - 1), bottom = static_cast<float>(image.rows - 1);
  float *blue = values_.data(), *green = blue + count, *red = green + count;
  int seen = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const float x = at_x_[i], y = at_y_[i];
    if (!(x >= 0.0F && y >= 0.0F && x < right && y < bottom)) {
      blue[i] = green[i] = red[i] = weights_[i] = 0.0F;
      continue;
    }
    ++seen;
    if (!(keeps_weights && weights_[i] > 0.0F)) weights_[i] = 1.0F;
    const Channels logs = logsOf(colourAt(image, x, y));
    blue[i] = logs[0], green[i] = logs[1], red[i] = logs[2];
  }
  model_->weighColour(blue, green, red, count);
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
  const Quadrilateral ideal = geometry::undistorted(quad, lens_);
  if (!geometry::isFinite(ideal) || !geometry::isConvex(ideal)) return 0.0;
  return look(scaleFor(geometry::meanSide(ideal), side_px), mapFromCentre(ideal));
}

float RingView::meanLog() const {
  float sum = 0.0F, seen = 0.0F;
  for (auto of_channel = values_.begin(); of_channel != values_.end();)
    for (const float weight : weights_) sum += weight * *of_channel++, seen += weight;
  return seen > 0.0F ? sum / seen : 0.0F;
}

RingSegment RingView::segment(int s) const {
  RingSegment segment;
  segment.begin = ring_->segments[s], segment.end = ring_->segments[s + 1];
  const RingMoments m = momentsOf(ring_->values.data(), values_.data(), weights_.data(), ring_->size(),
                                  segment.begin, segment.end);
  if (!(m.n > 0.0F)) return segment;
  segment.seen = m.n, segment.ring_mean = m.x / m.n, segment.mean = m.y / m.n;
  const Channels squares_x = m.xx - m.x * segment.ring_mean, squares_y = m.yy - m.y * segment.mean,
                 products = m.xy - m.x * segment.mean;
  float yy = 0.0F, xy = 0.0F, samples = 0.0F;
  for (int c = 0; c < kRingChannels; ++c) {
    segment.xx += std::max(0.0F, squares_x[c]), yy += std::max(0.0F, squares_y[c]);
    xy += products[c], samples += m.n;
  }
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

const std::vector<RingSegment>& RingView::segments() {
  segments_.clear();
  for (int s = 0; s < ring_->segmentCount(); ++s) segments_.push_back(segment(s));
  return segments_;
}

// Iteratively reweighted least squares; segment gains and offsets follow from the weights.
void RingView::coverOutliers(int passes) {
  const std::size_t count = weights_.size();
  residuals_.resize(kRingChannels * count);
  for (int n = 0; n < passes; ++n) {
    for (const RingSegment& segment : segments()) leaveOver(segment, residuals_);
    const float outlier = robustFactor(spreadOf(residuals_, kNoise));
    const float *blue = residuals_.data(), *green = blue + count, *red = green + count;
    for (std::size_t i = 0; i < count; ++i) {
      const float squares = blue[i] * blue[i] + green[i] * green[i] + red[i] * red[i];
      weights_[i] = static_cast<float>(weights_[i] > 0.0F) / (1.0F + outlier * squares);
    }
  }
}

void RingView::leaveOver(const RingSegment& segment, std::vector<float>& residuals) const {
  for (int c = 0; c < kRingChannels; ++c) {
    const float gain = segment.gain, ring_mean = segment.ring_mean[c], mean = segment.mean[c];
    const std::size_t at = c * weights_.size() + segment.begin;
    const float *ring = ring_->values.data() + at, *values = values_.data() + at;
    float* left = residuals.data() + at;
    for (int i = 0; i < segment.end - segment.begin; ++i)
      left[i] = values[i] - mean - gain * (ring[i] - ring_mean);
  }
}

float RingView::spreadOf(const std::vector<float>& residuals, float before) {
  scratch_.resize(weights_.size() + 1);
  std::size_t kept = 0;
  for (std::size_t i = 0, sample = 0; i < residuals.size(); i += 3, sample += 3) {
    if (sample >= weights_.size()) sample -= weights_.size();
    scratch_[kept] = std::abs(residuals[i]), kept += weights_[sample] > 0.0F;
  }
  scratch_.resize(kept);
  if (scratch_.empty()) return before;
  return std::max(kNoise, 1.48F * middleOf(scratch_));
}

}  // namespace window_ingress::detection
