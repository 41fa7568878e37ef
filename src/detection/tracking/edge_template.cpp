#include "detection/tracking/edge_template.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace window_ingress::detection {
namespace {

constexpr int kSegments = 6;          // of a side, each matched separately
constexpr float kFaintPart = 0.35f;   // of the remembered energy: fainter patterns correlate less
constexpr float kPreference = 0.15f;  // penalty in correlation at the ends of the reach
constexpr int kMaxReach = EdgeTemplate::kMaxReach;
constexpr int kMaxWidth = 2 * (EdgeTemplate::kMaxHalf + kMaxReach) + 5;

/// Correlations of the segments of a side with a pattern, by shift.
struct Correlations {
  std::array<std::array<float, 2 * kMaxReach + 1>, kSegments> by_shift;
  std::array<float, kSegments> position;  // along the side, 0 to 1
  int count = 0;
};

template <typename Pattern>
void correlate(const float* mean, int channels, int width, const Pattern& pattern, int half, int reach,
               float* by_shift) {
  const int size = 2 * half + 1, middle = width / 2;
  const auto end = pattern.begin() + channels * size;
  const float wanted = std::inner_product(pattern.begin(), end, pattern.begin(), 0.0f);
  const float floor = kFaintPart * kFaintPart * wanted;
  for (int shift = -reach; shift <= reach; ++shift) {
    float product = 0.0f, energy = 0.0f;
    for (int c = 0; c < channels; ++c) {
      const float* p = pattern.data() + c * size;
      const float* v = mean + c * width + middle + shift - half;
      for (int k = 0; k < size; ++k) {
        const float slope = 0.5f * (v[k + 1] - v[k - 1]);
        product += p[k] * slope;
        energy += slope * slope;
      }
    }
    by_shift[shift + reach] = product / std::sqrt(std::max(1e-6f, wanted * std::max(energy, floor)));
  }
}

// The line on which the segments correlate best.
EdgeTemplate::Match bestLine(const Correlations& found, int reach, double length) {
  EdgeTemplate::Match match;
  float best = -1e9f;
  const float strain = 0.5f * kPreference / static_cast<float>(reach * reach);
  for (int a = -reach; a <= reach; ++a)
    for (int b = -reach; b <= reach; ++b) {
      float sum = 0.0f;
      for (int j = 0; j < found.count; ++j) {
        const int shift = static_cast<int>(a + (b - a) * found.position[j] + reach + 0.5f);
        sum += found.by_shift[j][shift];
      }
      sum /= static_cast<float>(found.count);
      const float value = sum - strain * static_cast<float>(a * a + b * b);
      if (value <= best) continue;
      best = value;
      match.similarity = sum;
      match.line = {0.5 * (a + b), (b - a) / length};
    }
  return match;
}

}  // namespace

EdgeTemplate::Pattern EdgeTemplate::zoomed(double zoom) const {
  if (std::abs(zoom - 1.0) * half_ < 0.05) return slopes_;
  Pattern out{};
  const int size = 2 * half_ + 1;
  for (int k = 0; k < size; ++k) {
    const double from = (k - half_) / zoom + half_;
    const int left = static_cast<int>(std::floor(from));
    if (left < 0 || left + 1 >= size) continue;
    const float part = static_cast<float>(from - left);
    for (int c = 0; c < channels_; ++c) {
      const float* in = slopes_.data() + c * size + left;
      out[c * size + k] = in[0] + part * (in[1] - in[0]);
    }
  }
  return out;
}

std::optional<EdgeTemplate::Match> EdgeTemplate::match(const EdgeProfiles& profiles, int reach_px,
                                                       double size_px) const {
  const int reach = std::min({reach_px, kMaxReach, profiles.reach() - half_ - 1});
  if (!known_ || reach < 1 || profiles.channels() != channels_ || !(size_px > 0.0) ||
      2 * profiles.insideCount() < profiles.count())
    return std::nullopt;
  const Pattern pattern = zoomed(size_px / size_px_);
  std::array<float, 3 * kMaxWidth> mean;
  if (profiles.width() > kMaxWidth) return std::nullopt;
  Correlations found;
  for (int j = 0; j < kSegments; ++j) {
    const int first = j * profiles.count() / kSegments, last = (j + 1) * profiles.count() / kSegments;
    if (2 * profiles.mean(first, last, mean.data()) < last - first || first == last) continue;
    found.position[found.count] = static_cast<float>(
        0.5 + 0.5 * (profiles.position(first) + profiles.position(last - 1)) / profiles.length());
    correlate(mean.data(), channels_, profiles.width(), pattern, half_, reach,
              found.by_shift[found.count++].data());
  }
  if (2 * found.count < kSegments) return std::nullopt;
  return bestLine(found, reach, profiles.length());
}

void EdgeTemplate::learn(const EdgeProfiles& profiles, const OffsetLine& border, int half_px, double size_px,
                         double rate) {
  const int half = std::min(half_px, kMaxHalf), size = 2 * half + 1, channels = profiles.channels();
  std::array<float, 3 * (2 * kMaxHalf + 3)> mean;
  if (profiles.meanAlong(border, half + 1, mean.data()) == 0) return;
  const bool fresh = !known_ || half != half_ || channels != channels_;
  if (!fresh) slopes_ = zoomed(size_px / size_px_);
  const float keep = fresh ? 0.0f : static_cast<float>(1.0 - rate);
  for (int c = 0; c < channels; ++c)
    for (int k = 0; k < size; ++k) {
      const float* v = mean.data() + c * (size + 2) + k;
      float& slope = slopes_[c * size + k];
      slope = keep * slope + (1.0f - keep) * 0.5f * (v[2] - v[0]);
    }
  known_ = true, channels_ = channels, half_ = half, size_px_ = size_px;
  Eigen::Vector3f change;
  for (int c = 0; c < 3; ++c) change[c] = 2.0f * slopes_[(channels_ == 1 ? 0 : c) * size + half_];
  const float contrast = change.norm();
  if (contrast > 0.0f) colour_ = change / contrast;
}

}  // namespace window_ingress::detection
