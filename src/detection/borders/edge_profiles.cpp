#include "detection/borders/edge_profiles.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace window_ingress::detection {
namespace {

using Eigen::Vector2d;

constexpr double kMarginPx = 2.0;  // of a profile's middle from the border of the image

/// Raw pixel of the undistorted point middle + o * step, as a parabola in o. Its error over the reach of a
/// profile is less than a thousandth of a pixel, and a hundredth at 60 degrees off a fisheye's axis.
struct Path {
  Vector2d at, slope, bend;

  Path(const Vector2d& middle, const Vector2d& step, double reach, const geometry::PinholeCamera* lens)
      : at(middle), slope(step), bend(Vector2d::Zero()) {
    if (!lens) return;
    const Vector2d low = lens->distort(middle - reach * step), high = lens->distort(middle + reach * step);
    at = lens->distort(middle);
    slope = (high - low) / (2.0 * reach);
    bend = (0.5 * (high + low) - at) / (reach * reach);
  }
  Vector2d operator()(double o) const { return at + o * (slope + o * bend); }
};

bool isInside(const cv::Mat& image, const Vector2d& p, double margin) {
  return p.x() >= margin && p.y() >= margin && p.x() < image.cols - 1 - margin &&
         p.y() < image.rows - 1 - margin;
}

// Beyond the border of the image the last pixels repeat.
Vector2d clamped(const cv::Mat& image, const Vector2d& p) {
  return p.cwiseMax(0.0).cwiseMin(Vector2d(image.cols - 1.001, image.rows - 1.001));
}

/// Reads one pixel, bilinearly interpolated or, if rough, the nearest one; channels `stride` apart.
template <int kChannels>
void read(const cv::Mat& image, const Vector2d& p, bool rough, int stride, float* out) {
  const float x = static_cast<float>(p.x()), y = static_cast<float>(p.y()), half = rough ? 0.5f : 0.0f;
  const int column = static_cast<int>(x + half), row = static_cast<int>(y + half);
  const uchar* top = image.ptr(row) + column * kChannels;
  if (rough) {
    for (int c = 0; c < kChannels; ++c) out[c * stride] = top[c];
    return;
  }
  const float u = x - static_cast<float>(column), v = y - static_cast<float>(row), uv = u * v;
  const uchar* bottom = top + image.step[0];
  for (int c = 0; c < kChannels; ++c)
    out[c * stride] = (1.0f - u - v + uv) * top[c] + (u - uv) * top[c + kChannels] + (v - uv) * bottom[c] +
                      uv * bottom[c + kChannels];
}

const Eigen::Vector3f kBrightness(0.114f, 0.587f, 0.299f);  // BGR, ITU-R BT.601
constexpr double kSoftRatio = 0.45;  // ratio of squared differences for an edge blurred by one pixel
constexpr double kMinColour = 0.5;   // mean square of first differences that counts as colour
constexpr float kTrusted = 0.35f;    // weight of a change of colour relative to one of brightness

}  // namespace

template <int kChannels>
void EdgeProfiles::fill(const cv::Mat& image, const geometry::PinholeCamera* lens, bool rough) {
  for (int i = 0; i < count_; ++i) {
    const Path path(point(position_[i], 0.0), pixel_ * normal_, reach_, lens);
    inside_[i] = isInside(image, path.at, kMarginPx);
    if (!inside_[i]) continue;
    ++inside_count_;
    float* out = values_.data() + static_cast<std::size_t>(i) * kChannels * width();
    const bool is_simple =
        !lens && isInside(image, path(-reach_), kMarginPx) && isInside(image, path(reach_), kMarginPx);
    for (int o = -reach_; o <= reach_; ++o, ++out) {
      const Vector2d p = is_simple ? Vector2d(path.at + o * path.slope) : clamped(image, path(o));
      read<kChannels>(image, p, rough, width(), out);
    }
  }
}

double pixelAcross(const geometry::PinholeCamera* lens, const Vector2d& from, const Vector2d& to) {
  const double pixel = lens ? lens->pixelAcross(0.5 * (from + to), to - from) : 1.0;
  return std::isfinite(pixel) ? pixel : 1.0;
}

