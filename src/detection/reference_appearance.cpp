#include "window_ingress/detection/reference_appearance.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "window_ingress/detection/unit_square.hpp"

namespace window_ingress::detection {
namespace {

using Eigen::Vector2d;
using geometry::Quadrilateral;

constexpr int kBins = 16;
constexpr int kAlong = 28;        ///< samples along each side of the ring
constexpr int kAcross = 3;        ///< samples across each band
constexpr double kClearPx = 1.5;  ///< pixels nearer to the border are mixed with what is seen through it
constexpr int kDarkest = 45;      ///< sum of the channels below which chroma is noise
constexpr int kBrightest = 750;   ///< and above which it is clipped
constexpr double kLow = 0.05, kHigh = 0.70;  ///< chromaticities covered by the bins

bool hasColour(const cv::Mat& image) { return image.type() == CV_8UC3; }

/// Where a chromaticity lies among the bins: `bin`, and `part` of the way to the next.
struct Place {
  float part;
  std::int32_t bin;
};

/// The places of all values of a channel beside all sums of channels that count: a division each.
class Places {
 public:
  Places() : places_((kBrightest - kDarkest + 1) * kValues) {
    for (int sum = kDarkest; sum <= kBrightest; ++sum)
      for (int value = 0; value < kValues; ++value)
        places_[(sum - kDarkest) * kValues + value] = place(static_cast<double>(value) / sum);
  }
  /// Those of all values beside one sum.
  const Place* beside(int sum) const { return &places_[(sum - kDarkest) * kValues]; }

 private:
  static constexpr int kValues = 256;

  static Place place(double chromaticity) {
    const double among = std::clamp((chromaticity - kLow) / (kHigh - kLow), 0.0, 1.0) * (kBins - 1.001);
    const auto bin = static_cast<std::int32_t>(among);
    return {static_cast<float>(among - bin), bin};
  }

