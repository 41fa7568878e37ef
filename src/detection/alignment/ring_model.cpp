#include "detection/alignment/ring_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "detection/alignment/homography_sums.hpp"
#include "detection/image_pyramid.hpp"
#include "window_ingress/geometry/unit_square.hpp"

namespace window_ingress::detection {
namespace {

using Eigen::Vector2d;
using geometry::Quadrilateral;

constexpr double kCoarsest = 14.0, kFinest = 400.0;     ///< levels [samples per mean side]
constexpr double kBlur = 0.5;                           ///< of a level [samples]
constexpr int kFewestSamples = 40, kMaxSamples = 2400;  ///< of a level
constexpr double kSteepPart = 0.67;  ///< part of them with the largest slopes; the rest is spread evenly
constexpr float kDark = 4.0F;        ///< added to colours: least light that counts [grey levels]
constexpr float kMiddle = 90.0F;  ///< its logarithm is 0: sums of small numbers are more exact [grey levels]

using Colour = Eigen::Array<float, kRingChannels, 1>;

/// One sample of the image, before sorting by segment.
struct Sample {
  float x, y;
  Colour value, slope_x, slope_y;
  int segment;
  float steepness;
};

// Far away the whole ring counts; near the window only its inner part, as the rest may lie in another plane.
double widthOf(double side_px) { return side_px < 28.0 ? RingModel::kWidth : 0.7 * RingModel::kWidth; }

// Least distance from the opening [mean sides]: nearer to it, colours mix with those in it. At low resolution
// the distance is one pixel only, to keep samples.
double clearOf(double side_px) { return (side_px < 28.0 ? 1.0 : 2.0) / side_px; }

int segmentsASide(double side_px) { return side_px < 28.0 ? 2 : side_px < 80.0 ? 4 : 6; }

// Index of the nearest segment; -1 within the opening or outside the ring.
int segmentOf(const Vector2d& p, const Vector2d& shape, double side_px, int a_side) {
  const double out_x = (std::abs(p.x()) - 0.5) * shape.x(), out_y = (std::abs(p.y()) - 0.5) * shape.y();
  const double out = std::max(out_x, out_y);
  if (out < clearOf(side_px) || out > widthOf(side_px)) return -1;
  const bool upright = out_x > out_y;
  const int side = upright ? (p.x() > 0.0 ? 1 : 3) : (p.y() > 0.0 ? 2 : 0);
  const double length = upright ? shape.y() : shape.x(), along = (upright ? p.y() : p.x()) * length;
  const double part = along / (length + 2.0 * RingModel::kWidth) + 0.5;
  return side * a_side + std::clamp(static_cast<int>(part * a_side), 0, a_side - 1);
}

/// The reference image, smoothed for one level.
struct SmoothImage {
  // The colour at a point of the opening's plane, between pixels; false outside the image.
  bool read(const Vector2d& p, Colour& value) const {
    const Vector2d at = ImagePyramid::onLevel(map.toImage(p + Vector2d(0.5, 0.5)), level);
    if (!(at.x() >= 0.0 && at.y() >= 0.0 && at.x() < pixels.cols - 1 && at.y() < pixels.rows - 1))
      return false;
    const int column = static_cast<int>(at.x()), row = static_cast<int>(at.y());
    const auto u = static_cast<float>(at.x() - column), v = static_cast<float>(at.y() - row);
    const auto *top = pixels.ptr<Colour>(row) + column, *bottom = pixels.ptr<Colour>(row + 1) + column;
    value = (1.0F - v) * ((1.0F - u) * top[0] + u * top[1]) + v * ((1.0F - u) * bottom[0] + u * bottom[1]);
    value = value.unaryExpr(&logOf);
    model.weighColour(&value[0], &value[1], &value[2], 1);
    return true;
  }

