#include "adapters/pose/pose_node.hpp"

#include "adapters/conversions/stamps.hpp"
#include "adapters/inputs/attitude_source.hpp"
#include "adapters/runtime/diagnostics.hpp"
#include "adapters/runtime/parameter_server.hpp"

namespace window_ingress::adapters {
namespace {

constexpr double kPendingPeriodSec = 0.01;
constexpr double kOdometryGoneSec = 0.3;

PoseNodeParams checked(PoseNodeParams params) {
  if (params.lockstep && params.gravity_source == "tf")
    throw InputError("gravity_source is 'tf', must be imu or odom in lockstep");
  return params;
}

}  // namespace

PoseNode::PoseNode(ros::NodeHandle& nh, ros::NodeHandle& pnh)
    : params_(
          checked(configuration::forVehicle(readParameters<PoseNodeParams>(nh, pnh, vehicle_), vehicle_))),
      diagnostics_(nh, pnh),
      window_health_(diagnostics_, "window", kSilenceSec),
      odom_health_(diagnostics_, "odom", kSilenceSec),
      window_gate_(limitsFor(params_.lockstep, vehicle_.stamps)),
      odom_gate_(limitsFor(params_.lockstep, vehicle_.stamps)),
      camera_(nh, diagnostics_, vehicle_.image_is_rectified),
      estimator_(params_.pose, params_.filter, params_.tracker),
      T_base_camera_{std::nullopt, "no image so far"},
      tf_listener_(tf_),
      selection_(nh, pnh, diagnostics_, estimator_, tf_, vehicle_.frames.odom),
      publisher_(nh, params_.lockstep, vehicle_.frames.odom,
                 params_.publish_tf ? params_.window_frame : std::string()) {
  const int queue = queueFor(params_.lockstep, 10);
  window_subscriber_ = subscribeCatching<window_ingress::WindowDetection>(
      nh, "window", 1, diagnostics_, [this](const auto& message) { receiveWindow(message); });
  odom_subscriber_ = subscribeCatching<nav_msgs::Odometry>(
      nh, "odom", queue, diagnostics_, [this](const auto& message) { receiveOdometry(message); });
  reset_ = pnh.advertiseService("reset", &PoseNode::reset, this);
  window_health_.watch(window_subscriber_);
  odom_health_.watch(odom_subscriber_);
  if (params_.gravity_source == "imu") {
    imu_health_.emplace(diagnostics_, "imu", kSilenceSec);
    imu_subscriber_ = subscribeCatching<sensor_msgs::Imu>(
        nh, "imu", queue, diagnostics_, [this](const auto& message) { receiveImu(message); });
    imu_health_->watch(imu_subscriber_);
  }
  if (params_.gravity_source == "tf") {
    tf_attitude_.emplace(tf_, vehicle_.frames.odom, vehicle_.frames.base);
    diagnostics_.add("attitude", [this] { return tf_attitude_->health(); });
  }
  if (!params_.publish_tf) diagnostics_.addOutput("window_pose", publisher_.topics());
  diagnostics_.add("camera mounting", [this] { return mountingHealth(); });
  diagnostics_.add("frames check", [this] { return framesHealth(estimator_.frames()); });
  diagnostics_.add("clocks", [this] { return clocksHealth(estimator_.clockOffset(), odom_clock_); });
  diagnostics_.add("consistency", [this] { return consistencyHealth(consistency_); });
  diagnostics_.add("openness", [this] { return opennessHealth(estimator_.openness()); });
  diagnostics_.add("target", [this] { return targetHealth(unused_, sizeSaid()); });
  if (params_.lockstep) {
    lockstep_.emplace(
        nh, diagnostics_, [this](const auto& step) { return isComplete(step); },
        [this](const auto&) { processPending(true); });
    camera_.notify([this] { lockstep_->check(); });
  } else {
    timer_ = createCatchingTimer(nh, kPendingPeriodSec, "pending image", diagnostics_,
                                 [this] { processPending(false); });
  }
}

bool PoseNode::isComplete(const Lockstep::Step& step) const {
  const bool first = !step.has_image, with_imu = imu_health_.has_value();
  const bool connected = camera_.isConnected() && odom_subscriber_.getNumPublishers() > 0 &&
                         (!with_imu || imu_subscriber_.getNumPublishers() > 0);
  if (first && !(connected && mountingOf(tf_, vehicle_.frames.base, step.header.frame_id))) return false;
  return window_came_ >= step.image && odom_came_ >= step.odom && (!with_imu || imu_came_ >= step.imu) &&
         camera_.lastStamp() >= step.camera_info;
}

void PoseNode::receiveWindow(const window_ingress::WindowDetectionConstPtr& message) {
  restartIfClockJumpedBack();
  window_came_ = message->header.stamp;
  window_health_.arrived();
  const auto late = window_gate_.whyRefused(message->header.stamp, ros::Time::now().toSec());
  if (late) return window_health_.refused(*late);
  if (isFromBeforeReset(message->header)) return;
  window_health_.accepted();
  window_health_.stamped(message->header.stamp.toSec());
  if (!lockstep_) processPending(true);
  pending_ = message;
  pending_since_sec_ = steadyNowSec();
  lockstep_ ? lockstep_->check() : processPending(false);
}

void PoseNode::receiveOdometry(const nav_msgs::OdometryConstPtr& message) {
  takeOdometry(message);
  odom_came_ = message->header.stamp;
  lockstep_ ? lockstep_->check() : processPending(false);
}

void PoseNode::takeOdometry(const nav_msgs::OdometryConstPtr& message) {
  restartIfClockJumpedBack();
  odom_health_.arrived();
  const auto late = odom_gate_.whyRefused(message->header.stamp, ros::Time::now().toSec());
  if (late) return odom_health_.refused(*late);
  if (isFromBeforeReset(message->header)) return;
  auto vehicle = fromMsg(*message, vehicle_.frames);
  if (!vehicle) return odom_health_.refused(vehicle.reason);
  odom_health_.accepted();
  odom_health_.stamped(vehicle.value->stamp_sec);
  if (!lockstep_)
    vehicle.value->stamp_sec = odom_clock_.atReceiver(vehicle.value->stamp_sec, ros::Time::now().toSec());
  estimator_.addOdometry(vehicle.value->stamp_sec, vehicle.value->T_odom_base,
                         vehicle.value->velocity_odom_mps, vehicle.value->turn_odom_radps);
  odometry_stamp_sec_ = vehicle.value->stamp_sec;
}

void PoseNode::receiveImu(const sensor_msgs::ImuConstPtr& message) {
  takeImu(message);
  imu_came_ = message->header.stamp;
  if (lockstep_) lockstep_->check();
}

void PoseNode::takeImu(const sensor_msgs::ImuConstPtr& message) {
  imu_health_->arrived();
  const auto attitude = fromMsg(*message, vehicle_.frames.base);
  if (!attitude) return imu_health_->refused(attitude.reason);
  imu_health_->accepted();
  imu_health_->stamped(attitude.value->stamp_sec);
  estimator_.addAttitude(attitude.value->stamp_sec, attitude.value->R_odom_base);
}

// An image waits until odometry has reached its exposure, because poses are interpolated, not extrapolated.
void PoseNode::processPending(bool however_old) {
  if (!pending_) return;
  const bool caught_up = odometry_stamp_sec_ >= pending_->header.stamp.toSec();
  const bool waited = steadyNowSec() - pending_since_sec_ >= params_.odom_wait_sec;
  const bool hopeless = odom_health_.silentSec() > kOdometryGoneSec;
  if (!(caught_up || waited || hopeless || however_old)) return;
  const window_ingress::WindowDetectionConstPtr message = pending_;
  pending_.reset();
  process(*message);
}

void PoseNode::process(const window_ingress::WindowDetection& message) {
  window_ingress::WindowPose out;
  out.header = message.header;
  out.size = toMsg(sizeSaid());
  Refusal unused = estimate(message, out);
  out.openness = toMsg(estimator_.openness());
  if (const auto& measured = estimator_.measuredSize()) out.measured_size = toMsg(*measured);
  VerifiedTarget verified;
  verified.frames = estimator_.frames();
  const auto state = estimator_.filtered(message.header.stamp.toSec());
  if (state) {
    out.filtered = toMsg(*state);
    out.size = toMsg(state->size);
    verified = {verified.frames,
                estimator_.fit(*state),
                state->consistency,
                estimator_.otherWindow(),
                estimator_.approachForbidden(*state),
                estimator_.unverified()};
  } else if (unused.reason.empty()) {
    unused = {window_ingress::FilteredPose::REFUSED, "no image was used recently"};
  }
  if (state)
    unused_ = UnusedImages();
  else if (message.detected)
    unused_.add(unused.reason, out.image.apparent);
  out.filtered.header.frame_id = vehicle_.frames.odom;
  out.filtered.reject = unused.reject;
  out.filtered.reason = unused.reason;
  out.checks = toMsg(verified);
  consistency_ = verified.consistency;
  publisher_.publish(out, state);
  selection_.publish(message.header.stamp, publisher_.markers());
}

// Fills in what this image shows. Returns why the image did not contribute to the filter; empty if it did.
PoseNode::Refusal PoseNode::estimate(const window_ingress::WindowDetection& message,
                                     window_ingress::WindowPose& out) {
  using Filtered = window_ingress::FilteredPose;
  using Image = window_ingress::ImagePose;
  T_base_camera_ = mountingOf(tf_, vehicle_.frames.base, message.header.frame_id);
  auto window = fromMsg(message);
  if (window && message.image_width == 0) window = {std::nullopt, "image_width is zero"};
  if (!window) {
    out.image.reject = Image::NO_WINDOW;
    out.image.reason = window.reason;
  }
  if (message.image_width == 0) return {Filtered::NO_WINDOW, window.reason};  // no image
  const auto camera = camera_.cameraOf(static_cast<int>(message.image_width),
                                       static_cast<int>(message.image_height), message.header);
  const auto stamp_sec = stampSec(message.header.stamp);
  if (camera && T_base_camera_)
    out.camera = toMsg(navigation::cameraInBody(*camera.value, *T_base_camera_.value));
  else
    out.camera.fault = camera ? T_base_camera_.reason : "no calibration: " + camera.reason;
  if (out.camera.fault.empty()) out.camera.fault = navigation::whyNotMounted(*T_base_camera_.value, vehicle_);
  if (out.camera.fault.empty() && !lockstep_ && odom_health_.silentSec() > kOdometryGoneSec)
    out.camera.fault = "the pose node has no odometry: " + odom_health_.health().text;
  if (!camera && window) {
    out.image.reject = Image::NO_CALIBRATION;
    out.image.reason = camera.reason;
    return {Filtered::NO_CALIBRATION, camera.reason};
  }
  if (!camera || !stamp_sec) return {Filtered::NO_WINDOW, window.reason};
  if (tf_attitude_)
    if (const auto R_odom_base = tf_attitude_->at(*stamp_sec))
      estimator_.addAttitude(*stamp_sec, *R_odom_base);
  estimator_.addDetection(
      {*stamp_sec, *camera.value, T_base_camera_.value, window.value, seenWindowsFrom(message)});
  estimator_.flush();
  out.target = targetMsg(
      estimator_.facade().target(),
      T_base_camera_ ? estimator_.expected(*stamp_sec, *camera.value, *T_base_camera_.value) : std::nullopt);
  if (!window) return {Filtered::NO_WINDOW, window.reason};
  const estimation::TargetUpdate& update = estimator_.lastUpdate();
  out.image = toMsg(update.pose);
  if (update.pose.estimate) out.size = toMsg(update.pose.estimate->opening);
  if (!T_base_camera_) return {Filtered::NO_MOUNTING, T_base_camera_.reason};
  return {update.why_not.empty() ? Filtered::OK : Filtered::REFUSED, update.why_not};
}

void PoseNode::restartIfClockJumpedBack() {
  if (!clock_.jumpedBack(ros::Time::now().toSec())) return;
  ROS_WARN("the clock jumped back: odometry, transforms and filter forgotten");
  forgotten_ = ros::Time();
  forget();
  tf_.clear();
}

void PoseNode::forget() {
  odometry_stamp_sec_ = -1.0;
  odom_clock_.clear();
  pending_.reset();
  estimator_.reset();
  consistency_ = estimation::Consistency();
  unused_ = UnusedImages();
  publisher_.clear(ros::Time::now());
  selection_.tellAnew(ros::Time::now());
}

bool PoseNode::reset(Trigger::Request&, Trigger::Response& response) {
  forgotten_ = ros::Time::now();
  forget();
  response.success = true;
  response.message = "the track and the memory of all windows are forgotten";
  ROS_INFO("reset: %s", response.message.c_str());
  return true;
}

Health PoseNode::mountingHealth() const {
  if (T_base_camera_) return {};
  const bool no_image_yet = window_health_.silentSec() > kSilenceSec;
  return {no_image_yet ? Health::kOk : Health::kError, T_base_camera_.reason};
}

}  // namespace window_ingress::adapters
