#include "adapters/markers/marker_colours.hpp"

#include <cstddef>

namespace window_ingress::adapters {
namespace {

constexpr int kStateRgb[navigation::kStateCount] = {
    0xaaaaaa,  // IDLE
    0x9b59b6,  // SEARCH
    0x1f5fa8,  // ALIGN
    0x56c1e8,  // APPROACH
    0xe67e22,  // COMMIT
    0x2e9e4f,  // PASSED
    0xd0312d,  // BACK_OFF
    0xf1c40f,  // HOLD
    0x000000,  // ABORTED
};

}  // namespace

std_msgs::ColorRGBA colourOf(int rgb, double alpha) {
  std_msgs::ColorRGBA colour;
  colour.r = static_cast<float>((rgb >> 16) & 0xff) / 255.0F;
  colour.g = static_cast<float>((rgb >> 8) & 0xff) / 255.0F;
  colour.b = static_cast<float>(rgb & 0xff) / 255.0F;
  colour.a = static_cast<float>(alpha);
  return colour;
}

std_msgs::ColorRGBA colourOf(navigation::State state, double alpha) {
  return colourOf(kStateRgb[static_cast<std::size_t>(state)], alpha);
}

}  // namespace window_ingress::adapters
