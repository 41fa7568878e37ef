#include "detection/tracking/track_identity.hpp"

#include <algorithm>

#include "detection/quads.hpp"

namespace window_ingress::detection {
namespace {

constexpr double kSizeRatio = 1.35;  // of one window in two images

}  // namespace

void TrackIdentity::follow(double stamp_sec) {
  known_ = true;
  ++followed_;
  last_sec_ = stamp_sec;
}

void TrackIdentity::found(bool is_same, double stamp_sec) {
  if (!is_same) ++id_, followed_ = 0;
  known_ = true;
  last_sec_ = stamp_sec;
}

void TrackIdentity::expect(double stamp_sec) {
  known_ = true;
  followed_ = std::max(followed_, kSettled);
  last_sec_ = stamp_sec;
}

bool TrackIdentity::remembers(double stamp_sec) const {
  return known_ && stamp_sec - last_sec_ <= params_.reacquire_sec;
}

bool TrackIdentity::isSame(const geometry::Quadrilateral& seen,
                           const geometry::Quadrilateral& expected) const {
  const double a = sizeOf(seen), b = sizeOf(expected);
  const double off = (geometry::centroid(seen) - geometry::centroid(expected)).norm();
  return off < params_.reacquire_gate * std::min(a, b) && std::max(a, b) < kSizeRatio * std::min(a, b);
}

}  // namespace window_ingress::detection
