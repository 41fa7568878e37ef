#include <algorithm>
#include <cmath>

#include "adapters/conversions/msg_conversion.hpp"
#include "adapters/conversions/stamps.hpp"

namespace window_ingress::adapters {
namespace {

using PoseMsg = window_ingress::WindowPose;
using StateMsg = window_ingress::IngressState;

// Constants of the messages are the enums of the core.
template <typename Enum>
constexpr bool same(int constant, Enum value) {
  return constant == static_cast<int>(value);
}
static_assert(same(PoseMsg::OK, estimation::PoseReject::kNone) &&
              same(PoseMsg::BAD_CAMERA, estimation::PoseReject::kBadCamera) &&
              same(PoseMsg::BAD_CORNERS, estimation::PoseReject::kBadCorners) &&
              same(PoseMsg::NOT_IN_FRONT, estimation::PoseReject::kNotInFront) &&
              same(PoseMsg::REPROJECTION, estimation::PoseReject::kReprojection) &&
              same(PoseMsg::RANGE, estimation::PoseReject::kRange) &&
              same(PoseMsg::TILT, estimation::PoseReject::kTilt) &&
              same(PoseMsg::NOT_FINITE, estimation::PoseReject::kNotFinite));
static_assert(same(PoseMsg::FIT_UNKNOWN, estimation::Fit::kUnknown) &&
              same(PoseMsg::FIT_GO, estimation::Fit::kGo) &&
              same(PoseMsg::FIT_NO_GO, estimation::Fit::kNoGo));
static_assert(same(PoseMsg::FRAMES_OPEN, estimation::FramesVerdict::kOpen) &&
              same(PoseMsg::FRAMES_GOOD, estimation::FramesVerdict::kGood) &&
              same(PoseMsg::FRAMES_WRONG, estimation::FramesVerdict::kWrong));
static_assert(same(PoseMsg::OPENNESS_UNKNOWN, openness::Openness::kUnknown) &&
              same(PoseMsg::OPENNESS_OPEN, openness::Openness::kOpen) &&
              same(PoseMsg::OPENNESS_CLOSED, openness::Openness::kClosed));
static_assert(same(StateMsg::IDLE, navigation::State::kIdle) &&
              same(StateMsg::SEARCH, navigation::State::kSearch) &&
              same(StateMsg::ALIGN, navigation::State::kAlign) &&
              same(StateMsg::APPROACH, navigation::State::kApproach) &&
              same(StateMsg::COMMIT, navigation::State::kCommit) &&
              same(StateMsg::PASSED, navigation::State::kPassed) &&
              same(StateMsg::BACK_OFF, navigation::State::kBackOff) &&
              same(StateMsg::HOLD, navigation::State::kHold) &&
              same(StateMsg::ABORTED, navigation::State::kAborted));

bool isFinite(const geometry_msgs::PoseWithCovariance& m) {
  return std::all_of(m.covariance.begin(), m.covariance.end(),
                     [](double number) { return std::isfinite(number); });
}

// Standard deviations of width and height [m].
Eigen::Vector2d sigmasOf(const estimation::SizeEstimate& belief) {
  return {belief.size.width_m * std::sqrt(belief.log_covariance(0, 0)),
          belief.size.height_m * std::sqrt(belief.log_covariance(1, 1))};
}

estimation::Matrix6d covarianceFromMsg(const geometry_msgs::PoseWithCovariance& message) {
  return Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(message.covariance.data());
}

// Its numbers are judged by the navigator, with all others.
estimation::TargetMotion motionFromMsg(const PoseMsg& message) {
  const auto& velocity = message.filtered_velocity;
  return {{message.target_speed, message.target_speed_time},
          {velocity.x, velocity.y, velocity.z},
          message.filtered_velocity_sigma};
}

}  // namespace

void fill(PoseMsg& message, const estimation::PoseResult& result) {
  message.reject = static_cast<std::uint8_t>(result.reject);
  if (!result.estimate) {
    message.reject_reason = result.detail.empty() ? estimation::toString(result.reject) : result.detail;
    return;
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
  message.yaw = estimate.yaw_rad;
  message.yaw_sigma = estimate.yaw_sigma_rad;
  message.sigma_u = estimate.sigma_u_rad;
  message.sign_trusted = estimate.sign_trusted;
  message.theta = estimate.euler.theta_rad;
  message.phi = estimate.euler.phi_rad;
  message.psi = estimate.euler.psi_rad;
  message.opening_width = estimate.opening_width_m;
  message.left_side = estimate.left_side_px;
  message.right_side = estimate.right_side_px;
  message.window_width = estimate.opening.width_m;
  message.window_height = estimate.opening.height_m;
  message.yaw_from_sight = estimate.yaw_from_sight_rad;
  message.opening_height = estimate.opening_height_m;
  if (!estimate.aspect) return;
  message.aspect = estimate.aspect->ratio;
  message.aspect_sigma = estimate.aspect->sigma;
}

void fill(PoseMsg& message, const estimation::FilteredWindow& filtered) {
  message.filtered_valid = true;
  message.filtered_stamp = toStamp(filtered.stamp_sec);
  message.filtered = toMsg(filtered.T_odom_window, filtered.covariance);
  message.filtered_sign_trusted = filtered.sign_trusted;
  message.filtered_weight = filtered.hypothesis_weight;
  message.filtered_updates = static_cast<std::uint32_t>(std::max(0, filtered.updates));
  message.filtered_age = filtered.age_sec;
  message.has_filtered_alternative = filtered.alternative.has_value();
  if (filtered.alternative)
    message.filtered_alternative =
        toMsg(filtered.alternative->T_odom_window, filtered.alternative->covariance);
  message.window_width = filtered.size.size.width_m;
  message.window_height = filtered.size.size.height_m;
  const Eigen::Vector2d sigma = sigmasOf(filtered.size);
  message.window_width_sigma = sigma.x();
  message.window_height_sigma = sigma.y();
  message.nis = filtered.consistency.mean_nis;
  message.nis_images = static_cast<std::uint32_t>(std::max(0, filtered.consistency.images));
  message.consistent = filtered.consistency.consistent;
  message.filtered_velocity = toVectorMsg(filtered.motion.velocity_odom_mps);
  message.filtered_velocity_sigma = filtered.motion.velocity_sigma_mps;
  message.target_speed = filtered.motion.model.speed_mps;
  message.target_speed_time = filtered.motion.model.stands() ? 0.0 : filtered.motion.model.time_sec;
}

void fill(PoseMsg& message, const estimation::SizeEstimate& measured) {
  const Eigen::Vector2d sigma = sigmasOf(measured);
  message.measured_width = measured.size.width_m;
  message.measured_width_sigma = sigma.x();
  message.measured_height = measured.size.height_m;
  message.measured_height_sigma = sigma.y();
}

void fill(PoseMsg& message, const estimation::FitVerdict& fit) {
  message.fit = static_cast<std::uint8_t>(fit.fit);
  message.fit_reason = fit.reason;
}

void fill(PoseMsg& message, const estimation::FramesVerdict& frames) {
  message.frames = static_cast<std::uint8_t>(frames.state);
  message.frames_reason = frames.what;
}

void fill(PoseMsg& message, const openness::OpennessVerdict& verdict) {
  message.openness = static_cast<std::uint8_t>(verdict.openness);
  message.openness_log_odds = verdict.log_odds;
  message.has_depth_behind = verdict.has_depth;
  message.depth_behind = verdict.has_depth ? verdict.depth_behind_m : 0.0;
  message.depth_behind_sigma = verdict.has_depth ? verdict.depth_sigma_m : 0.0;
  message.open_share = verdict.open_share;
  message.openness_reason = verdict.reason;
}

void fill(PoseMsg& message, const navigation::CameraInBody& camera) {
  message.camera.known = true;
  message.camera.forward = camera.forward_m;
  message.camera.horizontal_fov = camera.horizontal_fov_rad;
  message.camera.vertical_fov = camera.vertical_fov_rad;
  message.camera.pixel_angle = camera.pixel_rad;
}

std::optional<navigation::CameraInBody> cameraFromMsg(const window_ingress::CameraInBody& message) {
  if (!message.known || !message.fault.empty()) return std::nullopt;
  return navigation::CameraInBody{message.forward, message.horizontal_fov, message.vertical_fov,
                                  message.pixel_angle};
}

// What is not a verdict is none.
openness::OpennessVerdict opennessFromMsg(const PoseMsg& message) {
  openness::OpennessVerdict verdict;
  if (message.openness > PoseMsg::OPENNESS_CLOSED || !std::isfinite(message.openness_log_odds) ||
      !std::isfinite(message.depth_behind) || !std::isfinite(message.depth_behind_sigma) ||
      !std::isfinite(message.open_share))
    return verdict;
  verdict.openness = static_cast<openness::Openness>(message.openness);
  verdict.log_odds = message.openness_log_odds;
  verdict.has_depth = message.has_depth_behind != 0;
  verdict.depth_behind_m = message.depth_behind;
  verdict.depth_sigma_m = message.depth_behind_sigma;
  verdict.open_share = message.open_share;
  verdict.reason = message.openness_reason;
  return verdict;
}

Converted<navigation::TargetEstimate> targetFromMsg(const PoseMsg& message, const std::string& odom_frame) {
  if (!message.filtered_valid) return {std::nullopt, "no filtered window: " + message.filtered_reason};
  if (message.filtered_frame_id != odom_frame)
    return {std::nullopt, "filtered_frame_id is '" + message.filtered_frame_id.substr(0, 60) +
                              "', expected '" + odom_frame + "'"};
  const auto stamp_sec = stampSec(message.filtered_stamp);
  if (!stamp_sec) return {std::nullopt, "filtered_stamp is zero or not normalised"};
  const auto pose = fromMsg(message.filtered.pose);
  if (!pose) return {std::nullopt, pose.reason};
  if (!isFinite(message.filtered)) return {std::nullopt, "covariance is not finite"};
  if (!(message.window_width > 0.0 && message.window_height > 0.0) || !std::isfinite(message.window_width) ||
      !std::isfinite(message.window_height))
    return {std::nullopt, "size of the window is not positive"};
  navigation::TargetEstimate target;
  target.stamp_sec = *stamp_sec;
  target.T_odom_window = *pose.value;
  target.covariance = covarianceFromMsg(message.filtered);
  target.motion = motionFromMsg(message);
  target.pose_stamp_sec = *stamp_sec + message.filtered_age;
  target.sign_trusted = message.filtered_sign_trusted != 0;
  target.updates = static_cast<int>(std::min<std::uint32_t>(message.filtered_updates, 1u << 30));
  target.opening = {message.window_width, message.window_height};
  target.approach_forbidden = message.approach_forbidden;
  target.openness = opennessFromMsg(message);
  if (message.is_other_window) {
    if (!(message.other_window_factor > 0.0) || !std::isfinite(message.other_window_factor))
      return {std::nullopt, "other_window_factor is not positive"};
    target.other_window = message.other_window_factor;
  }
  target.window_id = message.window_id;
  if (!message.approach_forbidden.empty())
    target.fit = message.fit == PoseMsg::FIT_NO_GO ? estimation::Fit::kNoGo
                 : message.fit == PoseMsg::FIT_GO  ? estimation::Fit::kGo
                                                   : estimation::Fit::kUnknown;
  return {target, ""};
}

std::optional<Eigen::Vector3d> rememberedFrom(const PoseMsg& message, const std::string& odom_frame) {
  const Eigen::Vector3d place(message.remembered.x, message.remembered.y, message.remembered.z);
  if (message.window_id == 0 || message.filtered_frame_id != odom_frame || !place.allFinite())
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
