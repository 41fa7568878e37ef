#include "window_ingress/detection/reference_appearance.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

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

// Adds one pixel to the four bins round its chromaticity; false if it is too dark or clipped.
bool addPixel(const cv::Vec3b& pixel, float* band) {
  const int sum = pixel[0] + pixel[1] + pixel[2];
  if (sum < kDarkest || sum > kBrightest) return false;
  const auto bin = [&](int value) {
    const double part = (static_cast<double>(value) / sum - kLow) / (kHigh - kLow);
    return std::clamp(part, 0.0, 1.0) * (kBins - 1.001);
  };
  const double red = bin(pixel[2]), green = bin(pixel[1]);
  const int r = static_cast<int>(red), g = static_cast<int>(green);
  const auto u = static_cast<float>(red - r), v = static_cast<float>(green - g);
  band[r * kBins + g] += (1 - u) * (1 - v);
  band[(r + 1) * kBins + g] += u * (1 - v);
  band[r * kBins + g + 1] += (1 - u) * v;
  band[(r + 1) * kBins + g + 1] += u * v;
  return true;
}

// A point of the ring: `along` counts once round the opening (0 to 4), `out` is the distance from the border.
Vector2d ringPoint(double along, double out_x, double out_y) {
  const int side = std::min(3, static_cast<int>(along));
  const double t = along - side, x = -out_x + t * (1 + 2 * out_x), y = -out_y + t * (1 + 2 * out_y);
  switch (side) {
    case geometry::kTop:
      return {x, -out_y};
    case geometry::kRight:
      return {1 + out_x, y};
    case geometry::kBottom:
      return {1 - x, 1 + out_y};
    default:
      return {-out_x, 1 - y};
  }
}

// Fills one band of the histogram; the number of pixels that counted.
int fillBand(const cv::Mat& image, const Quadrilateral& opening, double from, double to, float* band) {
  const UnitSquare map(opening);
  const auto sides = geometry::sideLengths(opening);
  const double width = 0.5 * (sides[0] + sides[2]), height = 0.5 * (sides[1] + sides[3]),
               mean = 0.5 * (width + height);
  int count = 0;
  for (int a = 0; a < kAcross; ++a) {
    const double out = (from + (to - from) * (a + 0.5) / kAcross) * mean;
    for (int k = 0; k < 4 * kAlong; ++k) {
      const Vector2d ring = ringPoint((k + 0.5) / kAlong, out / width, out / height);
      const Vector2d p = map.toImage(ring);
      if (!(p.x() > -0.5 && p.y() > -0.5 && p.x() < image.cols - 0.5 && p.y() < image.rows - 0.5)) continue;
      count += addPixel(
          image.at<cv::Vec3b>(static_cast<int>(std::lround(p.y())), static_cast<int>(std::lround(p.x()))),
          band);
    }
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
  for (int b = 0; b < 2; ++b) {
    if (bandPixels(opening, limits[b], limits[b + 1]) < params.min_pixels) return std::nullopt;
    const int count = fillBand(image, opening, limits[b], limits[b + 1], histogram.ptr<float>(b));
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
