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
constexpr float kRisesAgain = 1.4f;   // an edge is so much steeper than what lies before it
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
  int reached = kNextTo + 1;
  while (reached <= half && strangeness(reached) >= kAlike * change) ++reached;
  if (reached >= half) return std::nullopt;
  // A wide blur ends gently, an edge of its own rises again.
  float least = std::numeric_limits<float>::infinity(), steepest = 0.0f;
  int best = 0;
  for (int o = 1; o <= reached; ++o) {
    const float fall = strangeness(o - 1) - strangeness(o + 1);
    if (o >= kNextTo && fall > kRisesAgain * std::max(0.0f, least) && fall > steepest)
      steepest = fall, best = o;
    least = std::min(least, fall);
  }
  if (best == 0) return std::nullopt;
  return best;
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
