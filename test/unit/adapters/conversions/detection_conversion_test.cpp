#include <gtest/gtest.h>

#include <limits>

#include "adapters/conversions/msg_conversion.hpp"

namespace window_ingress::adapters::detection_conversion_test {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

detection::WindowObservation makeWindow() {
  detection::WindowObservation window;
  window.stamp_sec = 12.5;
  window.target_id = 7;
  window.corners = {{{100, 90}, {300, 95}, {310, 250}, {98, 240}}};
  for (int i = 0; i < 4; ++i) {
    window.corner_covariance[i] << 0.01 * (i + 1), 0.002, 0.002, 0.03;
    window.edges[i] = {i != 2, 0.1 * (i + 1), 0.001 * (i + 1), {100.0 + i, 20.0}, {150.0, 30.0 + i}};
  }
  window.score = 0.8;
  window.has_appearance = true;
  window.bhattacharyya = 0.3;
  window.correlation = 0.9, window.runner_up = 0.4;
  return window;
}

window_ingress::WindowDetection makeDetection() {
  window_ingress::WindowDetection message = toMsg(makeWindow());
  message.header.stamp = ros::Time(12.5);
  return message;
}

TEST(WindowDetection, GoesThereAndBack) {
  const auto back = fromMsg(makeDetection());
  ASSERT_TRUE(back) << back.reason;
  const detection::WindowObservation wanted = makeWindow();
  EXPECT_EQ(back.value->stamp_sec, wanted.stamp_sec);
  EXPECT_EQ(back.value->score, wanted.score);
  EXPECT_EQ(back.value->bhattacharyya, wanted.bhattacharyya);
  EXPECT_EQ(back.value->correlation, wanted.correlation);
  EXPECT_EQ(back.value->runner_up, wanted.runner_up);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(back.value->corners[i], wanted.corners[i]);
    EXPECT_EQ(back.value->corner_covariance[i], wanted.corner_covariance[i]);
    EXPECT_EQ(back.value->edges[i].visible, wanted.edges[i].visible);
    EXPECT_TRUE(back.value->corner_visible[i]);
    if (wanted.edges[i].visible) {
      EXPECT_EQ(back.value->edges[i].sigma_px, wanted.edges[i].sigma_px);
      EXPECT_EQ(back.value->edges[i].a, wanted.edges[i].a);
      EXPECT_EQ(back.value->edges[i].b, wanted.edges[i].b);
    }
  }
  EXPECT_EQ(back.value->target_id, 7u);
  EXPECT_TRUE(back.value->whole());
}

TEST(WindowDetection, WhatIsFollowedWithinGoesThereAndBack) {
  detection::WindowObservation window = makeWindow();
  window.interior.key_stamp_sec = 11.5;
  window.interior.key_corners = window.corners;
  window.interior.key_covariance = window.corner_covariance;
  window.interior.sigma_px = 0.4;
  window.interior.points.push_back({3, {120.5, 130.25}, {121.5, 129.75}, {0.0, 0.0}, 0b101});
  window.interior.points.push_back({9, {220.5, 130.25}, {221.5, 129.75}, {0.0, 1.0}, std::uint64_t{1} << 35});
  window_ingress::WindowDetection message = toMsg(window);
  message.header.stamp = ros::Time(12.5);
  const auto back = fromMsg(message);
  ASSERT_TRUE(back) << back.reason;
  const detection::InteriorTracks& interior = back.value->interior;
  ASSERT_EQ(interior.points.size(), 2u);
  EXPECT_EQ(interior.key_stamp_sec, 11.5);
  EXPECT_EQ(interior.key_corners, window.corners);
  EXPECT_EQ(interior.sigma_px, 0.4);
  EXPECT_EQ(interior.points[1].id, 9);
  EXPECT_EQ(interior.points[1].key_px, window.interior.points[1].key_px);
  EXPECT_EQ(interior.points[1].now_px, window.interior.points[1].now_px);
  EXPECT_EQ(interior.points[1].normal, window.interior.points[1].normal);
  EXPECT_EQ(interior.points[0].beside, window.interior.points[0].beside);
  EXPECT_EQ(interior.points[1].beside, window.interior.points[1].beside);
  message.interior.x.pop_back();
  EXPECT_TRUE(fromMsg(message).value->interior.empty()) << "lists of different lengths";
  message.interior = toMsg(window.interior);
  message.interior.key_corners[2].visible = false;
  EXPECT_TRUE(fromMsg(message).value->interior.empty()) << "a key image without all corners";
  message = toMsg(window);
  message.header.stamp = ros::Time(12.5);
  message.interior.y[0] = static_cast<float>(kNan);
  EXPECT_FALSE(fromMsg(message));
}