  cv::Mat pixels;
  const geometry::UnitSquare& map;
  int level;
  const RingModel& model;
};

bool sampleAt(const SmoothImage& image, const Vector2d& p, const Vector2d& half_step, Sample& sample) {
  const Vector2d across(half_step.x(), 0), down(0, half_step.y());
  Colour left, right, above, below;
  if (!image.read(p, sample.value) || !image.read(p - across, left) || !image.read(p + across, right) ||
      !image.read(p - down, above) || !image.read(p + down, below))
    return false;
  sample.x = static_cast<float>(p.x()), sample.y = static_cast<float>(p.y());
  sample.slope_x = (right - left) / static_cast<float>(2.0 * half_step.x());
  sample.slope_y = (below - above) / static_cast<float>(2.0 * half_step.y());
  const Colour squares = sample.slope_x.square() + sample.slope_y.square();
  sample.steepness = squares[0] + squares[1] + squares[2];
  return true;
}

// Keeps the steepest samples of each segment, and an even choice of the rest.
void thinOut(std::vector<Sample>& samples, int segments) {
  if (static_cast<int>(samples.size()) <= kMaxSamples) return;
  const int steep = static_cast<int>(kSteepPart * kMaxSamples / segments);
  const int others = kMaxSamples / segments - steep;
  std::vector<Sample> kept;
  for (auto begin = samples.begin(); begin != samples.end();) {
    const auto end =
        std::find_if(begin, samples.end(), [&](const Sample& s) { return s.segment != begin->segment; });
    const auto middle = begin + std::min<std::ptrdiff_t>(steep, end - begin);
    std::nth_element(begin, middle == end ? begin : middle, end,
                     [](const Sample& a, const Sample& b) { return a.steepness > b.steepness; });
    kept.insert(kept.end(), begin, middle);
    const std::ptrdiff_t left = end - middle, more = std::min<std::ptrdiff_t>(others, left);
    for (std::ptrdiff_t k = 0; k < more; ++k) kept.push_back(*(middle + k * left / more));
    begin = end;
  }
  samples.swap(kept);
}

RingLevel levelFrom(const std::vector<Sample>& samples, int segments, double side_px) {
  RingLevel level;
  level.side_px = side_px;
  for (const Sample& s : samples) {
    const Monomials monomials = monomialsOf(s.x, s.y);
    level.x.push_back(s.x), level.y.push_back(s.y);
    level.monomials.insert(level.monomials.end(), monomials.data(), monomials.data() + monomials.size());
  }
  for (int c = 0; c < kRingChannels; ++c)
    for (const Sample& s : samples) {
      level.values.push_back(s.value[c]);
      level.slopes_x.push_back(s.slope_x[c]);
      level.slopes_y.push_back(s.slope_y[c]);
    }
  for (int k = 0; k <= segments; ++k)
    level.segments.push_back(static_cast<int>(
        std::count_if(samples.begin(), samples.end(), [k](const Sample& s) { return s.segment < k; })));
  return level;
}

// Samples the ring on a grid of this resolution.
RingLevel sampled(const SmoothImage& image, const Vector2d& shape, double side_px) {
  const double pitch = 1.0 / side_px, half = RingModel::kWidth + 0.5 * shape.maxCoeff();
  const int a_side = segmentsASide(side_px);
  const Vector2d step = pitch / shape.array();
  std::vector<Sample> samples;
  for (double y = -half + 0.5 * pitch; y < half; y += pitch)
    for (double x = -half + 0.5 * pitch; x < half; x += pitch) {
      const Vector2d p(x / shape.x(), y / shape.y());
      Sample sample{};
      sample.segment = segmentOf(p, shape, side_px, a_side);
      if (sample.segment >= 0 && sampleAt(image, p, 0.5 * step, sample)) samples.push_back(sample);
    }
  std::stable_sort(samples.begin(), samples.end(),
                   [](const Sample& a, const Sample& b) { return a.segment < b.segment; });
  thinOut(samples, 4 * a_side);
  return levelFrom(samples, 4 * a_side, side_px);
}

}  // namespace

std::array<float, 257> logsOfColours() {
  std::array<float, 257> logs{};
  for (int i = 0; i < 257; ++i) logs[i] = std::log((static_cast<float>(i) + kDark) / kMiddle);
  return logs;
}

void RingModel::learn(const cv::Mat& image, const Quadrilateral& opening) {
  levels.clear();
  if (image.empty() || image.type() != CV_8UC3) return;
  if (!geometry::isFinite(opening) || !geometry::isConvex(opening)) return;
  const Vector2d shape = shapeOf(geometry::aspectRatio(opening));
  const double side_px = std::sqrt(std::abs(geometry::signedArea(opening)) / (shape.x() * shape.y()));
  const geometry::UnitSquare map(opening);
  ImagePyramid pyramid;
  pyramid.set(image);
  cv::Mat smooth;
  const double finest = std::clamp(side_px, kCoarsest, kFinest);
  const int count = 1 + static_cast<int>(std::floor(2.0 * std::log2(finest / kCoarsest) + 1e-6));
  for (int k = 0; k < count; ++k) {
    const double wanted = finest * std::pow(2.0, -0.5 * (count - 1 - k));
    const int from =
        std::clamp(static_cast<int>(std::floor(std::log2(side_px / wanted) + 1e-6)), 0, pyramid.deepest());
    const double ratio = side_px / wanted / (1 << from);
    pyramid.level(from).convertTo(smooth, CV_32F);
    const double blur = kBlur * std::sqrt(std::max(0.0, ratio * ratio - (from > 0 ? 0.5 : 0.0)));
    if (ratio > 1.1 && blur > 0.1)
      cv::GaussianBlur(smooth, smooth, cv::Size(), blur, blur, cv::BORDER_REPLICATE);
    if (RingLevel level = sampled({smooth, map, from, *this}, shape, wanted); level.size() >= kFewestSamples)
      levels.push_back(std::move(level));
  }
}

const RingLevel& RingModel::level(double side_px) const {
  const auto off = [&](const RingLevel& l) { return std::abs(std::log(l.side_px / side_px)); };
  return *std::min_element(levels.begin(), levels.end(),
                           [&](const RingLevel& a, const RingLevel& b) { return off(a) < off(b); });
}

}  // namespace window_ingress::detection
