#include "estimation/filter/odometry_smoother.hpp"

#include <cmath>

namespace window_ingress::estimation {
namespace {

constexpr std::size_t kMinSamples = 5, kMaxSamples = 400;
constexpr double kSpanSec = 1.0, kMinSpanSec = 1.0 / 3.0;

}  // namespace

void OdometrySmoother::add(double stamp_sec, const Eigen::Vector3d& position_m) {
  if (!std::isfinite(stamp_sec) || !position_m.allFinite()) return;
  if (!samples_.empty() && stamp_sec <= samples_.back().stamp_sec) samples_.clear();
  samples_.push_back({stamp_sec, position_m});
  while (samples_.size() > kMaxSamples || samples_.front().stamp_sec < stamp_sec - kSpanSec)
    samples_.pop_front();
}

std::optional<OdometrySmoother::Motion> OdometrySmoother::motion() const {
  if (samples_.size() < kMinSamples) return std::nullopt;
  const Sample& last = samples_.back();
  if (last.stamp_sec - samples_.front().stamp_sec < kMinSpanSec) return std::nullopt;
  double mean_sec = 0.0;
  Eigen::Vector3d mean_m = Eigen::Vector3d::Zero();
  for (const Sample& sample : samples_) {
    mean_sec += (sample.stamp_sec - last.stamp_sec) / samples_.size();
    mean_m += (sample.position_m - last.position_m) / samples_.size();
  }
  double square_sec = 0.0;
  Eigen::Vector3d product = Eigen::Vector3d::Zero();
  for (const Sample& sample : samples_) {
    const double dt_sec = sample.stamp_sec - last.stamp_sec - mean_sec;
    square_sec += dt_sec * dt_sec;
    product += dt_sec * (sample.position_m - last.position_m - mean_m);
  }
  const Eigen::Vector3d velocity = product / square_sec;
  return Motion{last.position_m + mean_m - mean_sec * velocity, velocity};
}

}  // namespace window_ingress::estimation
