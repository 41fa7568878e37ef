#include "detection/borders/subpixel_border.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "detection/borders/two_step_edge.hpp"

namespace window_ingress::detection {
namespace {

constexpr float kFaintest = 0.5f;        // least slope of an edge [grey levels per pixel]
constexpr float kFaintestChange = 3.0f;  // least change of the mean colour over two pixels [grey levels]
constexpr int kMinProfiles = 4;
constexpr double kSigmaFloorPx = 0.03;     // least standard deviation of a border
constexpr double kCorrelationPx = 1.5;     // profiles closer together than this share their noise
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
  border.normal = (profiles.normal() - profiles.pixel() * line.slope * profiles.along()).normalized();
  border.sigma_px = profiles.pixel() * sigma_px;
  border.sigma_rad = profiles.pixel() * sigma_rad;
  return border;
}

void SubpixelBorder::project(const EdgeProfiles& profiles, const Eigen::Vector3f& colour) {
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

bool SubpixelBorder::projectStrongest(const EdgeProfiles& profiles, double radius_px) {
  const int radius = static_cast<int>(std::ceil(radius_px)), width = profiles.width();
  mean_.assign(static_cast<std::size_t>(3) * width, 0.0f);
  sizes_.clear();
  changes_.clear();
  profiles.mean(0, profiles.count(), mean_.data());
  const bool soft = isColourSoft(profiles);
  int strongest = radius;
  double most = 0.0;
  for (int o = -radius; o <= radius; ++o) {
    Eigen::Vector3f change;
    for (int c = 0; c < 3; ++c) {
      const float* at = mean_.data() + (profiles.channels() == 1 ? 0 : c) * width + profiles.reach() + o;
      change[c] = at[1] - at[-1];
    }
    changes_.push_back(soft ? resolvedPart(change) : change);
    sizes_.push_back(changes_.back().norm());
    const double weight = sizes_.back() * std::exp(-0.5 * std::pow(o / (0.6 * radius_px), 2));
    if (weight > most) most = weight, strongest = o + radius;
  }
  project(profiles, most > 0.0 ? Eigen::Vector3f(changes_[strongest] / sizes_[strongest])
                               : Eigen::Vector3f::Constant(1.0f / std::sqrt(3.0f)));
  for (std::size_t k = 1; k + 1 < sizes_.size(); ++k)
    if (sizes_[k] > kFaintestChange && sizes_[k] >= sizes_[k - 1] && sizes_[k] >= sizes_[k + 1]) return true;
  return false;
}

// Position of a profile's edge near an offset, to a pixel.
std::optional<int> SubpixelBorder::steepest(int i, double centre, const SubpixelBorderLimits& limits) const {
  const int reach = profiles_->reach() - 2;
  const int first = std::max(-reach, static_cast<int>(std::lround(centre - limits.radius_px)));
  const int last = std::min(reach, static_cast<int>(std::lround(centre + limits.radius_px)));
  const float* slope = slopesOf(i);
  const float falloff = static_cast<float>(0.5 / (limits.prior_px * limits.prior_px));
  float best = 0.0f;
  int at = first;
  for (int o = first; o <= last; ++o) {
    const float off = static_cast<float>(o - centre), damped = 1.0f + falloff * off * off;
    const float weight = slope[o] / (damped * damped);
    if (weight > best) best = weight, at = o;
  }
  if (best < kFaintest) return std::nullopt;
  while (at > first && slope[at - 1] > slope[at]) --at;
  while (at < last && slope[at + 1] > slope[at]) ++at;
  if (at <= first || at >= last) return std::nullopt;
  return at;
}

void SubpixelBorder::measure(const OffsetLine& about, const SubpixelBorderLimits& limits) {
  positions_.clear();
  offsets_.clear();
  for (int i = 0; i < profiles_->count(); ++i) {
    if (!profiles_->inside(i)) continue;
    const auto at = steepest(i, about.at(profiles_->position(i)), limits);
    if (!at) continue;
    const float* slope = slopesOf(i) + *at;
    positions_.push_back(profiles_->position(i));
    offsets_.push_back(*at + peak(slope[-1], slope[0], slope[1]));
  }
}

void SubpixelBorder::spread(const SubpixelBorderLimits& limits, FittedBorder& border) const {
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
  border.sigma_px = std::hypot(kSigmaFloorPx, std::sqrt(squares / std::max(1, border.inliers) / independent));
  border.sigma_rad = border.sigma_px * kUniformSpread / std::max(1.0, border.to - border.from);
}

// If the fit merged the two edges of a reveal, moves the border to the front one.
void SubpixelBorder::toFront(const TwoStepEdgeLimits& limits, FittedBorder& border) const {
  constexpr int kHalf = 4, kSize = 2 * kHalf + 1;
  std::array<float, 3 * kSize> mean;
  if (profiles_->meanAlong(border.line, kHalf, mean.data()) < kMinProfiles) return;
  const TwoStepEdge edge = fitTwoStepEdge(mean.data(), profiles_->channels(), kHalf, limits);
  border.line.offset += edge.front;
  border.sigma_px = std::hypot(border.sigma_px, edge.sigma_px);
  border.sigma_rad = border.sigma_px * kUniformSpread / std::max(1.0, border.to - border.from);
}

bool SubpixelBorder::run(const SubpixelBorderLimits& limits, FittedBorder& border) {
  measure(border.line, limits);
  if (positions_.size() < kMinProfiles) return false;
  fitRobustLine(positions_, offsets_, limits.outlier_px, border.line);
  spread(limits, border);
  return border.inliers >= kMinProfiles;
}

}  // namespace window_ingress::detection
