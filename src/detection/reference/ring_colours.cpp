#include "detection/reference/ring_colours.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "detection/chromaticity.hpp"
#include "detection/reference/haze.hpp"
#include "window_ingress/detection/reference_appearance.hpp"
#include "window_ingress/geometry/unit_square.hpp"

namespace window_ingress::detection {
namespace {

using Eigen::Vector2d;
using geometry::Quadrilateral;

constexpr double kClearPx = 1.5;   ///< pixels nearer to the border mix with those of the opening
constexpr int kFewest = 6;         ///< samples along a side
constexpr int kClipped = 750;      ///< sum of the channels above which one of them is clipped
constexpr int kGrid = 6;           ///< lines through the opening to find its darkest part
constexpr double kIgnored = 0.02;  ///< part of the pixels that may be darker than `darkest`
constexpr int kBinSteps = 16;      ///< positions between two bins
constexpr int kMinColourSum = 45;  ///< sum of the channels below which chroma is noise
constexpr double kTop = 0.80;      ///< chromaticity at the last bin; the first is at 0
constexpr double kBandWeight[RingHistogram::kBands] = {2.0, 1.0};
constexpr double kSharing = 4.0 / 9.0;  ///< sharing a pixel between bins reduces the variance to this part
constexpr float kMinPaint = 0.05F;      ///< of chromaticities

constexpr int kAlong = 16, kAcross = 2;  ///< most samples along a side, most lines in a band

/// Pixels of one band of a ring. Samples lie on lines parallel to the opening's sides in the window's plane,
/// at most one per pixel along a line.
struct BandSamples {
  std::array<cv::Vec3b, 4 * kAlong * kAcross> pixels;  ///< BGR; the first `count` are filled
  int count = 0;                                       ///< samples within the image that are not clipped
  int asked = 0;                                       ///< all samples, including those outside the image
  double area_px = 0.0;                                ///< of the whole band [px]
};

/// Counts of the least channel, in steps of four grey levels.
struct DarkCounts {
  static constexpr int kStep = 4;
  void add(const cv::Vec3b& pixel) { ++counts[std::min({pixel[0], pixel[1], pixel[2]}) / kStep]; }
  double darkest() const {
    const int all = std::accumulate(counts.begin(), counts.end(), 0);
    int left = static_cast<int>(kIgnored * all), level = 0;
    while (level < 63 && left >= counts[level]) left -= counts[level++];
    return all ? kStep * level : 0.0;
  }

  std::array<int, 64> counts{};
};

// Calls `use` with `count` pixels along a line of the unit square's plane, as far as they lie in the image.
// Homogeneous pixels are linear along it.
template <typename Use>
void forEachPixel(const cv::Mat& image, const geometry::UnitSquare& map, const Vector2d& from,
                  const Vector2d& to, int count, const Use& use) {
  constexpr double kHorizon = 1e-6;
  constexpr float kFar = 1e6F;
  const Eigen::Vector3d a = map.matrix() * from.homogeneous(), b = map.matrix() * to.homogeneous();
  if (!(a.z() > kHorizon && b.z() > kHorizon)) return;
  const Eigen::Vector3d between = (b - a) / count;
  const Eigen::Vector3f start = (a + 0.5 * between).cast<float>(), step = between.cast<float>();
  std::array<int, kAlong> column, row;
  for (int k = 0; k < count; ++k) {
    const auto t = static_cast<float>(k);
    const float scale = 1.0F / (start.z() + t * step.z());
    column[k] = static_cast<int>(std::clamp((start.x() + t * step.x()) * scale, -2.0F, kFar) + 2.5F) - 2;
    row[k] = static_cast<int>(std::clamp((start.y() + t * step.y()) * scale, -2.0F, kFar) + 2.5F) - 2;
  }
  for (int k = 0; k < count; ++k)
    if (column[k] >= 0 && column[k] < image.cols && row[k] >= 0 && row[k] < image.rows)
      use(image.ptr<cv::Vec3b>(row[k])[column[k]]);
}

/// An opening with its size in the image.
struct MeasuredOpening {
  explicit MeasuredOpening(const Quadrilateral& opening)
      : map(opening), sides(geometry::sideLengths(opening)), mean(geometry::meanSide(opening)) {}

  /// Corners in the unit square's plane of the line at this distance round it [mean sides].
  Quadrilateral line(double out) const {
    const double x = 2.0 * out * mean / (sides[0] + sides[2]), y = 2.0 * out * mean / (sides[1] + sides[3]);
    return {Vector2d(-x, -y), Vector2d(1 + x, -y), Vector2d(1 + x, 1 + y), Vector2d(-x, 1 + y)};
  }

