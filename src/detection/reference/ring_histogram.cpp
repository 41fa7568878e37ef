#include "detection/reference/ring_histogram.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "detection/chromaticity.hpp"
#include "detection/reference/haze.hpp"
#include "detection/reference/ring_samples.hpp"
#include "window_ingress/detection/reference_appearance.hpp"

namespace window_ingress::detection {
namespace {

constexpr int kBinSteps = 16;      ///< positions between two bins
constexpr int kMinColourSum = 45;  ///< sum of the channels below which chroma is noise
constexpr double kTop = 0.80;      ///< chromaticity at the last bin; the first is at 0
constexpr double kBandWeight[RingHistogram::kBands] = {2.0, 1.0};
/// Sharing a pixel between bins smooths the sample and reduces its variance to this part.
constexpr double kSharing = 4.0 / 9.0;

constexpr float kMinPaint = 0.05F;  ///< of chromaticities

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

RingHistogram::Band bandOf(const RingSamples::Band& samples, int min_pixels) {
  Counts counts{};
  int counted = 0;
  for (int i = 0; i < samples.count; ++i) counted += addPixel(samples.pixels[i], counts);
  RingHistogram::Band band;
  if (samples.asked == 0) return band;
  const double seen = std::min<double>(counted, samples.area_px * counted / samples.asked);
  if (seen < min_pixels || 2 * counted < samples.count) return band;
  band.pixels = seen;
  const float scale = 1.0F / (static_cast<float>(counted) * kBinSteps * kBinSteps);
  for (int i = 0; i < RingHistogram::kCells; ++i) band.share[i] = scale * static_cast<float>(counts[i]);
  return band;
}

RingHistogram histogramOf(const RingSamples& samples, int min_pixels) {
  RingHistogram histogram;
  for (int b = 0; b < RingHistogram::kBands; ++b) histogram.bands[b] = bandOf(samples.bands[b], min_pixels);
  return histogram;
}

bool hasColour(const cv::Vec3b& pixel) {
  constexpr int kNoise = 3;
  const auto [least, most] = std::minmax({pixel[0], pixel[1], pixel[2]});
  return most - least > kNoise;
}

bool hasColour(const RingSamples& samples) {
  for (const RingSamples::Band& band : samples.bands)
    if (std::any_of(band.pixels.begin(), band.pixels.begin() + band.count,
                    [](const cv::Vec3b& pixel) { return hasColour(pixel); }))
      return true;
  return false;
}

// Mean of a band's pixels; adds the variance of that mean.
Eigen::Vector3f meanOf(const RingSamples::Band& band, double& variance) {
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

RingMeans meansOf(const RingSamples& samples) {
  RingMeans means;
  double variance = 0.0;
  means.frame = meanOf(samples.bands[0], variance);
  means.surround = meanOf(samples.bands[1], variance);
  means.sigma = std::sqrt(variance);
  means.darkest = samples.darkest;
  return means;
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

std::optional<RingColours> ringColours(const cv::Mat& image, const geometry::Quadrilateral& opening,
                                       int min_pixels) {
  if (image.type() != CV_8UC3 || image.empty() || !geometry::isFinite(opening) ||
      !geometry::isConvex(opening))
    return std::nullopt;
  RingSamples samples;
  sampleRing(image, opening, samples);
  const RingColours colours{histogramOf(samples, min_pixels), meansOf(samples)};
  if (colours.seen.bands[0].pixels <= 0.0 || (!hasColour(samples) && isGrey(image))) return std::nullopt;
  return colours;
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
