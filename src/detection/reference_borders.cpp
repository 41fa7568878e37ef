#include "window_ingress/detection/reference_borders.hpp"

#include <algorithm>
#include <cmath>

#include "window_ingress/detection/unit_square.hpp"

namespace window_ingress::detection {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3f;
using geometry::Quadrilateral;

constexpr int kAlong = 24;          ///< samples along a side
constexpr double kSkip = 0.08;      ///< left out at both ends of it
constexpr int kMostSteps = 90;      ///< across a side
constexpr double kClear = 0.006;    ///< nearer to a border colours are mixed [mean sides]
constexpr double kLeastChange = 3.0;  ///< of the mean colour over two pixels that may be a border [grey levels]

double meanSide(const Quadrilateral& quad) {
  const auto sides = geometry::sideLengths(quad);
  return 0.25 * (sides[0] + sides[1] + sides[2] + sides[3]);
}

// Point of the unit square's plane beside side `i`, t along it, `out` from it in sides across.
Vector2d beside(int i, double t, double out) {
  switch (i) {
    case geometry::kTop:
      return {t, -out};
    case geometry::kRight:
      return {1.0 + out, t};
    case geometry::kBottom:
      return {1.0 - t, 1.0 + out};
    default:
      return {-out, 1.0 - t};
  }
}

Vector3f features(const Vector3f& bgr) {
  const float sum = bgr.sum() + 12.0F;
  return {(bgr[2] + 4.0F) / sum, (bgr[1] + 4.0F) / sum, std::log(sum)};
}

}  // namespace

// The profiles of all four sides.
void ReferenceBorders::measure(const cv::Mat& image, const Quadrilateral& ideal,
                               const geometry::PinholeCamera* lens, double aspect) {
  const UnitSquare map(ideal);
  const double side_px = meanSide(ideal);
  const double width = 2.0 * aspect / (1.0 + aspect), height = 2.0 / (1.0 + aspect);  // in mean sides
  const int steps = std::clamp(static_cast<int>((params_.inward + params_.outward) * side_px), 12, kMostSteps);
  const double right = image.cols - 0.5, bottom = image.rows - 0.5;
  for (int i = 0; i < 4; ++i) {
    SideProfile& profile = sides_[i];
    profile.first = -params_.inward;
    profile.step = (params_.inward + params_.outward) / steps;
    profile.means.clear();
    const double across = i % 2 ? width : height;
    for (int k = 0; k < steps; ++k) {
      Vector3f sum = Vector3f::Zero();
      int count = 0;
      for (int n = 0; n < kAlong; ++n) {
        const double t = kSkip + (1.0 - 2.0 * kSkip) * (n + 0.5) / kAlong;
        Vector2d p = map.toImage(beside(i, t, profile.at(k) / across));
        if (lens) p = lens->distort(p);
        if (!(p.x() > -0.5 && p.y() > -0.5 && p.x() < right && p.y() < bottom)) continue;
        const cv::Vec3b& pixel =
            image.ptr<cv::Vec3b>(static_cast<int>(p.y() + 0.5))[static_cast<int>(p.x() + 0.5)];
        sum += Vector3f(pixel[0], pixel[1], pixel[2]);
        ++count;
      }
      if (count < kAlong / 3) break;
      profile.means.push_back(sum / static_cast<float>(count));
    }
  }
}

// Features of the bands outwards from a border; false if the profile ends before the second.
bool ReferenceBorders::bandsFrom(const SideProfile& profile, double border, Bands& bands) const {
  const int count = static_cast<int>(profile.means.size());
  int filled = 0;
  for (int b = 0; b < kBands; ++b) {
    const double from = border + b * kBandWidth + (b == 0 ? kClear : 0.0), to = border + (b + 1) * kBandWidth;
    const int first = static_cast<int>(std::ceil((from - profile.first) / profile.step - 1e-9));
    const int last = std::max(first, static_cast<int>(std::floor((to - profile.first) / profile.step)));
    if (first < 0 || last >= count) break;
    Vector3f sum = Vector3f::Zero();
    for (int k = first; k <= last; ++k) sum += profile.means[k];
    bands[b] = features(sum / static_cast<float>(last - first + 1));
    ++filled;
  }
  if (filled < 2) return false;
  for (int b = filled; b < kBands; ++b) bands[b] = bands[filled - 1];
  const float far = bands[kBands - 1][2];
  for (Vector3f& band : bands) band[2] -= far;
  return true;
}