  geometry::UnitSquare map;
  std::array<double, 4> sides;
  double mean;
};

BandSamples sampleBand(const cv::Mat& image, const MeasuredOpening& opening, double from, double to,
                       DarkCounts& dark) {
  BandSamples band;
  band.area_px = 4.0 * opening.mean * (to - from) * opening.mean;
  const int lines = std::clamp(static_cast<int>((to - from) * opening.mean), 1, kAcross);
  for (int n = 0; n < 4 * lines; ++n) {
    const int side = n % 4;
    const double out = from + (to - from) * (n / 4 + 0.5) / lines;
    const Quadrilateral corners = opening.line(out);
    const int count = std::clamp(static_cast<int>(opening.sides[side] * (1 + 2 * out)), kFewest, kAlong);
    band.asked += count;
    forEachPixel(image, opening.map, corners[side], corners[(side + 1) % 4], count,
                 [&](const cv::Vec3b& pixel) {
                   dark.add(pixel);
                   if (pixel[0] + pixel[1] + pixel[2] <= kClipped) band.pixels[band.count++] = pixel;
                 });
  }
  return band;
}

using Counts = std::array<std::uint32_t, RingHistogram::kCells>;

/// Per sum: 65536 times the number of positions by which a unit of value moves the chromaticity.
std::array<std::uint32_t, 766> reciprocals() {
  std::array<std::uint32_t, 766> table{};
  for (int sum = 1; sum < 766; ++sum)
    table[sum] = static_cast<std::uint32_t>(65536.0 * (RingHistogram::kBins - 1) * kBinSteps / kTop / sum);
  return table;
}

// Adds one pixel to the four bins round its chromaticity; false if it is too dark.
bool addPixel(const cv::Vec3b& pixel, Counts& counts) {
  static const auto kPerSum = reciprocals();
  constexpr std::uint32_t kLast = (RingHistogram::kBins - 1) * kBinSteps - 1;
  const int blue = pixel[0], green = pixel[1], red = pixel[2], sum = blue + green + red;
  if (sum < kMinColourSum) return false;
  const std::uint32_t r = std::min(red * kPerSum[sum] >> 16, kLast),
                      g = std::min(green * kPerSum[sum] >> 16, kLast);
  const std::uint32_t u = r % kBinSteps, v = g % kBinSteps;
  std::uint32_t* cell = &counts[r / kBinSteps * RingHistogram::kBins + g / kBinSteps];
  cell[0] += (kBinSteps - u) * (kBinSteps - v);
  cell[1] += (kBinSteps - u) * v;
  cell[RingHistogram::kBins] += u * (kBinSteps - v);
  cell[RingHistogram::kBins + 1] += u * v;
  return true;
}

RingHistogram::Band bandOf(const BandSamples& samples, int min_pixels) {
  Counts counts{};
  int counted = 0;
  for (int i = 0; i < samples.count; ++i) counted += addPixel(samples.pixels[i], counts);
  RingHistogram::Band band;
  const double seen = std::min<double>(counted, samples.area_px * counted / samples.asked);
  if (seen < min_pixels || 2 * counted < samples.count) return band;
  band.pixels = seen;
  const float scale = 1.0F / (static_cast<float>(counted) * kBinSteps * kBinSteps);
  for (int i = 0; i < RingHistogram::kCells; ++i) band.share[i] = scale * static_cast<float>(counts[i]);
  return band;
}

bool hasColour(const cv::Vec3b& pixel) {
  constexpr int kNoise = 3;
  const auto [least, most] = std::minmax({pixel[0], pixel[1], pixel[2]});
  return most - least > kNoise;
}

bool isGreyBand(const BandSamples& band) {
  return std::none_of(band.pixels.begin(), band.pixels.begin() + band.count, hasColour);
}

// Mean of a band's pixels; adds the variance of that mean.
Eigen::Vector3f meanOf(const BandSamples& band, double& variance) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero(), squares = Eigen::Vector3f::Zero();
  for (int i = 0; i < band.count; ++i) {
    const Eigen::Vector3f pixel(band.pixels[i][0], band.pixels[i][1], band.pixels[i][2]);
    sum += pixel;
    squares += pixel.cwiseProduct(pixel);
  }
  const float n = static_cast<float>(std::max(band.count, 1));
  const Eigen::Vector3f mean = sum / n;
  variance += std::max(0.0F, (squares / n - mean.cwiseProduct(mean)).maxCoeff()) / n;
  return mean;
}

// 1 - sum sqrt(p q), less the expected value for samples of these sizes from equal colours.
double divergence(const RingHistogram::Band& a, const RingHistogram::Band& b) {
  const auto m = static_cast<float>(b.pixels);
  float alike = 0.0F, spread = 0.0F;
  for (int i = 0; i < RingHistogram::kCells; ++i) {
    alike += std::sqrt(a.share[i] * b.share[i]);
    spread += (1.0F - a.share[i]) * std::min(1.0F, m * a.share[i]);  // a bin without pixels adds nothing
  }
  return 1.0 - alike - kSharing * spread / 8.0 * (1.0 / a.pixels + 1.0 / b.pixels);
}

}  // namespace

