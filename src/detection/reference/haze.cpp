#include "detection/reference/haze.hpp"

namespace window_ingress::detection {
namespace {

constexpr double kMinLeft = 0.06, kMaxLeft = 0.85;
constexpr float kDarkest = 40.0F;   ///< a thinner haze changes little [grey levels]
constexpr float kGreyest = 0.75F;   ///< least over greatest channel of haze and glare, at least
constexpr float kTolerance = 8.0F;  ///< of the darkest place: noise [grey levels]
constexpr float kUneven = 0.08F;    ///< and this part of the haze: what is nearer has less of it

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

}  // namespace window_ingress::detection
