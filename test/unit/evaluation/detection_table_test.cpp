#include "window_ingress/evaluation/detection_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace window_ingress::evaluation {
namespace {

TEST(DetectionTable, RowsHaveAsManyFieldsAsTheHeader) {
  const auto commas = [](const std::string& text) { return std::count(text.begin(), text.end(), ','); };
  DetectionRow row;
  row.reject_reason = "border";
  EXPECT_EQ(commas(detectionValues(row)), commas(detectionColumns()));
  row.window.emplace();
  for (auto& corner : row.window->corners) corner.setZero();
  row.window->has_appearance = true;
  row.pose.emplace();
  EXPECT_EQ(commas(detectionValues(row)), commas(detectionColumns()));
}

TEST(DetectionTable, CornersThatAreNotSeenStayEmpty) {
  DetectionRow row;
  row.window.emplace();
  for (auto& corner : row.window->corners) corner.setConstant(7.0);
  row.window->corner_visible[2] = false;
  EXPECT_EQ(detectionValues(row).substr(0, 55), "1,0.0000,,7.000,7.000,7.000,7.000,,,7.000,7.000,,,,,,,,");
}

TEST(DetectionTable, FieldsWithCommasAreQuoted) {
  EXPECT_EQ(csvField("plain.png"), "plain.png");
  EXPECT_EQ(csvField("a,\"b\""), "\"a,\"\"b\"\"\"");
}

}  // namespace
}  // namespace window_ingress::evaluation
