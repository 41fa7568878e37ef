#include <gtest/gtest.h>

#include <limits>

#include "adapters/conversions/msg_conversion.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::adapters::pose_conversion_test {

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
  estimation::PoseResult result = makePoseResult();
  result.estimate->euler = {0.01, 0.02, 0.03};
  result.estimate->opening_width_m = 1.1;
  result.estimate->right_side_px = 80.0;
  window_ingress::ImagePose message = toMsg(result);
  EXPECT_EQ(message.reject, window_ingress::ImagePose::OK);
  EXPECT_EQ(message.pose.pose.position.z, 4.0);
  EXPECT_EQ(message.relative_yaw.angle, 0.1);
  EXPECT_EQ(message.relative_yaw.sigma_unknown_size, 0.02);
  EXPECT_TRUE(message.relative_yaw.sign_trusted);
  EXPECT_EQ(message.euler.roll, 0.01);
  EXPECT_EQ(message.euler.pitch, 0.02);
  EXPECT_EQ(message.euler.yaw, 0.03);
  EXPECT_EQ(message.apparent.width, 1.1);
  EXPECT_EQ(message.apparent.right_side, 80.0);
  EXPECT_EQ(message.apparent.aspect, 0.0);
  EXPECT_FALSE(message.has_alternative);
  result.estimate->aspect = estimation::MeasuredAspect{1.2, 0.05};
  result.estimate->alternative = result.estimate->best;
  result.estimate->alternative->reprojection_rms_px = 0.4;
  message = toMsg(result);
  EXPECT_EQ(message.apparent.aspect_sigma, 0.05);
  EXPECT_TRUE(message.has_alternative);
  EXPECT_EQ(message.alternative_reprojection_rms_px, 0.4);
}

TEST(WindowPose, CarriesTheCameraThereAndBack) {
  EXPECT_FALSE(cameraFromMsg(window_ingress::CameraInBody()));
  window_ingress::CameraInBody message = toMsg(navigation::CameraInBody{0.1, 1.2, 0.9, 0.002});
  const auto back = cameraFromMsg(message);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->forward_m, 0.1);
  EXPECT_EQ(back->horizontal_fov_rad, 1.2);
  EXPECT_EQ(back->vertical_fov_rad, 0.9);
  EXPECT_EQ(back->pixel_rad, 0.002);
  message.fault = "no calibration";
  EXPECT_FALSE(cameraFromMsg(message));
}

TEST(WindowPose, CarriesTheReasonWhereThereIsNoPose) {
  estimation::PoseResult result;
  result.reject = estimation::PoseReject::kTilt;
  const window_ingress::ImagePose message = toMsg(result);
  EXPECT_EQ(message.reject, window_ingress::ImagePose::TILT);
  EXPECT_FALSE(message.reason.empty());
  EXPECT_EQ(message.pose.pose.orientation.w, 0.0);
}

TEST(WindowPose, CarriesTheOtherHypothesis) {
  estimation::FilteredWindow filtered;
  filtered.age_sec = 0.25;
  filtered.alternative = estimation::FilteredWindow::Alternative();
  filtered.alternative->T_odom_window.translation().x() = 7.0;
  const window_ingress::FilteredPose message = toMsg(filtered);
  EXPECT_EQ(message.age, 0.25);
  EXPECT_EQ(message.reject, window_ingress::FilteredPose::OK);
  EXPECT_TRUE(message.has_alternative);
  EXPECT_EQ(message.alternative.pose.position.x, 7.0);
}

TEST(WindowPose, CarriesASizeWithItsDeviation) {
  const window_ingress::WindowSize message =
      toMsg(estimation::SizeEstimate{{1.31, 0.9}, 0.0001 * Eigen::Matrix2d::Identity()});
  EXPECT_EQ(message.width, 1.31);
  EXPECT_NEAR(message.width_sigma, 0.0131, 1e-12);
  EXPECT_NEAR(message.height_sigma, 0.009, 1e-12);
  EXPECT_EQ(toMsg(geometry::OpeningSize{1.3, 0.9}).height, 0.9);
  EXPECT_EQ(toMsg(geometry::OpeningSize{1.3, 0.9}).height_sigma, 0.0);
}

TEST(WindowPose, CarriesWhatWasVerified) {
  VerifiedTarget verified;
  EXPECT_EQ(toMsg(verified).fit, window_ingress::SystemChecks::FIT_UNKNOWN);
  verified.fit = {estimation::Fit::kNoGo, "too narrow"};
  verified.frames = {estimation::FramesVerdict::kWrong, "twist looks odd"};
  verified.consistency = {40, 1.5, true};
  verified.other_window = 1.8;
  verified.approach_forbidden = "fit NO_GO";
  verified.unverified = "camera mounting";
  const window_ingress::SystemChecks message = toMsg(verified);
  EXPECT_EQ(message.fit, window_ingress::SystemChecks::FIT_NO_GO);
  EXPECT_EQ(message.frames, window_ingress::SystemChecks::FRAMES_WRONG);
  EXPECT_EQ(message.frames_reason, "twist looks odd");
  EXPECT_EQ(message.nis, 1.5);
  EXPECT_EQ(message.nis_images, 40u);
  EXPECT_TRUE(message.is_other_window);
  EXPECT_EQ(message.other_window_factor, 1.8);
  EXPECT_EQ(message.approach_forbidden, "fit NO_GO");
  EXPECT_EQ(message.unverified, "camera mounting");
}

