#include "window_ingress/detection/stretch_in_view.hpp"

#include <algorithm>
#include <cmath>

namespace window_ingress::detection {
namespace {

using Eigen::Vector2d;

constexpr int kSteps = 64;

bool isInside(const Vector2d& p, const cv::Size& image, double margin) {
  return p.x() >= margin && p.y() >= margin && p.x() <= image.width - 1 - margin &&
         p.y() <= image.height - 1 - margin;
}

// Part of the stretch between two parallels to an axis.
bool clip(double from, double span, double low, double high, double& begin, double& end) {
  if (std::abs(span) < 1e-12) return from >= low && from <= high;
  const double a = (low - from) / span, b = (high - from) / span;
  begin = std::max(begin, std::min(a, b));
  end = std::min(end, std::max(a, b));
  return begin < end;
}

// Far outside the picture a lens model folds back into it.
double largestRadius(const cv::Size& image, const geometry::PinholeCamera& lens) {
  double radius = 0.0;
  for (const Vector2d& corner : {Vector2d(0, 0), Vector2d(image.width - 1, 0), Vector2d(0, image.height - 1),
                                 Vector2d(image.width - 1, image.height - 1)})
    radius = std::max(radius, (lens.undistort(corner) - Vector2d(lens.cx, lens.cy)).norm());
  return radius;
}

std::optional<Stretch> throughLens(const Stretch& whole, const cv::Size& image, double margin,
                                   const geometry::PinholeCamera& lens) {
  const double radius = largestRadius(image, lens);
  const Vector2d step = (whole.to - whole.from) / kSteps;
  int best = 0, best_end = -1, run = 0;
  for (int i = 0; i <= kSteps; ++i) {
    const Vector2d p = whole.from + i * step;
    const bool seen =
        (p - Vector2d(lens.cx, lens.cy)).norm() <= radius && isInside(lens.distort(p), image, margin);
    run = seen ? run + 1 : 0;
    if (run > best) best = run, best_end = i;
  }
  if (best < 2) return std::nullopt;
  return Stretch{whole.from + (best_end - best + 1) * step, whole.from + best_end * step};
}

}  // namespace

std::optional<Stretch> stretchInView(const Stretch& whole, const cv::Size& image, double margin_px,
                                     const geometry::PinholeCamera* lens) {
  const Vector2d span = whole.to - whole.from;
  if (!whole.from.allFinite() || !whole.to.allFinite() || !(span.squaredNorm() > 0.0)) return std::nullopt;
  if (lens) return throughLens(whole, image, margin_px, *lens);
  double begin = 0.0, end = 1.0;
  if (!clip(whole.from.x(), span.x(), margin_px, image.width - 1 - margin_px, begin, end) ||
      !clip(whole.from.y(), span.y(), margin_px, image.height - 1 - margin_px, begin, end))
    return std::nullopt;
  return Stretch{whole.from + begin * span, whole.from + end * span};
}

}  // namespace window_ingress::detection
