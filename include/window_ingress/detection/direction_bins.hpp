#pragma once

#include <Eigen/Core>
#include <array>

namespace window_ingress::detection {

/// The circle in equal bins, the first one about +x, counting towards +y.
class DirectionBins {
 public:
  static constexpr int kCount = 256;

  DirectionBins();

  /// Unit vector in the middle of a bin, 0 to kCount - 1.
  const Eigen::Vector2d& direction(int bin) const { return directions_[bin]; }

  /// Bin of an integer vector with components up to 2^15, without trigonometry: that of the rounded angle,
  /// round(atan2(y, x) * kCount / (2 pi)) modulo kCount. The null vector falls into bin 0.
  int of(int x, int y) const;

 private:
  static constexpr int kOctant = kCount / 8, kSlopes = 128;

  std::array<Eigen::Vector2d, kCount> directions_;
  std::array<Eigen::Vector2d, kOctant + 1> upper_limits_;  ///< direction between a bin and the next
  std::array<int, kSlopes + 1>
      lowest_;  ///< first bin of the slopes from i / kSlopes on; they lie in two at most
};

}  // namespace window_ingress::detection
