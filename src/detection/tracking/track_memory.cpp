#include "detection/tracking/track_memory.hpp"

#include <algorithm>

#include "detection/quads.hpp"

namespace window_ingress::detection {
namespace {

constexpr double kSizeRatio = 1.35;  // of one window in two images

}  // namespace

void TrackMemory::follow(double stamp_sec) {
  known_ = true;
  ++followed_;
  last_sec_ = stamp_sec;
}

void TrackMemory::found(bool is_same, double stamp_sec) {
  if (!is_same) ++id_, followed_ = 0;
  known_ = true;
  last_sec_ = stamp_sec;
}

void TrackMemory::expect(double stamp_sec) {
  known_ = true;
  followed_ = std::max(followed_, kSettled);
  last_sec_ = stamp_sec;
}

bool TrackMemory::remembers(double stamp_sec) const {
  return known_ && stamp_sec - last_sec_ <= params_.reacquire_sec;
}

bool TrackMemory::isSame(const geometry::Quadrilateral& seen, const geometry::Quadrilateral& expected) const {
  const double a = sizeOf(seen), b = sizeOf(expected);
  const double off = (geometry::centroid(seen) - geometry::centroid(expected)).norm();
  return off < params_.reacquire_gate * std::min(a, b) && std::max(a, b) < kSizeRatio * std::min(a, b);
}

}  // namespace window_ingress::detection