void EdgeProfiles::sample(const cv::Mat& image, const geometry::PinholeCamera* lens,
                          const ProfileGrid& grid) {
  const Vector2d span = grid.to - grid.from;
  length_ = span.norm();
  pixel_ = pixelAcross(lens, grid.from, grid.to);
  middle_ = 0.5 * (grid.from + grid.to);
  normal_ = length_ > 0.0 ? Vector2d(span.y(), -span.x()) / length_ : Vector2d(Vector2d::UnitX());
  channels_ = image.channels();
  count_ = std::max(1, grid.count);
  reach_ = std::max(1, grid.reach_px);
  inside_count_ = 0;
  values_.resize(static_cast<std::size_t>(count_) * channels_ * width());
  position_.resize(count_);
  inside_.assign(count_, 0);
  for (int i = 0; i < count_; ++i)
    position_[i] = length_ * (-0.5 + grid.end_margin + (1.0 - 2.0 * grid.end_margin) * (i + 0.5) / count_);
  channels_ == 1 ? fill<1>(image, lens, grid.rough) : fill<3>(image, lens, grid.rough);
}

int EdgeProfiles::mean(int first, int last, float* out) const {
  const int size = channels_ * width();
  Eigen::Map<Eigen::VectorXf> mean(out, size);
  mean.setZero();
  int count = 0;
  for (int i = first; i < last; ++i) {
    if (!inside(i)) continue;
    mean += Eigen::Map<const Eigen::VectorXf>(samples(i, 0), size);
    ++count;
  }
  mean *= 1.0f / static_cast<float>(std::max(1, count));
  return count;
}

int EdgeProfiles::meanAlong(const OffsetLine& line, int half, float* out) const {
  const int size = 2 * half + 1;
  Eigen::Map<Eigen::VectorXf> mean(out, channels_ * size);
  mean.setZero();
  int count = 0;
  for (int i = 0; i < count_; ++i) {
    const double offset = line.at(position_[i]);
    const int whole = static_cast<int>(std::floor(offset));
    if (!inside(i) || reach_ + whole - half < 0 || whole + half + 1 > reach_) continue;
    const float part = static_cast<float>(offset - whole);
    for (int c = 0; c < channels_; ++c) {
      const float* v = samples(i, c) + reach_ + whole - half;
      const Eigen::Map<const Eigen::VectorXf> low(v, size), high(v + 1, size);
      mean.segment(c * size, size) += low + part * (high - low);
    }
    ++count;
  }
  mean *= 1.0f / static_cast<float>(std::max(1, count));
  return count;
}

bool isColourSoft(const EdgeProfiles& profiles) {
  if (profiles.channels() != 3) return false;
  double first = 0.0, second = 0.0;
  int count = 0;
  for (int i = 0; i < profiles.count(); ++i) {
    if (!profiles.inside(i)) continue;
    const float *b = profiles.samples(i, 0), *g = profiles.samples(i, 1), *r = profiles.samples(i, 2);
    for (int k = 1; k + 1 < profiles.width(); ++k) {
      const auto blue = [&](int at) { return b[at] - 0.5f * (g[at] + r[at]); };
      const auto red = [&](int at) { return r[at] - g[at]; };
      const float blue_step = blue(k + 1) - blue(k), red_step = red(k + 1) - red(k);
      const float blue_bend = blue_step - (blue(k) - blue(k - 1)),
                  red_bend = red_step - (red(k) - red(k - 1));
      first += blue_step * blue_step + red_step * red_step;
      second += blue_bend * blue_bend + red_bend * red_bend;
      ++count;
    }
  }
  return first > kMinColour * count && second < kSoftRatio * first;
}

Eigen::Vector3f resolvedPart(const Eigen::Vector3f& change) {
  const Eigen::Vector3f brightness = Eigen::Vector3f::Constant(kBrightness.dot(change));
  return brightness + kTrusted * (change - brightness);
}

}  // namespace window_ingress::detection
