#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <tuple>

#include "adapters/conversions/msg_conversion.hpp"
#include "adapters/markers/window_markers.hpp"
#include "window_row.hpp"

namespace window_ingress::adapters::facade_conversion_test {

facade::FacadeMemory memoryOfARow() {
  const test::WindowRow row;
  facade::FacadeMemory memory{facade::FacadeParams()};
  std::mt19937 random(1);
  for (int n = 0; n < 20; ++n)
    memory.addView(row.look(10.0 + 0.1 * n, row.from({-8.0, -3.8, 1.5}), 2, random), row.tracked(2),
                   row.size);
  return memory;
}

TEST(FacadeConversion, TellsEveryWindowWithItsNumberAndWhichIsTheTarget) {
  const auto memory = memoryOfARow();
  const window_ingress::Facade message = toMsg(memory, 13.0);
  ASSERT_EQ(message.windows.size(), 5u);
  EXPECT_EQ(message.target_id, memory.targetId());
  EXPECT_FALSE(message.target_chosen);
  for (const window_ingress::KnownWindow& window : message.windows) {
    const facade::KnownWindow& known = *std::find_if(memory.windows().begin(), memory.windows().end(),
                                                     [&](const auto& one) { return one.id == window.id; });
    EXPECT_DOUBLE_EQ(window.pose.position.y, known.place.position_m.y());
    EXPECT_DOUBLE_EQ(window.position_covariance[4], known.place.covariance(1, 1));
    EXPECT_NEAR(window.last_seen, 1.1, 1e-9);
    EXPECT_NEAR(window.width, 1.2, 0.1);
  }
  EXPECT_EQ(facadeMarkers(message).markers.size(), 4u + 5u + 5u)
      << "a border each but the target's, a face and a text";
}

TEST(FacadeConversion, AWindowIsListedAtItsThirdSight) {
  const test::WindowRow row;
  facade::FacadeMemory memory{facade::FacadeParams()};
  std::mt19937 random(1);
  for (int sights = 1; sights <= 3; ++sights) {
    memory.addView(row.look(10.0 + 0.1 * sights, row.from({-8.0, -3.8, 1.5}), -1, random), std::nullopt,
                   row.size);
    EXPECT_EQ(toMsg(memory, 13.0).windows.size(), sights < 3 ? 0u : 5u);
  }
}

TEST(FacadeConversion, WhatIsTooSmallOrBadOrOfAnotherLookIsNotDrawn) {
  window_ingress::Facade message;
  for (const auto& [id, width, alike, score, openness] : {std::tuple{1u, 1.2, true, 0.9, 0},
                                                          {2u, 0.1, true, 0.9, 0},
                                                          {3u, 1.2, false, 0.9, 0},
                                                          {4u, 1.2, true, 0.2, 0},
                                                          {5u, 1.2, false, 0.0, 2}}) {
    window_ingress::KnownWindow& window = message.windows.emplace_back();
    window.id = id;
    window.pose.position.y = 2.0 * id;
    window.pose.orientation.w = 1.0;
    window.width = window.height = width;
    window.may_be_target = alike;
    window.score = score;
    window.openness = static_cast<std::uint8_t>(openness);
  }
  const auto markers = facadeMarkers(message).markers;
  ASSERT_EQ(markers.size(), 6u) << "a border, a face and a text each";
  EXPECT_EQ(markers[2].text, "1: open?");
  EXPECT_EQ(markers[5].text, "5: CLOSED");
  EXPECT_GT(markers[5].pose.position.z, 0.6) << "above its border";
  message.target_id = 3;
  EXPECT_EQ(facadeMarkers(message).markers.size(), 8u) << "the target is named, whatever it looks like";
}

TEST(FacadeConversion, AFaceFillsEachWindowSoThatAClickWithinMeetsIt) {
  const window_ingress::Facade message = toMsg(memoryOfARow(), 13.0);
  for (const window_ingress::KnownWindow& window : message.windows) {
    const auto markers = facadeMarkers(message).markers;
    const auto face = std::find_if(markers.begin(), markers.end(), [&](const auto& one) {
      return one.ns == "window " + std::to_string(window.id) + ": face";
    });
    ASSERT_NE(face, markers.end()) << window.id;
    ASSERT_EQ(face->points.size(), 6u);
    double area_m2 = 0.0;
    for (std::size_t i = 0; i < 6; i += 3) {
      const auto at = [&](std::size_t k) -> Eigen::Vector3d {
        return {face->points[i + k].x, face->points[i + k].y, face->points[i + k].z};
      };
      area_m2 += 0.5 * (at(1) - at(0)).cross(at(2) - at(0)).norm();
    }
    EXPECT_NEAR(area_m2, window.width * window.height, 1e-9);
    EXPECT_LT(face->color.a, 0.3F) << "and it is seen through";
  }
}

TEST(FacadeConversion, OneThingUnderTwoNumbersIsDrawnOnce) {
  window_ingress::Facade message;
  for (const auto& [id, y, width, score] :
       {std::tuple{1u, 0.0, 1.0, 0.6}, {2u, 0.4, 0.5, 0.7}, {3u, 2.0, 1.0, 0.8}}) {
    window_ingress::KnownWindow& window = message.windows.emplace_back();
    window.id = id;
    window.pose.position.y = y;
    window.pose.orientation.w = 1.0;
    window.width = window.height = width;
    window.may_be_target = true;
    window.score = score;
  }
  const auto numbers = [&] {
    std::string texts;
    for (const auto& marker : facadeMarkers(message).markers) texts += marker.text.substr(0, 1);
    return texts;
  };
  EXPECT_EQ(numbers(), "23") << "the better score; the other stands beside them";
  message.target_id = 1;
  EXPECT_EQ(numbers(), "13") << "the target before all others";
  message.windows[1].openness = window_ingress::Openness::CLOSED;
  EXPECT_EQ(numbers(), "123") << "what was found out is not left out";
}

TEST(FacadeConversion, WindowsOfAnImageGoThereAndBackAndBadOnesAreLeftOut) {
  std::mt19937 random(2);
  const test::WindowRow row;
  detection::SeenWindow window = *row.seen(0, row.from({-5.0, 0.0, 1.5}), random);
  window.has_appearance = true;
  window.bhattacharyya = 0.25;
  window.is_target = true;
  window_ingress::WindowDetection message;
  message.windows.assign(100, toMsg(window));
  message.windows[0].corner_x[1] = std::numeric_limits<double>::quiet_NaN();
  message.windows[1].corner_x.fill(0.0);
  message.windows[2].score = std::numeric_limits<double>::infinity();
  const auto windows = seenWindowsFrom(message);
  ASSERT_EQ(windows.size(), kMaxSeenWindows);
  EXPECT_EQ(windows[0].corners, window.corners);
  EXPECT_EQ(windows[0].bhattacharyya, 0.25);
  EXPECT_TRUE(windows[0].is_target);
  EXPECT_TRUE(windows[0].may_be_target);
}

TEST(FacadeConversion, APlaceIsRememberedOnlyWithANumberAndInTheSameFrame) {
  window_ingress::WindowPose message;
  message.filtered.header.frame_id = "odom";
  message.target.position.x = 2.0;
  EXPECT_FALSE(rememberedFrom(message, "odom"));
  message.target.window_id = 3;
  ASSERT_TRUE(rememberedFrom(message, "odom"));
  EXPECT_EQ(rememberedFrom(message, "odom")->x(), 2.0);
  EXPECT_FALSE(rememberedFrom(message, "map"));
  message.target.position.y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(rememberedFrom(message, "odom"));
}

TEST(FacadeConversion, WhereTheTargetIsExpectedGoesThereAndBack) {
  const auto memory = memoryOfARow();
  const geometry::Quadrilateral expected = {{{1, 2}, {30, 2}, {30, 40}, {1, 40}}};
  window_ingress::RememberedTarget message = targetMsg(memory.target(), expected);
  EXPECT_EQ(message.window_id, memory.targetId());
  EXPECT_EQ(message.position.y, memory.target()->place.position_m.y());
  ASSERT_TRUE(expectedFrom(message));
  EXPECT_EQ(*expectedFrom(message), expected);
  message.expected_x[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(expectedFrom(message));
  EXPECT_FALSE(expectedFrom(targetMsg(nullptr, std::nullopt)));
  EXPECT_EQ(targetMsg(nullptr, std::nullopt).window_id, 0u);
}

}  // namespace window_ingress::adapters::facade_conversion_test
