#include <algorithm>
#include <cmath>

#include "adapters/conversions/msg_conversion.hpp"

namespace window_ingress::adapters {
namespace {

using RowMajor6d = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
using ChecksMsg = window_ingress::SystemChecks;
using OpennessMsg = window_ingress::Openness;
using StateMsg = window_ingress::IngressState;

window_ingress::RelativeYaw relativeYawMsg(const estimation::WindowPoseEstimate& estimate) {
  window_ingress::RelativeYaw message;
  message.angle = estimate.yaw_rad;
  message.sigma = estimate.yaw_sigma_rad;
  message.sigma_unknown_size = estimate.sigma_u_rad;
  message.from_sight = estimate.yaw_from_sight_rad;
  message.sign_trusted = estimate.sign_trusted;
  return message;
}

window_ingress::EulerAngles toMsg(const geometry::EulerAngles& angles) {
  window_ingress::EulerAngles message;
  message.roll = angles.roll_rad;
  message.pitch = angles.pitch_rad;
  message.yaw = angles.yaw_rad;
  return message;
}

window_ingress::ApparentOpening apparentMsg(const estimation::WindowPoseEstimate& estimate) {
  window_ingress::ApparentOpening message;
  message.width = estimate.opening_width_m;
  message.height = estimate.opening_height_m;
  message.left_side = estimate.left_side_px;
  message.right_side = estimate.right_side_px;
  if (!estimate.aspect) return message;
  message.aspect = estimate.aspect->ratio;
  message.aspect_sigma = estimate.aspect->sigma;
  return message;
}

window_ingress::WindowMotion toMsg(const estimation::TargetMotion& motion) {
  window_ingress::WindowMotion message;
  message.velocity = toVectorMsg(motion.velocity_odom_mps);
  message.velocity_sigma = motion.velocity_sigma_mps;
  message.typical_speed = motion.model.speed_mps;
  message.typical_time = motion.model.stands() ? 0.0 : motion.model.time_sec;
  return message;
}

// The navigator checks the numbers.
estimation::TargetMotion fromMsg(const window_ingress::WindowMotion& message) {
  return {{message.typical_speed, message.typical_time}, toEigen(message.velocity), message.velocity_sigma};
}

}  // namespace

geometry_msgs::PoseWithCovariance toMsg(const Eigen::Isometry3d& pose,
                                        const estimation::Matrix6d& covariance) {
  geometry_msgs::PoseWithCovariance message;
  message.pose = toPoseMsg(pose);
  Eigen::Map<RowMajor6d>(message.covariance.data()) = covariance;
  return message;
}

window_ingress::ImagePose toMsg(const estimation::PoseResult& result) {
  window_ingress::ImagePose message;
  message.reject = static_cast<std::uint8_t>(result.reject);
  if (!result.estimate) {
    message.reason = result.detail.empty() ? estimation::toString(result.reject) : result.detail;
    return message;
  }
  const estimation::WindowPoseEstimate& estimate = *result.estimate;
  message.pose = toMsg(estimate.best.T_camera_window, estimate.best.covariance);
  message.reprojection_rms_px = estimate.best.reprojection_rms_px;
  message.has_alternative = estimate.alternative.has_value();
  if (estimate.alternative) {
    message.alternative = toMsg(estimate.alternative->T_camera_window, estimate.alternative->covariance);
    message.alternative_reprojection_rms_px = estimate.alternative->reprojection_rms_px;
  }
  message.log_likelihood_ratio = estimate.log_likelihood_ratio;
  message.relative_yaw = relativeYawMsg(estimate);
  message.euler = toMsg(estimate.euler);
  message.apparent = apparentMsg(estimate);
  return message;
}

window_ingress::FilteredPose toMsg(const estimation::FilteredWindow& filtered) {
  window_ingress::FilteredPose message;
  message.header.stamp = toStamp(filtered.stamp_sec);
  message.valid = true;
  message.pose = toMsg(filtered.T_odom_window, filtered.covariance);
  message.age = filtered.age_sec;
  message.sign_trusted = filtered.sign_trusted;
  message.weight = filtered.hypothesis_weight;
  message.has_alternative = filtered.alternative.has_value();
  if (filtered.alternative)
    message.alternative = toMsg(filtered.alternative->T_odom_window, filtered.alternative->covariance);
  message.updates = static_cast<std::uint32_t>(std::max(0, filtered.updates));
  message.motion = toMsg(filtered.motion);
  return message;
}

window_ingress::WindowSize toMsg(const geometry::OpeningSize& size) {
  window_ingress::WindowSize message;
  message.width = size.width_m;
  message.height = size.height_m;
  return message;
}

window_ingress::WindowSize toMsg(const estimation::SizeEstimate& estimate) {
  window_ingress::WindowSize message = toMsg(estimate.size);
  message.width_sigma = estimate.size.width_m * std::sqrt(estimate.log_covariance(0, 0));
  message.height_sigma = estimate.size.height_m * std::sqrt(estimate.log_covariance(1, 1));
  return message;
}

window_ingress::SystemChecks toMsg(const VerifiedTarget& verified) {
  window_ingress::SystemChecks message;
  message.fit = static_cast<std::uint8_t>(verified.fit.fit);
  message.fit_reason = verified.fit.reason;
  message.frames = static_cast<std::uint8_t>(verified.frames.state);
  message.frames_reason = verified.frames.what;
  message.nis = verified.consistency.mean_nis;
  message.nis_images = static_cast<std::uint32_t>(std::max(0, verified.consistency.images));
  message.consistent = verified.consistency.consistent;
  message.is_other_window = verified.other_window.has_value();
  message.other_window_factor = verified.other_window.value_or(0.0);
  message.approach_forbidden = verified.approach_forbidden;
  message.unverified = verified.unverified;
  return message;
}

window_ingress::Openness toMsg(const openness::OpennessVerdict& verdict) {
  window_ingress::Openness message;
  message.verdict = static_cast<std::uint8_t>(verdict.openness);
  message.reason = verdict.reason;
  message.log_odds = verdict.log_odds;
  message.open_share = verdict.open_share;
  message.has_depth_behind = verdict.has_depth;
  message.depth_behind = verdict.has_depth ? verdict.depth_behind_m : 0.0;
  message.depth_behind_sigma = verdict.has_depth ? verdict.depth_sigma_m : 0.0;
  return message;
}

openness::OpennessVerdict fromMsg(const window_ingress::Openness& message) {
  openness::OpennessVerdict verdict;
  if (message.verdict > OpennessMsg::CLOSED || !std::isfinite(message.log_odds) ||
      !std::isfinite(message.depth_behind) || !std::isfinite(message.depth_behind_sigma) ||
      !std::isfinite(message.open_share))
    return verdict;
  verdict.openness = static_cast<openness::Openness>(message.verdict);
  verdict.log_odds = message.log_odds;
  verdict.has_depth = message.has_depth_behind != 0;
  verdict.depth_behind_m = message.depth_behind;
  verdict.depth_sigma_m = message.depth_behind_sigma;
  verdict.open_share = message.open_share;
  verdict.reason = message.reason;
  return verdict;
}

window_ingress::CameraInBody toMsg(const navigation::CameraInBody& camera) {
  window_ingress::CameraInBody message;
  message.known = true;
  message.forward = camera.forward_m;
  message.horizontal_fov = camera.horizontal_fov_rad;
  message.vertical_fov = camera.vertical_fov_rad;
  message.pixel_angle = camera.pixel_rad;
  return message;
}

std::optional<navigation::CameraInBody> cameraFromMsg(const window_ingress::CameraInBody& message) {
  if (!message.known || !message.fault.empty()) return std::nullopt;
  return navigation::CameraInBody{message.forward, message.horizontal_fov, message.vertical_fov,
                                  message.pixel_angle};
}

Converted<navigation::TargetEstimate> targetFromMsg(const window_ingress::WindowPose& message,
                                                    const std::string& odom_frame) {
  const window_ingress::FilteredPose& filtered = message.filtered;
  const window_ingress::SystemChecks& checks = message.checks;
  if (!filtered.valid) return {std::nullopt, "no filtered window: " + filtered.reason};
  if (filtered.header.frame_id != odom_frame)
    return {std::nullopt, "filtered.header.frame_id is '" + filtered.header.frame_id.substr(0, 60) +
                              "', expected '" + odom_frame + "'"};
  const auto stamp_sec = stampSec(filtered.header.stamp);
  if (!stamp_sec) return {std::nullopt, "filtered.header.stamp is zero or not normalised"};
  const auto pose = fromMsg(filtered.pose.pose);
  if (!pose) return {std::nullopt, pose.reason};
  const estimation::Matrix6d covariance = Eigen::Map<const RowMajor6d>(filtered.pose.covariance.data());
  if (!covariance.allFinite()) return {std::nullopt, "covariance is not finite"};
  const geometry::OpeningSize opening{message.size.width, message.size.height};
  if (!(opening.width_m > 0.0 && opening.height_m > 0.0) || !std::isfinite(opening.width_m) ||
      !std::isfinite(opening.height_m))
    return {std::nullopt, "size of the window is not positive"};
  navigation::TargetEstimate target;
  target.stamp_sec = *stamp_sec;
  target.T_odom_window = *pose.value;
  target.covariance = covariance;
  target.motion = fromMsg(filtered.motion);
  target.pose_stamp_sec = *stamp_sec + filtered.age;
  target.sign_trusted = filtered.sign_trusted != 0;
  target.opening = opening;
  target.approach_forbidden = checks.approach_forbidden;
  target.unverified = checks.unverified;
  target.openness = fromMsg(message.openness);
  if (checks.is_other_window) {
    if (!(checks.other_window_factor > 0.0) || !std::isfinite(checks.other_window_factor))
      return {std::nullopt, "other_window_factor is not positive"};
    target.other_window = checks.other_window_factor;
  }
  target.window_id = message.target.window_id;
  if (!checks.approach_forbidden.empty())
    target.fit = checks.fit == ChecksMsg::FIT_NO_GO ? estimation::Fit::kNoGo
                 : checks.fit == ChecksMsg::FIT_GO  ? estimation::Fit::kGo
                                                    : estimation::Fit::kUnknown;
  return {target, ""};
}

std::optional<Eigen::Vector3d> rememberedFrom(const window_ingress::WindowPose& message,
                                              const std::string& odom_frame) {
  const Eigen::Vector3d place = toEigen(message.target.position);
  if (message.target.window_id == 0 || message.filtered.header.frame_id != odom_frame || !place.allFinite())
    return std::nullopt;
  return place;
}

StateMsg toMsg(const navigation::NavigatorOutput& output) {
  StateMsg message;
  message.state = static_cast<std::uint8_t>(output.state);
  message.state_name = navigation::toString(output.state);
  message.reason = output.reason;
  message.enabled = output.enabled;
  message.velocity = toVectorMsg(output.setpoint.velocity_odom_mps);
  message.yaw_rate = output.setpoint.yaw_rate_radps;
  const navigation::NavigatorReport& report = output.report;
  message.target_valid = report.has_relative;
  message.distance = report.distance_m;
  message.lateral = report.lateral_m;
  message.vertical = report.vertical_m;
  message.predicted_miss = report.predicted_miss_m;
  message.commit_distance = report.commit_distance_m;
  message.retries = static_cast<std::uint32_t>(std::max(0, report.retries));
  message.blind = report.blind_sec;
  message.window_id = report.window_id;
  message.given_up = report.given_up;
  message.next_window = report.next_window;
  message.response_measured = report.vehicle.is_measured;
  message.response = report.vehicle.response_sec;
  const double limit_mps2 = report.vehicle.acceleration_mps2;
  message.acceleration_limit = std::isfinite(limit_mps2) ? limit_mps2 : 0.0;
  message.velocity_bias = toVectorMsg(report.vehicle.velocity_bias_base_mps);
  return message;
}

}  // namespace window_ingress::adapters