void ReferenceBorders::learn(const cv::Mat& picture, const Quadrilateral& opening) {
  known_ = false;
  if (picture.type() != CV_8UC3 || picture.empty() || !geometry::isConvex(opening)) return;
  const auto sides = geometry::sideLengths(opening);
  aspect_ = (sides[0] + sides[2]) / (sides[1] + sides[3]);
  measure(picture, opening, nullptr, aspect_);
  Bands own, sum;
  sum.fill(Vector3f::Zero());
  int count = 0;
  for (const SideProfile& profile : sides_) {
    if (!bandsFrom(profile, 0.0, own)) continue;
    for (int b = 0; b < kBands; ++b) sum[b] += own[b];
    ++count;
  }
  if (count < 3) return;
  for (int b = 0; b < kBands; ++b) reference_[b] = sum[b] / static_cast<float>(count);
  known_ = true;
}

// Mean difference from the reference.
double ReferenceBorders::unlike(const Bands& bands) const {
  double sum = 0.0;
  for (int b = 0; b < kBands; ++b) {
    const Vector3f d = bands[b] - reference_[b];
    sum += std::hypot(d[0], d[1]) + params_.brightness_weight * std::min(1.0F, std::abs(d[2]));
  }
  return sum / kBands;
}

// The edge from which outwards the colours are most like those of the reference, and its worth.
double ReferenceBorders::choose(const SideProfile& profile, double& border) const {
  const int count = static_cast<int>(profile.means.size());
  const auto change = [&](int k) {
    return k < 1 || k + 1 >= count ? 0.0F : (profile.means[k + 1] - profile.means[k - 1]).norm();
  };
  double best = 0.0;
  Bands bands;
  for (int k = 1; k + 1 < count; ++k) {
    const double here = change(k);
    if (here < kLeastChange || here < change(k - 1) || here < change(k + 1)) continue;
    if (!bandsFrom(profile, profile.at(k), bands)) continue;
    const double worth =
        std::exp(-unlike(bands) / params_.alike) * std::min(1.0, here / params_.contrast_full);
    if (worth > best) best = worth, border = profile.at(k);
  }
  return best;
}

std::optional<ReferenceBorders::Located> ReferenceBorders::locate(const cv::Mat& image,
                                                                  const Quadrilateral& rough,
                                                                  const geometry::PinholeCamera* camera) {
  if (!known_ || image.type() != CV_8UC3 || !geometry::isConvex(rough)) return std::nullopt;
  const geometry::PinholeCamera* lens = camera && camera->hasDistortion() ? camera : nullptr;
  Quadrilateral ideal = rough;
  if (lens)
    for (Vector2d& corner : ideal) corner = lens->undistort(corner);
  measure(image, ideal, lens, aspect_);
  std::array<double, 4> borders{};
  Located located;
  located.worth = 1.0;
  for (int i = 0; i < 4; ++i) {
    const double worth = choose(sides_[i], borders[i]);
    if (worth <= 0.0) return std::nullopt;
    located.worth = std::min(located.worth, worth);
    borders[i] /= i % 2 ? 2.0 * aspect_ / (1.0 + aspect_) : 2.0 / (1.0 + aspect_);
  }
  const double top = -borders[0], right = 1.0 + borders[1], bottom = 1.0 + borders[2], left = -borders[3];
  const UnitSquare map(ideal);
  located.quad = {map.toImage({left, top}), map.toImage({right, top}), map.toImage({right, bottom}),
                  map.toImage({left, bottom})};
  if (lens)
    for (Vector2d& corner : located.quad) corner = lens->distort(corner);
  if (!geometry::isFinite(located.quad) || !geometry::isConvex(located.quad)) return std::nullopt;
  return located;
}

}  // namespace window_ingress::detection
