#include "window_ingress/detection/direction_bins.hpp"

#include <cmath>
#include <cstdlib>
#include <utility>

namespace window_ingress::detection {
namespace {

constexpr double kBin = 6.283185307179586 / DirectionBins::kCount;

Eigen::Vector2d unit(double angle) { return {std::cos(angle), std::sin(angle)}; }

}  // namespace

DirectionBins::DirectionBins() {
  for (int i = 0; i < kCount; ++i) directions_[i] = unit(i * 6.283185307179586 / kCount);
  for (int i = 0; i <= kOctant; ++i) upper_limits_[i] = unit((i + 0.5) * kBin);
  for (int i = 0; i <= kSlopes; ++i)
    lowest_[i] = static_cast<int>(std::lround(std::atan((i - 0.001) / kSlopes) / kBin));
}

int DirectionBins::of(int x, int y) const {
  int run = std::abs(x), rise = std::abs(y);
  const bool steep = rise > run;
  if (steep) std::swap(run, rise);
  if (run == 0) return 0;
  int bin = lowest_[static_cast<int>(rise * (kSlopes / static_cast<float>(run)))];
  bin += rise * upper_limits_[bin].x() > run * upper_limits_[bin].y();
  if (steep) bin = kCount / 4 - bin;
  if (x < 0) bin = kCount / 2 - bin;
  return (y < 0 ? kCount - bin : bin) % kCount;
}

}  // namespace window_ingress::detection
