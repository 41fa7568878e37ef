#include "detection/reference/haze.hpp"

#include <cmath>

namespace window_ingress::detection {
namespace {

constexpr double kMinLeft = 0.06, kMaxLeft = 0.85;
constexpr float kDarkest = 40.0F;        ///< a thinner haze changes little [grey levels]
constexpr float kGreyest = 0.75F;        ///< least ratio of smallest to largest channel of haze and glare
constexpr float kTolerance = 8.0F;       ///< noise of the darkest place [grey levels]
constexpr float kUneven = 0.08F;         ///< part of the haze that nearer objects may lack
constexpr double kMinDifference = 25.0;  ///< least between the reference's frame and surround [grey levels]
constexpr double kClearOfNoise = 5.0;    ///< standard deviations by which the rest must exceed noise
constexpr double kTurn_rad = 0.05;       ///< standard deviation of the difference's direction

}  // namespace

std::optional<Haze> hazeThatLeaves(double left, const Eigen::Vector3f& reference_wall,
                                   const Eigen::Vector3f& seen_wall, double darkest) {
  if (!(left > kMinLeft && left < kMaxLeft)) return std::nullopt;
  const Haze haze{left, seen_wall - static_cast<float>(left) * reference_wall};
  const float least = haze.added.minCoeff(), most = haze.added.maxCoeff();
  if (!(least > kDarkest) || least < kGreyest * most) return std::nullopt;
  if ((1.0F - kUneven) * least > static_cast<float>(darkest) + kTolerance) return std::nullopt;
  return haze;
}

std::optional<double> distanceThroughHaze(const RingMeans& reference, const RingMeans& seen) {
  const Eigen::Vector3f expected = reference.frame - reference.surround, found = seen.frame - seen.surround;
  const double square = expected.squaredNorm();
  if (square < kMinDifference * kMinDifference) return std::nullopt;
  const double left = found.dot(expected) / square, along = left * std::sqrt(square);
  if (!(along > kClearOfNoise * seen.sigma)) return std::nullopt;
  if (!hazeThatLeaves(left, reference.surround, seen.surround, seen.darkest)) return std::nullopt;
  const double across = (found - static_cast<float>(left) * expected).norm() / along;
  const double noise = seen.sigma / along, spread = kTurn_rad * kTurn_rad + noise * noise;
  return std::sqrt(1.0 - std::exp(-across * across / (8.0 * spread)));
}

}  // namespace window_ingress::detection