TEST(WindowPose, CarriesOpennessThereAndBackAndWhatIsNoVerdictIsNone) {
  openness::OpennessVerdict verdict;
  verdict.openness = openness::Openness::kClosed;
  verdict.log_odds = -12.0;
  verdict.has_depth = true;
  verdict.depth_behind_m = 0.02;
  verdict.open_share = 0.25;
  window_ingress::Openness message = toMsg(verdict);
  EXPECT_EQ(fromMsg(message).openness, openness::Openness::kClosed);
  EXPECT_EQ(fromMsg(message).log_odds, -12.0);
  EXPECT_EQ(fromMsg(message).depth_behind_m, 0.02);
  EXPECT_EQ(fromMsg(message).open_share, 0.25);
  message.verdict = 3;
  EXPECT_EQ(fromMsg(message).openness, openness::Openness::kUnknown);
  message.verdict = window_ingress::Openness::OPEN;
  message.log_odds = kNan;
  EXPECT_EQ(fromMsg(message).openness, openness::Openness::kUnknown);
}

window_ingress::WindowPose makeFiltered() {
  estimation::FilteredWindow filtered;
  filtered.stamp_sec = 12.5;
  filtered.T_odom_window = geometry::makePose(geometry::yawRotation(0.5), {1.0, 2.0, 1.5});
  filtered.covariance(1, 2) = 0.25;
  filtered.sign_trusted = true;
  filtered.updates = 9;
  window_ingress::WindowPose message;
  message.filtered = toMsg(filtered);
  message.filtered.header.frame_id = "odom";
  message.size = toMsg(geometry::OpeningSize{1.2, 1.0});
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
  EXPECT_EQ(target.value->opening.width_m, 1.2);
}

TEST(WindowPose, CarriesTheMotionOfAWindow) {
  estimation::FilteredWindow filtered;
  filtered.stamp_sec = 12.0;
  filtered.age_sec = 0.25;
  filtered.covariance = 0.01 * estimation::Matrix6d::Identity();
  filtered.motion = {{0.12, 2.0}, {0.1, -0.05, 0.01}, 0.04};
  window_ingress::WindowPose message = makeFiltered();
  message.filtered = toMsg(filtered);
  message.filtered.header.frame_id = "odom";
  const auto target = targetFromMsg(message, "odom");
  ASSERT_TRUE(target) << target.reason;
  EXPECT_EQ(target.value->pose_stamp_sec, 12.25);
  EXPECT_EQ(target.value->motion.velocity_odom_mps, filtered.motion.velocity_odom_mps);
  EXPECT_EQ(target.value->motion.velocity_sigma_mps, 0.04);
  EXPECT_EQ(target.value->motion.model.speed_mps, 0.12);
  EXPECT_EQ(target.value->motion.model.time_sec, 2.0);
  message.filtered.motion = toMsg(estimation::FilteredWindow()).motion;
  EXPECT_TRUE(targetFromMsg(message, "odom").value->motion.model.stands());
}

TEST(WindowPose, WhatForbidsTheApproachReachesTheTarget) {
  auto message = makeFiltered();
  EXPECT_EQ(targetFromMsg(message, "odom").value->fit, estimation::Fit::kGo) << "nothing said against it";
  message.checks.fit = window_ingress::SystemChecks::FIT_UNKNOWN;
  message.checks.approach_forbidden = "fit UNKNOWN";
  EXPECT_EQ(targetFromMsg(message, "odom").value->fit, estimation::Fit::kUnknown);
  EXPECT_EQ(targetFromMsg(message, "odom").value->approach_forbidden, "fit UNKNOWN");
  message.checks.unverified = "camera mounting";
  EXPECT_EQ(targetFromMsg(message, "odom").value->unverified, "camera mounting");
}

TEST(WindowPose, TargetsThatCannotBeUsedAreRefused) {
  const auto refused = [](auto change) {
    window_ingress::WindowPose message = makeFiltered();
    change(message);
    return !targetFromMsg(message, "odom");
  };
  EXPECT_TRUE(refused([](auto& m) { m.filtered.valid = false; }));
  EXPECT_TRUE(refused([](auto& m) { m.filtered.header.frame_id = "map"; }));
  EXPECT_TRUE(refused([](auto& m) { m.filtered.header.stamp = ros::Time(); }));
  EXPECT_TRUE(refused([](auto& m) { m.filtered.pose.pose.position.x = kNan; }));
  EXPECT_TRUE(refused([](auto& m) { m.filtered.pose.pose.orientation = geometry_msgs::Quaternion(); }));
  EXPECT_TRUE(refused([](auto& m) { m.filtered.pose.covariance[35] = kNan; }));
  EXPECT_TRUE(refused([](auto& m) { m.size.width = 0.0; }));
  EXPECT_TRUE(refused([](auto& m) { m.size.height = kNan; }));
  EXPECT_TRUE(refused([](auto& m) { m.checks.is_other_window = true; })) << "without a factor";
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

}  // namespace window_ingress::adapters::pose_conversion_test
