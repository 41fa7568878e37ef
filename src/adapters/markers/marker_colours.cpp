#include "adapters/markers/marker_colours.hpp"

namespace window_ingress::adapters {
namespace {

int rgbOf(navigation::State state) {
  switch (state) {
    case navigation::State::kIdle:
      return 0xaaaaaa;
    case navigation::State::kSearch:
      return 0x9b59b6;
    case navigation::State::kAlign:
      return 0x1f5fa8;
    case navigation::State::kApproach:
      return 0x56c1e8;
    case navigation::State::kCommit:
      return 0xe67e22;
    case navigation::State::kPassed:
      return 0x2e9e4f;
    case navigation::State::kBackOff:
      return 0xd0312d;
    case navigation::State::kHold:
      return 0xf1c40f;
    case navigation::State::kAborted:
      break;
  }
  return 0x000000;
}

}  // namespace

std_msgs::ColorRGBA colourOf(int rgb, double alpha) {
  std_msgs::ColorRGBA colour;
  colour.r = static_cast<float>((rgb >> 16) & 0xff) / 255.0F;
  colour.g = static_cast<float>((rgb >> 8) & 0xff) / 255.0F;
  colour.b = static_cast<float>(rgb & 0xff) / 255.0F;
  colour.a = static_cast<float>(alpha);
  return colour;
}

std_msgs::ColorRGBA colourOf(navigation::State state, double alpha) { return colourOf(rgbOf(state), alpha); }

}  // namespace window_ingress::adapters