TEST(WindowDetection, ACornerThatIsNotSeenGoesThereAndBackAsNone) {
  detection::WindowObservation window = makeWindow();
  window.corner_visible = {true, true, false, false};
  window_ingress::WindowDetection message = toMsg(window);
  EXPECT_EQ(message.corners[2].x, 0.0);
  EXPECT_EQ(message.corners[3].covariance[3], 0.0);
  message.header.stamp = ros::Time(12.5);
  message.corners[3].x = 77.0;  // an invalid corner: its values must not count
  const auto back = fromMsg(message);
  ASSERT_TRUE(back);
  EXPECT_FALSE(back.value->whole());
  EXPECT_EQ(back.value->corner_visible, window.corner_visible);
  EXPECT_EQ(back.value->corners[3], Eigen::Vector2d(0, 0));
  EXPECT_EQ(back.value->corners[1], window.corners[1]);
  EXPECT_FALSE(back.value->edges[2].visible);
  EXPECT_EQ(back.value->edges[2].a, Eigen::Vector2d(0, 0));
}

TEST(WindowDetection, WhatIsNotVisibleHasNoFigures) {
  EXPECT_EQ(makeDetection().edges[2].sigma_px, 0.0);
  EXPECT_FALSE(makeDetection().edges[2].visible);
}

TEST(WindowDetection, RefusesNoWindowWithTheDetectorsReason) {
  detection::DetectionTrace trace;
  trace.outcome = detection::RejectReason::kAspect;
  trace.detail = "nothing with four sides";
  window_ingress::WindowDetection message = toMsg(trace);
  EXPECT_EQ(message.reject, window_ingress::WindowDetection::ASPECT);
  message.header.stamp = ros::Time(1.0);
  const auto window = fromMsg(message);
  EXPECT_FALSE(window);
  EXPECT_NE(window.reason.find("four sides"), std::string::npos);
}

TEST(WindowDetection, RefusesAnyNumberThatIsNotFinite) {
  const auto refused = [](auto change) {
    window_ingress::WindowDetection message = makeDetection();
    change(message);
    return !fromMsg(message);
  };
  EXPECT_TRUE(refused([](auto& m) { m.corners[3].x = kNan; }));
  EXPECT_TRUE(refused([](auto& m) { m.edges[1].b_y = kNan; }));
  EXPECT_TRUE(refused([](auto& m) { m.corners[0].y = std::numeric_limits<double>::infinity(); }));
  EXPECT_TRUE(refused([](auto& m) { m.corners[1].covariance[3] = kNan; }));
  EXPECT_TRUE(refused([](auto& m) { m.edges[1].sigma_rad = kNan; }));
  EXPECT_TRUE(refused([](auto& m) { m.score = kNan; }));
  EXPECT_TRUE(refused([](auto& m) { m.appearance.runner_up = kNan; }));
  EXPECT_TRUE(refused([](auto& m) { m.interior.key_corners[0].x = kNan; }));
  EXPECT_TRUE(refused([](auto& m) { m.header.stamp = ros::Time(); }));
}

}  // namespace window_ingress::adapters::detection_conversion_test
