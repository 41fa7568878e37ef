#include <gtest/gtest.h>

#include <limits>

#include "adapters/conversions/msg_conversion.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::adapters {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

estimation::PoseResult makePoseResult() {
  estimation::WindowPoseEstimate estimate;
  estimate.best.T_camera_window = geometry::makePose(geometry::R_optical_flu(), {0.1, 0.2, 4.0});
  estimate.best.covariance = estimation::Matrix6d::Identity() * 0.01;
  estimate.yaw_rad = 0.1;
  estimate.sigma_u_rad = 0.02;
  estimate.sign_trusted = true;
  estimation::PoseResult result;
  result.estimate = estimate;
  return result;
}

TEST(WindowPose, CarriesTheEstimate) {
  window_ingress::WindowPose message;
  fill(message, makePoseResult());
  EXPECT_EQ(message.reject, window_ingress::WindowPose::OK);
  EXPECT_EQ(message.pose.pose.position.z, 4.0);
  EXPECT_EQ(message.yaw, 0.1);
  EXPECT_EQ(message.sigma_u, 0.02);
  EXPECT_TRUE(message.sign_trusted);
  EXPECT_FALSE(message.has_alternative);
}

TEST(WindowPose, CarriesTheCameraThereAndBack) {
  window_ingress::WindowPose message;
  EXPECT_FALSE(cameraFromMsg(message.camera));
  fill(message, navigation::CameraInBody{0.1, 1.2, 0.9, 0.002});
  const auto back = cameraFromMsg(message.camera);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->forward_m, 0.1);
  EXPECT_EQ(back->horizontal_fov_rad, 1.2);
  EXPECT_EQ(back->vertical_fov_rad, 0.9);
  EXPECT_EQ(back->pixel_rad, 0.002);
  message.camera.fault = "no calibration";
  EXPECT_FALSE(cameraFromMsg(message.camera));
}

TEST(WindowPose, CarriesTheReasonWhereThereIsNoPose) {
  estimation::PoseResult result;
  result.reject = estimation::PoseReject::kTilt;
  window_ingress::WindowPose message;
  fill(message, result);
  EXPECT_EQ(message.reject, window_ingress::WindowPose::TILT);
  EXPECT_FALSE(message.reject_reason.empty());
  EXPECT_EQ(message.pose.pose.orientation.w, 0.0);
}

TEST(WindowPose, CarriesSizeFitFramesAndConsistency) {
  estimation::FilteredWindow filtered;
  filtered.age_sec = 0.25;
  filtered.size = {{1.3, 0.9}, 0.0004 * Eigen::Matrix2d::Identity()};
  filtered.alternative = estimation::FilteredWindow::Alternative();
  filtered.alternative->T_odom_window.translation().x() = 7.0;
  filtered.consistency = {40, 1.5, true};
  window_ingress::WindowPose message;
  fill(message, filtered);
  fill(message, estimation::SizeEstimate{{1.31, 0.91}, 0.0001 * Eigen::Matrix2d::Identity()});
  fill(message, estimation::FitVerdict{estimation::Fit::kNoGo, "too narrow"});
  fill(message, estimation::FramesVerdict{estimation::FramesVerdict::kWrong, "twist looks odd"});
  EXPECT_EQ(message.filtered_age, 0.25);
  EXPECT_EQ(message.window_width, 1.3);
  EXPECT_NEAR(message.window_height_sigma, 0.018, 1e-12);
  EXPECT_TRUE(message.has_filtered_alternative);
  EXPECT_EQ(message.filtered_alternative.pose.position.x, 7.0);
  EXPECT_EQ(message.measured_width, 1.31);
  EXPECT_NEAR(message.measured_width_sigma, 0.0131, 1e-12);
  EXPECT_EQ(message.fit, window_ingress::WindowPose::FIT_NO_GO);
  EXPECT_EQ(message.frames, window_ingress::WindowPose::FRAMES_WRONG);
  EXPECT_EQ(message.frames_reason, "twist looks odd");
  EXPECT_EQ(message.nis, 1.5);
  EXPECT_EQ(message.nis_images, 40u);
}

window_ingress::WindowPose makeFiltered() {
  estimation::FilteredWindow filtered;
  filtered.stamp_sec = 12.5;
  filtered.T_odom_window = geometry::makePose(geometry::yawRotation(0.5), {1.0, 2.0, 1.5});
  filtered.covariance(1, 2) = 0.25;
  filtered.sign_trusted = true;
  filtered.updates = 9;
  window_ingress::WindowPose message;
  fill(message, filtered);
  message.filtered_frame_id = "odom";
  message.window_width = 1.2;
  message.window_height = 1.0;
  return message;
}

