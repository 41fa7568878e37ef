#include "window_ingress/detection/double_edge.hpp"

#include <algorithm>
#include <cmath>

namespace window_ingress::detection {
namespace {

using Eigen::Vector3f;

constexpr float kApart = 0.25f;  // sine of the angle between the colours of the two flanks
constexpr float kLeastChange =
    3.0f;                     // of a flank, and of the part at right angles, over two pixels [grey levels]
constexpr int kFurthest = 3;  // [px]

// Offset of the maximum of a parabola through three equidistant values, the middle one the largest.
double peak(float left, float middle, float right) {
  const float bend = left - 2.0f * middle + right;
  return bend < 0.0f ? std::clamp(0.5f * (left - right) / bend, -0.5f, 0.5f) : 0.0;
}

template <typename Value>
double maximumNear(int first, int last, Value value) {
  int best = first;
  for (int k = first; k <= last; ++k)
    if (value(k) > value(best)) best = k;
  return best + (best > first && best < last ? peak(value(best - 1), value(best), value(best + 1)) : 0.0);
}

}  // namespace

double partedBy(const Vector3f* changes, int count, int at) {
  if (at < 2 || at + 1 >= count) return 0.0;
  const Vector3f inner = changes[at - 1] + changes[at - 2], outer = changes[at + 1];
  if (!(inner.norm() > kLeastChange) || !(outer.norm() > kLeastChange)) return 0.0;
  const Vector3f back = inner.normalized(), own = outer - outer.dot(back) * back;
  if (own.norm() < kLeastChange || own.norm() < kApart * outer.norm()) return 0.0;
  const Vector3f direction = own.normalized();
  const int first = std::max(0, at - kFurthest), last = std::min(count - 1, at + kFurthest);
  const double all = maximumNear(first, last, [&](int k) { return changes[k].norm(); });
  const double front = maximumNear(first, last, [&](int k) { return direction.dot(changes[k]); });
  return std::abs(front - all);
}

}  // namespace window_ingress::detection
