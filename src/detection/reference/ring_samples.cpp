#include "detection/reference/ring_samples.hpp"

#include <Eigen/Geometry>
#include <algorithm>

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

/// Counts of the least channel, in steps of four grey levels.
class DarkCounts {
 public:
  void add(const cv::Vec3b& pixel) {
    ++counts_[std::min({pixel[0], pixel[1], pixel[2]}) / kStep];
    ++all_;
  }
  double darkest() const {
    int left = static_cast<int>(kIgnored * all_), level = 0;
    while (level < kLevels - 1 && left >= counts_[level]) left -= counts_[level++];
    return all_ ? kStep * level : 0.0;
  }

 private:
  static constexpr int kStep = 4, kLevels = 64;
  std::array<std::uint16_t, kLevels> counts_{};
  int all_ = 0;
};

/// A line of samples in the plane of the window. Homogeneous pixels are linear along it.
struct SampleLine {
  Eigen::Vector3d start, step;
  int count = 0;
};

SampleLine lineBetween(const geometry::UnitSquare& map, const Vector2d& from, const Vector2d& to, int count) {
  const Eigen::Vector3d a = map.matrix() * from.homogeneous(), b = map.matrix() * to.homogeneous();
  constexpr double kHorizon = 1e-6;
  if (!(a.z() > kHorizon && b.z() > kHorizon)) return {a, b, 0};
  const Eigen::Vector3d step = (b - a) / count;
  return {a + 0.5 * step, step, count};
}

// Calls `use` with each pixel of the line that lies within the image.
template <typename Use>
void forEachPixel(const cv::Mat& image, const SampleLine& line, const Use& use) {
  constexpr float kFar = 1e6F;
  std::array<int, RingSamples::kAlong> column, row;
  const Eigen::Vector3f start = line.start.cast<float>(), step = line.step.cast<float>();
  for (int k = 0; k < line.count; ++k) {
    const auto t = static_cast<float>(k);
    const float scale = 1.0F / (start.z() + t * step.z());
    column[k] = static_cast<int>(std::clamp((start.x() + t * step.x()) * scale, -2.0F, kFar) + 2.5F) - 2;
    row[k] = static_cast<int>(std::clamp((start.y() + t * step.y()) * scale, -2.0F, kFar) + 2.5F) - 2;
  }
  for (int k = 0; k < line.count; ++k)
    if (column[k] >= 0 && column[k] < image.cols && row[k] >= 0 && row[k] < image.rows)
      use(image.ptr<cv::Vec3b>(row[k])[column[k]]);
}

/// Corners of the line at the distance `out` round the unit square, canonical order.
std::array<Vector2d, 4> ringCorners(const Vector2d& out) {
  return {Vector2d(-out.x(), -out.y()), Vector2d(1 + out.x(), -out.y()), Vector2d(1 + out.x(), 1 + out.y()),
          Vector2d(-out.x(), 1 + out.y())};
}

/// An opening with its size in the image.
struct MeasuredOpening {
  explicit MeasuredOpening(const Quadrilateral& opening)
      : map(opening), sides(geometry::sideLengths(opening)) {
    girth = sides[0] + sides[1] + sides[2] + sides[3];
    mean = 0.25 * girth;
  }
  /// Converts a distance from mean sides to sides of the unit square.
  Vector2d inUnits(double out) const {
    return {2.0 * out * mean / (sides[0] + sides[2]), 2.0 * out * mean / (sides[1] + sides[3])};
  }
  geometry::UnitSquare map;
  std::array<double, 4> sides;
  double girth, mean;
};

void sampleLines(const cv::Mat& image, const MeasuredOpening& opening, double out, RingSamples::Band& band,
                 DarkCounts& dark) {
  const auto corners = ringCorners(opening.inUnits(out));
  for (int side = 0; side < 4; ++side) {
    const int count =
        std::clamp(static_cast<int>(opening.sides[side] * (1 + 2 * out)), kFewest, RingSamples::kAlong);
    band.asked += count;
    forEachPixel(image, lineBetween(opening.map, corners[side], corners[(side + 1) % 4], count),
                 [&](const cv::Vec3b& pixel) {
                   dark.add(pixel);
                   if (pixel[0] + pixel[1] + pixel[2] <= kClipped) band.pixels[band.count++] = pixel;
                 });
  }
}

void sampleBand(const cv::Mat& image, const MeasuredOpening& opening, double from, double to,
                RingSamples::Band& band, DarkCounts& dark) {
  band.count = band.asked = 0;
  band.area_px = opening.girth * (to - from) * opening.mean;
  const int lines = std::clamp(static_cast<int>((to - from) * opening.mean), 1, RingSamples::kAcross);
  for (int a = 0; a < lines; ++a)
    sampleLines(image, opening, from + (to - from) * (a + 0.5) / lines, band, dark);
}

}  // namespace

void sampleRing(const cv::Mat& image, const Quadrilateral& quad, RingSamples& samples) {
  constexpr double kFrame = RingSamples::kFrameWidth, kSurround = RingSamples::kSurroundWidth;
  const MeasuredOpening opening(quad);
  DarkCounts dark;
  for (int i = 0; i < kGrid; ++i) {
    const double y = (i + 0.5) / kGrid;
    forEachPixel(image, lineBetween(opening.map, {0, y}, {1, y}, kGrid),
                 [&](const cv::Vec3b& pixel) { dark.add(pixel); });
  }
  const double clear = std::min(kClearPx / opening.mean, 0.5 * kFrame);
  sampleBand(image, opening, clear, kFrame, samples.bands[0], dark);
  sampleBand(image, opening, kFrame, kSurround, samples.bands[1], dark);
  samples.darkest = dark.darkest();
}

geometry::Quadrilateral ringLine(const Quadrilateral& quad, double distance) {
  const MeasuredOpening opening(quad);
  const auto corners = ringCorners(opening.inUnits(distance));
  Quadrilateral line;
  for (int i = 0; i < 4; ++i)
    line[i] = Eigen::Vector3d(opening.map.matrix() * corners[i].homogeneous()).hnormalized();
  return line;
}

}  // namespace window_ingress::detection
