#include "adapters/markers/marker_colours.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>

namespace window_ingress::adapters::marker_colours_test {

std::string textOf(const std::string& file) {
  std::stringstream text;
  text << std::ifstream(WINDOW_INGRESS_SOURCE_DIR "/" + file).rdbuf();
  return text.str();
}

std::string hexOf(const std_msgs::ColorRGBA& colour) {
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", static_cast<int>(255.0F * colour.r + 0.5F),
                static_cast<int>(255.0F * colour.g + 0.5F), static_cast<int>(255.0F * colour.b + 0.5F));
  return text;
}

TEST(MarkerColours, StatesLookAsInThePlots) {
  const std::string plots = textOf("tools/ingress_tools/flight_data.py");
  ASSERT_FALSE(plots.empty());
  for (int i = 0; i <= static_cast<int>(navigation::State::kAborted); ++i) {
    const auto state = static_cast<navigation::State>(i);
    const std::string entry =
        std::string("\"") + navigation::toString(state) + "\": \"" + hexOf(colourOf(state));
    EXPECT_NE(plots.find(entry), std::string::npos) << entry;
  }
}

TEST(MarkerColours, TheDocumentHasEachOfThem) {
  const std::string document = textOf("doc/tools.md");
  for (const int rgb : {kTrustedRgb, kOpenRgb, kMirroredRgb, kWallRgb, kSetpointRgb})
    EXPECT_NE(document.find(hexOf(colourOf(rgb))), std::string::npos) << hexOf(colourOf(rgb));
}

TEST(MarkerColours, ChannelsAreRedGreenBlue) {
  const std_msgs::ColorRGBA colour = colourOf(0x336699, 0.25);
  EXPECT_FLOAT_EQ(colour.r, 0.2F);
  EXPECT_FLOAT_EQ(colour.g, 0.4F);
  EXPECT_FLOAT_EQ(colour.b, 0.6F);
  EXPECT_FLOAT_EQ(colour.a, 0.25F);
}

}  // namespace window_ingress::adapters::marker_colours_test
