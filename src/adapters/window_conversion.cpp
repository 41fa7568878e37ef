#include <algorithm>
#include <cmath>

#include "adapters/msg_conversion.hpp"
#include "adapters/stamps.hpp"

namespace window_ingress::adapters {
namespace {

using DetectionMsg = window_ingress::WindowDetection;
using PoseMsg = window_ingress::WindowPose;
using StateMsg = window_ingress::IngressState;

// Constants of the messages are the enums of the core.
template <typename Enum>
constexpr bool same(int constant, Enum value) {
  return constant == static_cast<int>(value);
}
static_assert(same(DetectionMsg::TOP_LEFT, geometry::kTopLeft) &&
              same(DetectionMsg::TOP_RIGHT, geometry::kTopRight) &&
              same(DetectionMsg::BOTTOM_RIGHT, geometry::kBottomRight) &&
              same(DetectionMsg::BOTTOM_LEFT, geometry::kBottomLeft));
static_assert(same(DetectionMsg::TOP, geometry::kTop) && same(DetectionMsg::RIGHT, geometry::kRight) &&
              same(DetectionMsg::BOTTOM, geometry::kBottom) && same(DetectionMsg::LEFT, geometry::kLeft));
static_assert(same(PoseMsg::OK, pose::PoseReject::kNone) &&
              same(PoseMsg::BAD_CAMERA, pose::PoseReject::kBadCamera) &&
              same(PoseMsg::BAD_CORNERS, pose::PoseReject::kBadCorners) &&
              same(PoseMsg::NOT_IN_FRONT, pose::PoseReject::kNotInFront) &&
              same(PoseMsg::REPROJECTION, pose::PoseReject::kReprojection) &&
              same(PoseMsg::RANGE, pose::PoseReject::kRange) &&
              same(PoseMsg::TILT, pose::PoseReject::kTilt) &&
              same(PoseMsg::NOT_FINITE, pose::PoseReject::kNotFinite));
static_assert(same(PoseMsg::FIT_UNKNOWN, pose::Fit::kUnknown) && same(PoseMsg::FIT_GO, pose::Fit::kGo) &&
              same(PoseMsg::FIT_NO_GO, pose::Fit::kNoGo));
static_assert(same(PoseMsg::FRAMES_OPEN, pose::FramesVerdict::kOpen) &&
              same(PoseMsg::FRAMES_GOOD, pose::FramesVerdict::kGood) &&
              same(PoseMsg::FRAMES_WRONG, pose::FramesVerdict::kWrong));
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

// All numbers of a detection that must be finite.
bool isFinite(const DetectionMsg& m) {
  const auto finite = [](double number) { return std::isfinite(number); };
  const auto all = [&](const auto& numbers) { return std::all_of(numbers.begin(), numbers.end(), finite); };
  return all(m.corner_x) && all(m.corner_y) && all(m.corner_covariance) && all(m.edge_sigma_px) &&
         all(m.edge_sigma_rad) && all(m.edge_a_x) && all(m.edge_a_y) && all(m.edge_b_x) && all(m.edge_b_y) &&
         finite(m.score) && finite(m.bhattacharyya) && all(m.interior_key_corner_x) &&
         all(m.interior_key_corner_y) && all(m.interior_key_corner_covariance) &&
         finite(m.interior_sigma_px) && all(m.interior_key_x) && all(m.interior_key_y) && all(m.interior_x) &&
         all(m.interior_y);
}

bool isFinite(const geometry_msgs::PoseWithCovariance& m) {
  return std::all_of(m.covariance.begin(), m.covariance.end(),
                     [](double number) { return std::isfinite(number); });
}

// Standard deviations of width and height [m].
Eigen::Vector2d sigmasOf(const pose::SizeBelief& belief) {
  return {belief.size.width_m * std::sqrt(belief.log_covariance(0, 0)),
          belief.size.height_m * std::sqrt(belief.log_covariance(1, 1))};
}

pose::Matrix6d covarianceFromMsg(const geometry_msgs::PoseWithCovariance& message) {
  return Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(message.covariance.data());
}

void fillCorner(DetectionMsg& message, const detection::WindowObservation& window, int i) {
  message.corner_visible[i] = true;
  message.corner_x[i] = window.corners[i].x();
  message.corner_y[i] = window.corners[i].y();
  const Eigen::Matrix<double, 2, 2, Eigen::RowMajor> covariance = window.corner_covariance[i];
  std::copy(covariance.data(), covariance.data() + 4, message.corner_covariance.begin() + 4 * i);
}

void fillEdge(DetectionMsg& message, const detection::Edge& edge, int i) {
  message.edge_visible[i] = true;
  message.edge_sigma_px[i] = edge.sigma_px;
  message.edge_sigma_rad[i] = edge.sigma_rad;
  message.edge_a_x[i] = edge.a.x();
  message.edge_a_y[i] = edge.a.y();
  message.edge_b_x[i] = edge.b.x();
  message.edge_b_y[i] = edge.b.y();
}

// What the message does not call visible stays zero, whatever it says.
void readCorner(const DetectionMsg& message, int i, detection::WindowObservation& window) {
  window.corner_visible[i] = message.corner_visible[i] != 0;
  if (!window.corner_visible[i]) return;
  window.corners[i] = {message.corner_x[i], message.corner_y[i]};
  window.corner_covariance[i] = Eigen::Map<const Eigen::Matrix<double, 2, 2, Eigen::RowMajor>>(
      message.corner_covariance.data() + 4 * i);
}

detection::Edge readEdge(const DetectionMsg& message, int i) {
  if (message.edge_visible[i] == 0) return {};
  return {true,
          message.edge_sigma_px[i],
          message.edge_sigma_rad[i],
          {message.edge_a_x[i], message.edge_a_y[i]},
          {message.edge_b_x[i], message.edge_b_y[i]}};
}

void fillInterior(DetectionMsg& message, const detection::InteriorTracks& interior) {
  message.interior_key_stamp = toStamp(interior.key_stamp_sec);
  message.interior_sigma_px = interior.sigma_px;
  for (int i = 0; i < 4; ++i) {
    message.interior_key_corner_x[i] = interior.key_corners[i].x();
    message.interior_key_corner_y[i] = interior.key_corners[i].y();
    const Eigen::Matrix<double, 2, 2, Eigen::RowMajor> covariance = interior.key_covariance[i];
    std::copy(covariance.data(), covariance.data() + 4, message.interior_key_corner_covariance.begin() + 4 * i);
  }
  for (const detection::InteriorPoint& point : interior.points) {
    message.interior_id.push_back(point.id);
    message.interior_key_x.push_back(static_cast<float>(point.key_px.x()));
    message.interior_key_y.push_back(static_cast<float>(point.key_px.y()));
    message.interior_x.push_back(static_cast<float>(point.now_px.x()));
    message.interior_y.push_back(static_cast<float>(point.now_px.y()));
  }
}

// None if the lists are not of one length or there is no key picture.
detection::InteriorTracks readInterior(const DetectionMsg& m) {
  detection::InteriorTracks interior;
  const std::size_t points = m.interior_id.size();
  const auto key_stamp_sec = stampSec(m.interior_key_stamp);
  if (points == 0 || !key_stamp_sec || m.interior_key_x.size() != points || m.interior_key_y.size() != points ||
      m.interior_x.size() != points || m.interior_y.size() != points)
    return interior;
  interior.key_stamp_sec = *key_stamp_sec;
  interior.sigma_px = m.interior_sigma_px;
  for (int i = 0; i < 4; ++i) {
    interior.key_corners[i] = {m.interior_key_corner_x[i], m.interior_key_corner_y[i]};
    interior.key_covariance[i] = Eigen::Map<const Eigen::Matrix<double, 2, 2, Eigen::RowMajor>>(
        m.interior_key_corner_covariance.data() + 4 * i);
  }
  for (std::size_t i = 0; i < points; ++i)
    interior.points.push_back({m.interior_id[i],
                               {m.interior_key_x[i], m.interior_key_y[i]},
                               {m.interior_x[i], m.interior_y[i]}});
  return interior;
}

}  // namespace

DetectionMsg toMsg(const detection::WindowObservation& window) {
  DetectionMsg message;
  message.detected = true;
  message.target_id = window.target_id;
  for (int i = 0; i < 4; ++i) {
    if (window.corner_visible[i]) fillCorner(message, window, i);
    if (window.edges[i].visible) fillEdge(message, window.edges[i], i);
  }
  message.score = window.score;
  message.has_appearance = window.has_appearance;
  message.bhattacharyya = window.has_appearance ? window.bhattacharyya : 0.0;
  if (!window.interior.empty()) fillInterior(message, window.interior);
  return message;
}

Converted<detection::WindowObservation> fromMsg(const DetectionMsg& message) {
  const auto stamp_sec = stampSec(message.header.stamp);
  if (!stamp_sec) return {std::nullopt, "header.stamp is zero or not normalised"};
  if (!message.detected) return {std::nullopt, "no window: " + message.reject_reason};
  if (!isFinite(message)) return {std::nullopt, "a number of the detection is not finite"};
  detection::WindowObservation window;
  window.stamp_sec = *stamp_sec;
  for (int i = 0; i < 4; ++i) {
    readCorner(message, i, window);
    window.edges[i] = readEdge(message, i);
  }
  window.target_id = message.target_id;
  window.score = message.score;
  window.has_appearance = message.has_appearance != 0;
  window.bhattacharyya = message.bhattacharyya;
  window.interior = readInterior(message);
  return {window, ""};
}

void fill(PoseMsg& message, const pose::PoseResult& result) {
  message.reject = static_cast<std::uint8_t>(result.reject);
  if (!result.estimate) {
    message.reject_reason = result.detail.empty() ? pose::toString(result.reject) : result.detail;
    return;
  }
  const pose::WindowPoseEstimate& estimate = *result.estimate;
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

void fill(PoseMsg& message, const pose::FilteredWindow& filtered) {
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
}

void fill(PoseMsg& message, const pose::SizeBelief& measured) {
  const Eigen::Vector2d sigma = sigmasOf(measured);
  message.measured_width = measured.size.width_m;
  message.measured_width_sigma = sigma.x();
  message.measured_height = measured.size.height_m;
  message.measured_height_sigma = sigma.y();
}

void fill(PoseMsg& message, const pose::FitVerdict& fit) {
  message.fit = static_cast<std::uint8_t>(fit.fit);
  message.fit_reason = fit.reason;
}

void fill(PoseMsg& message, const pose::FramesVerdict& frames) {
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
  if (!message.approach_forbidden.empty())
    target.fit = message.fit == PoseMsg::FIT_NO_GO ? pose::Fit::kNoGo
                 : message.fit == PoseMsg::FIT_GO  ? pose::Fit::kGo
                                                   : pose::Fit::kUnknown;
  return {target, ""};
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
  return message;
}

}  // namespace window_ingress::adapters
