#include "window_ingress/detection/border_fit.hpp"

#include <algorithm>
#include <cmath>

namespace window_ingress::detection {
namespace {

constexpr float kFaintest = 0.5f;          // slope that may be an edge [grey levels a pixel]
constexpr double kCorrelationPx = 1.5;     // profiles nearer to each other than this share their noise
constexpr double kUniformSpread = 3.4641;  // length of a uniform distribution over its standard deviation

// Offset of the maximum of a bell curve through three equidistant values, the middle one the largest.
double peak(double left, double middle, double right) {
  const double floor = 0.02 * middle;
  const double l = std::log(std::max(left, floor)), m = std::log(middle),
               r = std::log(std::max(right, floor));
  const double curvature = l - 2.0 * m + r;
  return curvature < -1e-9 ? std::clamp(0.5 * (l - r) / curvature, -1.0, 1.0) : 0.0;
}

}  // namespace

Line FittedBorder::inImage(const EdgeProfiles& profiles) const {
  Line border;
  border.point = profiles.point(middle(), line.at(middle()));
  border.normal = (profiles.normal() - line.slope * profiles.along()).normalized();
  border.sigma_px = sigma_px;
  border.sigma_rad = sigma_rad;
  return border;
}

void BorderFit::project(const EdgeProfiles& profiles, const Eigen::Vector3f& colour) {
  profiles_ = &profiles;
  const int width = profiles.width(), channels = profiles.channels();
  const Eigen::Vector3f weights = 0.5f * (channels == 1 ? Eigen::Vector3f(colour.sum(), 0, 0) : colour);
  slopes_.assign(static_cast<std::size_t>(profiles.count()) * width, 0.0f);
  for (int i = 0; i < profiles.count(); ++i) {
    if (!profiles.inside(i)) continue;
    float* out = slopes_.data() + static_cast<std::size_t>(i) * width;
    for (int c = 0; c < channels; ++c) {
      const float* in = profiles.samples(i, c);
      for (int k = 1; k + 1 < width; ++k) out[k] += weights[c] * (in[k + 1] - in[k - 1]);
    }
  }
}

void BorderFit::measure(const OffsetLine& about, const BorderFitLimits& limits) {
  positions_.clear();
  offsets_.clear();
  const int reach = profiles_->reach() - 2;
  for (int i = 0; i < profiles_->count(); ++i) {
    if (!profiles_->inside(i)) continue;
    const double centre = about.at(profiles_->position(i));
    const int first = std::max(-reach, static_cast<int>(std::lround(centre - limits.radius_px)));
    const int last = std::min(reach, static_cast<int>(std::lround(centre + limits.radius_px)));
    const float* slope =
        slopes_.data() + static_cast<std::size_t>(i) * profiles_->width() + profiles_->reach();
    const double falloff = -0.5 / (limits.prior_px * limits.prior_px);
    double best = 0.0;
    int at = first;
    for (int o = first; o <= last; ++o) {
      const double weight =
          limits.prior_px < 100.0 ? slope[o] * std::exp(falloff * (o - centre) * (o - centre)) : slope[o];
      if (weight > best) best = weight, at = o;
    }
    if (best < kFaintest || at <= first || at >= last) continue;
    positions_.push_back(profiles_->position(i));
    offsets_.push_back(at + peak(slope[at - 1], slope[at], slope[at + 1]));
  }
}

void BorderFit::spread(const BorderFitLimits& limits, FittedBorder& border) const {
  double squares = 0.0;
  border.inliers = 0;
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    const double rest = offsets_[i] - border.line.at(positions_[i]);
    if (std::abs(rest) > 2.0 * limits.outlier_px) continue;
    squares += rest * rest;
    border.from = border.inliers == 0 ? positions_[i] : border.from;
    border.to = positions_[i];
    ++border.inliers;
  }
  const double spacing_px = profiles_->length() / profiles_->count();
  const double independent = std::max(2.0, border.inliers * std::min(1.0, spacing_px / kCorrelationPx) - 2.0);
  border.sigma_px =
      std::hypot(limits.sigma_floor_px, std::sqrt(squares / std::max(1, border.inliers) / independent));
  border.sigma_rad = border.sigma_px * kUniformSpread / std::max(1.0, border.to - border.from);
}

bool BorderFit::run(const BorderFitLimits& limits, FittedBorder& border) {
  measure(border.line, limits);
  const int count = static_cast<int>(positions_.size());
  if (count < 4) return false;
  scratch_.resize(2 * positions_.size());
  fitOffsets({positions_.data(), offsets_.data(), scratch_.data(), count}, limits.outlier_px, border.line);
  spread(limits, border);
  return border.inliers >= 4;
}

}  // namespace window_ingress::detection