TEST(WindowPose, FilteredWindowBecomesTheTarget) {
  const auto target = targetFromMsg(makeFiltered(), "odom");
  ASSERT_TRUE(target) << target.reason;
  EXPECT_EQ(target.value->stamp_sec, 12.5);
  EXPECT_NEAR(geometry::yawOf(target.value->T_odom_window.linear()), 0.5, 1e-12);
  EXPECT_EQ(target.value->covariance(1, 2), 0.25);
  EXPECT_EQ(target.value->covariance(2, 1), 0.0) << "row-major";
  EXPECT_TRUE(target.value->sign_trusted);
  EXPECT_EQ(target.value->updates, 9);
  EXPECT_EQ(target.value->opening.width_m, 1.2);
}

TEST(WindowPose, CarriesTheMotionOfAWindow) {
  estimation::FilteredWindow filtered;
  filtered.stamp_sec = 12.0;
  filtered.age_sec = 0.25;
  filtered.covariance = 0.01 * estimation::Matrix6d::Identity();
  filtered.size = {{1.3, 0.9}, Eigen::Matrix2d::Zero()};
  filtered.motion = {{0.12, 2.0}, {0.1, -0.05, 0.01}, 0.04};
  window_ingress::WindowPose message;
  message.filtered_frame_id = "odom";
  fill(message, filtered);
  const auto target = targetFromMsg(message, "odom");
  ASSERT_TRUE(target) << target.reason;
  EXPECT_EQ(target.value->pose_stamp_sec, 12.25);
  EXPECT_EQ(target.value->motion.velocity_odom_mps, filtered.motion.velocity_odom_mps);
  EXPECT_EQ(target.value->motion.velocity_sigma_mps, 0.04);
  EXPECT_EQ(target.value->motion.model.speed_mps, 0.12);
  EXPECT_EQ(target.value->motion.model.time_sec, 2.0);
  filtered.motion = {};
  fill(message, filtered);
  EXPECT_TRUE(targetFromMsg(message, "odom").value->motion.model.stands());
}

TEST(WindowPose, WhatForbidsTheApproachReachesTheTarget) {
  auto message = makeFiltered();
  EXPECT_EQ(targetFromMsg(message, "odom").value->fit, estimation::Fit::kGo) << "nothing said against it";
  message.fit = window_ingress::WindowPose::FIT_UNKNOWN;
  message.approach_forbidden = "fit UNKNOWN";
  EXPECT_EQ(targetFromMsg(message, "odom").value->fit, estimation::Fit::kUnknown);
  EXPECT_EQ(targetFromMsg(message, "odom").value->approach_forbidden, "fit UNKNOWN");
}

TEST(WindowPose, TargetsThatCannotBeUsedAreRefused) {
  const auto refused = [](auto change) {
    window_ingress::WindowPose message = makeFiltered();
    change(message);
    return !targetFromMsg(message, "odom");
  };
  EXPECT_TRUE(refused([](auto& m) { m.filtered_valid = false; }));
  EXPECT_TRUE(refused([](auto& m) { m.filtered_frame_id = "map"; }));
  EXPECT_TRUE(refused([](auto& m) { m.filtered_stamp = ros::Time(); }));
  EXPECT_TRUE(refused([](auto& m) { m.filtered.pose.position.x = kNan; }));
  EXPECT_TRUE(
      refused([](auto& m) { m.filtered.pose.orientation.w = 0.0, m.filtered.pose.orientation.z = 0.0; }));
  EXPECT_TRUE(refused([](auto& m) { m.filtered.covariance[35] = kNan; }));
  EXPECT_TRUE(refused([](auto& m) { m.window_width = 0.0; }));
  EXPECT_TRUE(refused([](auto& m) { m.window_height = kNan; }));
}

TEST(IngressState, SaysWhatTheNavigatorSays) {
  navigation::NavigatorOutput output;
  output.state = navigation::State::kHold;
  output.reason = "odometry 0.41 s old";
  output.enabled = true;
  output.setpoint.velocity_odom_mps = {0.1, 0.2, 0.3};
  output.report.retries = 2;
  output.report.vehicle = {true, 0.46, 1.0, {0.1, -0.2, 0.0}};
  const auto message = toMsg(output);
  EXPECT_EQ(message.state, window_ingress::IngressState::HOLD);
  EXPECT_EQ(message.state_name, "HOLD");
  EXPECT_EQ(message.reason, output.reason);
  EXPECT_EQ(message.velocity.z, 0.3);
  EXPECT_EQ(message.retries, 2u);
  EXPECT_TRUE(message.response_measured);
  EXPECT_EQ(message.response, 0.46);
  EXPECT_EQ(message.acceleration_limit, 1.0);
  EXPECT_EQ(message.velocity_bias.y, -0.2);
  output.report.vehicle.acceleration_mps2 = std::numeric_limits<double>::infinity();
  EXPECT_EQ(toMsg(output).acceleration_limit, 0.0) << "none has shown";
}

}  // namespace
}  // namespace window_ingress::adapters
