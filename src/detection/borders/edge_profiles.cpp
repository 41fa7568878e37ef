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

/// Reads single pixels, bilinearly interpolated or the nearest one.
template <int kChannels, bool kRough>
class ProfileReader {
 public:
  ProfileReader(const cv::Mat& image, int stride) : data_(image.data), row_(image.step[0]), stride_(stride) {}

  void operator()(const Vector2d& p, float* out) const {
    const float x = static_cast<float>(p.x()), y = static_cast<float>(p.y());
    if (kRough) {
      const uchar* at = pixel(static_cast<int>(x + 0.5f), static_cast<int>(y + 0.5f));
      for (int c = 0; c < kChannels; ++c) out[c * stride_] = at[c];
      return;
    }
    const int column = static_cast<int>(x), row = static_cast<int>(y);
    const float u = x - static_cast<float>(column), v = y - static_cast<float>(row), uv = u * v;
    const uchar *top = pixel(column, row), *bottom = top + row_;
    for (int c = 0; c < kChannels; ++c)
      out[c * stride_] = (1.0f - u - v + uv) * top[c] + (u - uv) * top[c + kChannels] + (v - uv) * bottom[c] +
                         uv * bottom[c + kChannels];
  }

 private:
  const uchar* pixel(int column, int row) const { return data_ + row * row_ + column * kChannels; }

  const uchar* data_;
  std::size_t row_;
  int stride_;
};

const Eigen::Vector3f kBrightness(0.114f, 0.587f, 0.299f);
constexpr double kSoftRatio = 0.45;  // ratio of squared differences for an edge blurred by one pixel
constexpr double kMinColour = 0.5;   // mean square of first differences that counts as colour
constexpr float kTrusted = 0.35f;    // weight of a change of colour relative to one of brightness

}  // namespace

template <int kChannels, bool kRough>
void EdgeProfiles::fill(const cv::Mat& image, const geometry::PinholeCamera* lens) {
  const ProfileReader<kChannels, kRough> read(image, width());
  for (int i = 0; i < count_; ++i) {
    const Path path(point(position_[i], 0.0), pixel_ * normal_, reach_, lens);
    inside_[i] = isInside(image, path.at, kMarginPx);
    if (!inside_[i]) continue;
    ++inside_count_;
    const bool whole = isInside(image, path(-reach_), kMarginPx) && isInside(image, path(reach_), kMarginPx);
    float* out = values_.data() + static_cast<std::size_t>(i) * kChannels * width();
    if (whole && !lens)
      for (int o = -reach_; o <= reach_; ++o, ++out) read(path.at + o * path.slope, out);
    else
      for (int o = -reach_; o <= reach_; ++o, ++out) read(clamped(image, path(o)), out);
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
  if (channels_ == 1)
    grid.rough ? fill<1, true>(image, lens) : fill<1, false>(image, lens);
  else
    grid.rough ? fill<3, true>(image, lens) : fill<3, false>(image, lens);
}

int EdgeProfiles::mean(int first, int last, float* out) const {
  const int size = channels_ * width();
  std::fill(out, out + size, 0.0f);
  int count = 0;
  for (int i = first; i < last; ++i) {
    if (!inside(i)) continue;
    const float* in = samples(i, 0);
    for (int k = 0; k < size; ++k) out[k] += in[k];
    ++count;
  }
  const float scale = 1.0f / static_cast<float>(std::max(1, count));
  for (int k = 0; k < size; ++k) out[k] *= scale;
  return count;
}

int EdgeProfiles::meanAlong(const OffsetLine& line, int half, float* out) const {
  const int size = 2 * half + 1;
  std::fill(out, out + channels_ * size, 0.0f);
  int count = 0;
  for (int i = 0; i < count_; ++i) {
    const double offset = line.at(position_[i]);
    const int whole = static_cast<int>(std::floor(offset));
    if (!inside(i) || reach_ + whole - half < 0 || whole + half + 1 > reach_) continue;
    const float part = static_cast<float>(offset - whole);
    for (int c = 0; c < channels_; ++c) {
      const float* v = samples(i, c) + reach_ + whole - half;
      for (int k = 0; k < size; ++k) out[c * size + k] += v[k] + part * (v[k + 1] - v[k]);
    }
    ++count;
  }
  const float scale = 1.0f / static_cast<float>(std::max(1, count));
  for (int k = 0; k < channels_ * size; ++k) out[k] *= scale;
  return count;
}

float brightnessOf(const Eigen::Vector3f& bgr) { return kBrightness.dot(bgr); }

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
  const Eigen::Vector3f brightness = Eigen::Vector3f::Constant(brightnessOf(change));
  return brightness + kTrusted * (change - brightness);
}

}  // namespace window_ingress::detection