bool isGrey(const cv::Mat& image) {
  if (image.type() != CV_8UC3) return true;
  constexpr int kAcross = 32, kDown = 24;
  for (int i = 0; i < kDown; ++i) {
    const auto* row = image.ptr<cv::Vec3b>((2 * i + 1) * image.rows / (2 * kDown));
    for (int k = 0; k < kAcross; ++k)
      if (hasColour(row[(2 * k + 1) * image.cols / (2 * kAcross)])) return false;
  }
  return true;
}

std::optional<Eigen::Vector3f> RingMeans::paint() const {
  const auto coloured = [](const Eigen::Vector3f& of) { return Eigen::Vector3f(of.array() - of.mean()); };
  const Eigen::Vector3f own = coloured(chromaticity(frame));
  const Eigen::Vector3f difference = own - coloured(chromaticity(surround));
  if (own.norm() < kMinPaint || difference.norm() < kMinPaint) return std::nullopt;
  return difference.normalized();
}

std::optional<RingColours> ringColours(const cv::Mat& image, const Quadrilateral& opening, int min_pixels) {
  if (image.type() != CV_8UC3 || image.empty() || !geometry::isFinite(opening) ||
      !geometry::isConvex(opening))
    return std::nullopt;
  constexpr double kFrame = RingHistogram::kFrameWidth, kSurround = RingHistogram::kSurroundWidth;
  const MeasuredOpening measured(opening);
  DarkCounts dark;
  for (int i = 0; i < kGrid; ++i) {
    const double y = (i + 0.5) / kGrid;
    forEachPixel(image, measured.map, {0, y}, {1, y}, kGrid, [&](const cv::Vec3b& p) { dark.add(p); });
  }
  const double clear = std::min(kClearPx / measured.mean, 0.5 * kFrame);
  const BandSamples frame = sampleBand(image, measured, clear, kFrame, dark);
  const BandSamples surround = sampleBand(image, measured, kFrame, kSurround, dark);
  const RingHistogram seen{{bandOf(frame, min_pixels), bandOf(surround, min_pixels)}};
  if (seen.bands[0].pixels <= 0.0 || (isGreyBand(frame) && isGreyBand(surround) && isGrey(image)))
    return std::nullopt;
  double variance = 0.0;
  const Eigen::Vector3f frame_mean = meanOf(frame, variance), surround_mean = meanOf(surround, variance);
  return RingColours{seen, {frame_mean, surround_mean, std::sqrt(variance), dark.darkest()}};
}

Quadrilateral ringLine(const Quadrilateral& quad, double distance) {
  const MeasuredOpening opening(quad);
  Quadrilateral line = opening.line(distance);
  for (Vector2d& p : line) p = Eigen::Vector3d(opening.map.matrix() * p.homogeneous()).hnormalized();
  return line;
}

double bhattacharyya(const RingHistogram& a, const RingHistogram& b) {
  double sum = 0.0, weights = 0.0;
  for (int i = 0; i < RingHistogram::kBands; ++i) {
    if (a.bands[i].pixels == 0.0 || b.bands[i].pixels == 0.0) continue;
    sum += kBandWeight[i] * divergence(a.bands[i], b.bands[i]);
    weights += kBandWeight[i];
  }
  return weights > 0.0 ? std::sqrt(std::clamp(sum / weights, 0.0, 1.0)) : 1.0;
}

double bhattacharyya(const RingColours& reference, const RingColours& seen) {
  const double plain = bhattacharyya(reference.seen, seen.seen);
  return std::min(plain, distanceThroughHaze(reference.means, seen.means).value_or(plain));
}

RingColours blended(const RingColours& from, const RingColours& to, double part) {
  RingColours result = from;
  const auto share = static_cast<float>(part);
  for (int b = 0; b < RingHistogram::kBands; ++b) {
    const RingHistogram::Band &before = from.seen.bands[b], &after = to.seen.bands[b];
    if (before.pixels == 0.0 || after.pixels == 0.0) continue;
    for (int i = 0; i < RingHistogram::kCells; ++i)
      result.seen.bands[b].share[i] += share * (after.share[i] - before.share[i]);
  }
  return result;
}

}  // namespace window_ingress::detection