  std::vector<Place> places_;
};

// Adds one pixel to the four bins round its chromaticity; false if it is too dark or clipped.
bool addPixel(const cv::Vec3b& pixel, const Places& places, float* band) {
  const int sum = pixel[0] + pixel[1] + pixel[2];
  if (sum < kDarkest || sum > kBrightest) return false;
  const Place red = places.beside(sum)[pixel[2]], green = places.beside(sum)[pixel[1]];
  const float u = red.part, v = green.part;
  float* cell = band + red.bin * kBins + green.bin;
  cell[0] += (1 - u) * (1 - v);
  cell[kBins] += u * (1 - v);
  cell[1] += (1 - u) * v;
  cell[kBins + 1] += u * v;
  return true;
}

/// Samples of a ring round the unit square at the distance `out`; `t` is -out to 1 + out along a side.
Vector2d ringPoint(int side, const Vector2d& t, const Vector2d& out) {
  switch (side) {
    case geometry::kTop:
      return {t.x(), -out.y()};
    case geometry::kRight:
      return {1 + out.x(), t.y()};
    case geometry::kBottom:
      return {1 - t.x(), 1 + out.y()};
    default:
      return {-out.x(), 1 - t.y()};
  }
}

// Adds the pixels of one ring to a band; how many counted.
int addRing(const cv::Mat& image, const UnitSquare& map, const Vector2d& out, float* band) {
  static const Places places;
  const Vector2d length = Vector2d::Ones() + 2 * out;
  const double right = image.cols - 0.5, bottom = image.rows - 0.5;
  int count = 0;
  for (int side = 0; side < 4; ++side)
    for (int k = 0; k < kAlong; ++k) {
      const double t = (side * kAlong + k + 0.5) / kAlong - side;
      const Vector2d p = map.toImage(ringPoint(side, t * length - out, out));
      if (!(p.x() > -0.5 && p.y() > -0.5 && p.x() < right && p.y() < bottom)) continue;
      count += addPixel(image.ptr<cv::Vec3b>(static_cast<int>(p.y() + 0.5))[static_cast<int>(p.x() + 0.5)],
                        places, band);
    }
  return count;
}

// Fills one band of the histogram; the number of pixels that counted.
int fillBand(const cv::Mat& image, const Quadrilateral& opening, const UnitSquare& map, double from,
             double to, float* band) {
  const auto sides = geometry::sideLengths(opening);
  const double width = 0.5 * (sides[0] + sides[2]), height = 0.5 * (sides[1] + sides[3]),
               mean = 0.5 * (width + height);
  int count = 0;
  for (int a = 0; a < kAcross; ++a) {
    const double out = (from + (to - from) * (a + 0.5) / kAcross) * mean;
    count += addRing(image, map, Vector2d(out / width, out / height), band);
  }
  return count;
}

bool scaleToHalf(float* band) {
  float sum = 0.0F;
  for (int i = 0; i < kBins * kBins; ++i) sum += band[i];
  if (sum <= 0.0F) return false;
  for (int i = 0; i < kBins * kBins; ++i) band[i] *= 0.5F / sum;
  return true;
}

// Pixels of the image that a band covers: what it is worth, however often it is sampled.
double bandPixels(const Quadrilateral& opening, double from, double to) {
  const auto sides = geometry::sideLengths(opening);
  const double girth = sides[0] + sides[1] + sides[2] + sides[3];
  return girth * (to - from) * girth / 4.0;
}

bool same(const AppearanceParams& a, const AppearanceParams& b) {
  return a.near_width == b.near_width && a.far_width == b.far_width && a.min_pixels == b.min_pixels;
}

Quadrilateral inset(const cv::Size& size, double width) {
  const double w = size.width - 1.0, h = size.height - 1.0, d = width * 0.5 * (w + h);
  return {Vector2d(d, d), Vector2d(w - d, d), Vector2d(w - d, h - d), Vector2d(d, h - d)};
}

}  // namespace

std::optional<cv::Mat> ringHistogram(const cv::Mat& image, const Quadrilateral& opening,
                                     const AppearanceParams& params) {
  if (!hasColour(image) || image.empty() || !geometry::isConvex(opening)) return std::nullopt;
  cv::Mat histogram = cv::Mat::zeros(2, kBins * kBins, CV_32FC1);
  const double clear = kClearPx / std::sqrt(std::abs(geometry::signedArea(opening)) + 1.0);
  const double limits[3] = {std::min(clear, 0.5 * params.near_width), params.near_width,
                            std::max(params.near_width, params.far_width)};
  const UnitSquare map(opening);
  for (int b = 0; b < 2; ++b) {
    if (bandPixels(opening, limits[b], limits[b + 1]) < params.min_pixels) return std::nullopt;
    const int count = fillBand(image, opening, map, limits[b], limits[b + 1], histogram.ptr<float>(b));
    if (count < params.min_pixels || !scaleToHalf(histogram.ptr<float>(b))) return std::nullopt;
  }
  return histogram;
}

ReferenceAppearance::ReferenceAppearance(const cv::Mat& picture, const Quadrilateral& opening)
    : picture_(picture.clone()), opening_(opening) {}

ReferenceAppearance::ReferenceAppearance(const cv::Mat& picture, double frame_width)
    : ReferenceAppearance(picture, inset(picture.size(), frame_width)) {}

std::optional<double> ReferenceAppearance::distance(const cv::Mat& image, const Quadrilateral& opening,
                                                    const AppearanceParams& params) const {
  if (!histogram_ || !same(histogram_params_, params)) {
    histogram_ = ringHistogram(picture_, opening_, params);
    histogram_params_ = params;
  }
  if (!histogram_) return std::nullopt;
  const auto candidate = ringHistogram(image, opening, params);
  if (!candidate) return std::nullopt;
  return cv::compareHist(*histogram_, *candidate, cv::HISTCMP_BHATTACHARYYA);
}

}  // namespace window_ingress::detection
