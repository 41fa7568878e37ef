#include "window_ingress/detection/colour_sharpness.hpp"

#include <cstddef>
#include <vector>

namespace window_ingress::detection {
namespace {

const Eigen::Vector3f kBrightness(0.114f, 0.587f, 0.299f);
constexpr double kSoftRatio = 0.45;   // of the differences: an edge blurred by a pixel
constexpr double kLeastColour = 0.5;  // mean square of the first differences that is not nothing
constexpr float kTrusted = 0.35f;     // part of a change of colour beside one of brightness

}  // namespace

float brightnessOf(const Eigen::Vector3f& bgr) { return kBrightness.dot(bgr); }

bool isColourSoft(const EdgeProfiles& profiles) {
  if (profiles.channels() != 3) return false;
  double first = 0.0, second = 0.0;
  int count = 0;
  for (int i = 0; i < profiles.count(); ++i) {
    if (!profiles.inside(i)) continue;
    const float *b = profiles.samples(i, 0), *g = profiles.samples(i, 1), *r = profiles.samples(i, 2);
    for (int k = 1; k + 1 < profiles.width(); ++k) {
      const auto blue = [&](int at) { return b[at] - 0.5f * (g[at] + r[at]); };
      const auto red = [&](int at) { return r[at] - g[at]; };
      const float blue_step = blue(k + 1) - blue(k), red_step = red(k + 1) - red(k);
      const float blue_bend = blue_step - (blue(k) - blue(k - 1)),
                  red_bend = red_step - (red(k) - red(k - 1));
      first += blue_step * blue_step + red_step * red_step;
      second += blue_bend * blue_bend + red_bend * red_bend;
      ++count;
    }
  }
  return first > kLeastColour * count && second < kSoftRatio * first;
}

Eigen::Vector3f resolvedPart(const Eigen::Vector3f& change) {
  const Eigen::Vector3f brightness = Eigen::Vector3f::Constant(brightnessOf(change));
  return brightness + kTrusted * (change - brightness);
}

}  // namespace window_ingress::detection
