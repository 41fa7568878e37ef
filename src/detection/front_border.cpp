#include "window_ingress/detection/front_border.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace window_ingress::detection {
namespace {

using Eigen::Vector3f;

constexpr int kNextTo = 2;            // offset of the colour next to a border, clear of its blur [px]
constexpr float kLeastChange = 6.0f;  // of colour that is an edge, over all channels [grey levels]
constexpr float kAlike = 0.4f;        // of the change across an edge: colours nearer than this are the same
constexpr float kAdaption = 0.05f;    // of the colour outside, a picture
constexpr int kTimes = 3;

Vector3f colourAt(const float* mean, int channels, int half, int offset) {
  Vector3f colour = Vector3f::Zero();
  for (int c = 0; c < channels; ++c) colour[c] = mean[c * (2 * half + 1) + half + offset];
  return colour;
}

}  // namespace

// Outwards from the border: other colours, then an edge, then the remembered one.
std::optional<int> FrontBorder::partedAt(const float* mean, int channels, int half) const {
  const auto strangeness = [&](int o) { return (colourAt(mean, channels, half, o) - outside_).norm(); };
  const float change = strangeness(1);
  if (change < kLeastChange || strangeness(kNextTo) < kAlike * change) return std::nullopt;
  for (int o = kNextTo + 1; o <= half; ++o)
    if (strangeness(o) < kAlike * change) {
      int best = o - 1;
      float steepest = 0.0f;
      for (int k = 1; k <= o; ++k) {
        if (k + 1 > half) break;
        const float fall = strangeness(k - 1) - strangeness(k + 1);
        if (k >= 2 && fall > steepest) steepest = fall, best = k;
      }
      return best;
    }
  return std::nullopt;
}

// The light changes; reveals do not become frames.
Vector3f FrontBorder::likest(const float* mean, int channels, int half) const {
  Vector3f likest = outside_;
  float least = std::numeric_limits<float>::infinity();
  for (int o = kNextTo; o <= half; ++o) {
    const Vector3f colour = colourAt(mean, channels, half, o);
    const float distance = (colour - outside_).norm();
    if (distance < least) least = distance, likest = colour;
  }
  return likest;
}

std::optional<double> FrontBorder::look(const EdgeProfiles& profiles, const OffsetLine& border, int half_px) {
  const int half = std::min(half_px, kHalf), channels = profiles.channels();
  std::array<float, 3 * (2 * kHalf + 1)> mean;
  if (half <= kNextTo || profiles.meanAlong(border, half, mean.data()) == 0) return std::nullopt;
  const Vector3f next = colourAt(mean.data(), channels, half, kNextTo);
  if (!known_) {
    outside_ = next;
    known_ = true;
    parted_ = 0;
    return std::nullopt;
  }
  const auto at = partedAt(mean.data(), channels, half);
  parted_ = at ? parted_ + 1 : 0;
  outside_ += kAdaption * (likest(mean.data(), channels, half) - outside_);
  if (parted_ < kTimes) return std::nullopt;
  parted_ = 0;
  return *at;
}

}  // namespace window_ingress::detection
