#include "adapters/navigator/navigator_node.hpp"

#include <cmath>

#include "adapters/markers/marker_sketch.hpp"
#include "adapters/runtime/parameter_server.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::adapters {
namespace {

// Names the axes, not the frame: frame_id is filled from odom_frame and base_frame.
constexpr const char* kBaseAxes = "base_link";
constexpr double kStatePeriodEnabledSec = 0.1, kStatePeriodIdleSec = 1.0;
constexpr double kMarkerPeriodSec = 0.095;
constexpr double kFrozenClockSec = 0.2;
constexpr double kRounding = 1e-6;
constexpr std::size_t kMaxReason = 400;  // characters of texts from other nodes

// The navigator's own limits, checked once more on each sent setpoint.
GuardParams lastGate(const navigation::LimitParams& limits) {
  GuardParams gate;
  gate.max_speed_mps = limits.speed_mps + kRounding;
  gate.max_yaw_rate_radps = limits.yaw_rate_radps + kRounding;
  return gate;
}

NavigatorNodeParams readChecked(ros::NodeHandle& nh, ros::NodeHandle& pnh) {
  navigation::VehicleParams vehicle;
  auto params = readParameters<NavigatorNodeParams>(nh, pnh, vehicle);
  params.navigator.vehicle = vehicle;
  if (params.start_at_once && !params.lockstep)
    throw InputError("start_at_once works in lockstep only; call ~start instead");
  return params;
}

}  // namespace

NavigatorNode::NavigatorNode(ros::NodeHandle& nh, ros::NodeHandle& pnh)
    : params_(readChecked(nh, pnh)),
      diagnostics_(nh, pnh),
      odom_(diagnostics_, "odom", limitsFor(params_.lockstep, params_.navigator.vehicle.stamps)),
      pose_(diagnostics_, "window_pose", limitsFor(params_.lockstep, params_.navigator.vehicle.stamps)),
      engagement_(params_.engagement),
      upstream_(nh, diagnostics_),
      guard_(nh, diagnostics_, params_.guard),
      navigator_(params_.navigator),
      last_gate_(lastGate(params_.navigator.limits)) {
  setpoint_publisher_ = nh.advertise<geometry_msgs::TwistStamped>("cmd_vel", 1);
  state_publisher_ = nh.advertise<window_ingress::IngressState>("state", 1, true);
  marker_publisher_ = nh.advertise<visualization_msgs::MarkerArray>("markers", 1);
  const int queue = queueFor(params_.lockstep, 1);
  odom_.subscribe(nh, queue, &NavigatorNode::receiveOdometry, this);
  pose_.subscribe(nh, queue, &NavigatorNode::receivePose, this);
  engaged_subscriber_ = diagnostics_.subscribe(nh, "engaged", 1, &NavigatorNode::receiveEngaged, this);
  reportHealth();
  advertiseServices(pnh);
  if (params_.lockstep) {
    lockstep_.emplace(
        nh, diagnostics_, [this](const auto& step) { return isComplete(step); },
        [this](const auto& step) { stepInStep(step); });
  } else {
    timer_ = diagnostics_.createTimer(nh, 1.0 / params_.rate_hz, "step", [this] { step(); });
    action_.emplace(nh, diagnostics_,
                    MissionAction::Mission{[this] { return whyFlying(); },
                                           [this](const auto& policy) { return startMission(policy); },
                                           [this] { return abortMission("the goal was cancelled"); }});
    master_.emplace();
  }
}

bool NavigatorNode::isComplete(const Lockstep::Step& step) const {
  const bool connected = odom_.isConnected() && setpoint_publisher_.getNumSubscribers() > 0;
  if (!step.has_image && !connected) return false;
  return odom_.lastStamp() >= step.odom && pose_.lastStamp() >= step.image;
}

void NavigatorNode::stepInStep(const Lockstep::Step& step) {
  step_sec_ = step.header.stamp.toSec();
  restartIfClockJumpedBack(step_sec_);
  if (params_.start_at_once && last_.state == navigation::State::kIdle)
    ROS_INFO("start at once: %s", navigator_.start(input_, step_sec_).message.c_str());
  last_ = navigator_.step(input_, step_sec_);
  publish(last_, step.header.stamp);
}

void NavigatorNode::receiveOdometry(const nav_msgs::OdometryConstPtr& message) {
  if (!odom_.admits(message->header.stamp)) return;
  auto vehicle = fromMsg(*message, frames());
  if (!vehicle) return odom_.refused(vehicle.reason);
  odom_.accepted();
  odom_.stamped(vehicle.value->stamp_sec);
  if (!lockstep_)
    vehicle.value->stamp_sec = odom_clock_.atReceiver(vehicle.value->stamp_sec, ros::Time::now().toSec());
  input_.vehicle = vehicle.value;
}

void NavigatorNode::receivePose(const window_ingress::WindowPoseConstPtr& message) {
  if (!pose_.admits(message->header.stamp)) return;
  input_.image_stamp_sec = stampSec(message->header.stamp);
  pose_.stamped(*input_.image_stamp_sec);
  input_.remembered_odom_m = rememberedFrom(*message, frames().odom);
  takeCamera(message->camera);
  if (action_) action_->hear(message->size);
  if (!message->filtered.valid) return pose_.accepted();  // an image without a window also counts
  const auto target = targetFromMsg(*message, frames().odom);
  if (!target) return pose_.refused(target.reason);
  pose_.accepted();
  input_.target = target.value;
}

// Lockstep uses the vehicle's parameters, which the world knows as well: flights repeat to the bit.
void NavigatorNode::takeCamera(const window_ingress::CameraInBody& message) {
  input_.camera_fault = message.fault.substr(0, kMaxReason);
  if (lockstep_) return;
  input_.camera = cameraFromMsg(message);
  if (!input_.camera || !navigation::faultOf(*input_.camera).empty()) return;
  params_.navigator.vehicle.camera = *input_.camera;  // for the markers
}

void NavigatorNode::receiveEngaged(const std_msgs::BoolConstPtr& message) {
  engagement_.hear(message->data, steadyNowSec());
}

void NavigatorNode::step() {
  const ros::Time now = ros::Time::now();
  restartIfClockJumpedBack(now.toSec());
  forgetSilentInputs();
  abortIfForgotten();
  abortIfItSlept();
  const bool works = diagnostics_.catchAll("navigator", [&] { last_ = decide(now.toSec()); });
  if (isLeftToOthers()) {
    last_.enabled = was_enabled_ = false;
    last_.reason = "disabled (~enable)";
  }
  if (!works) {
    last_.setpoint = navigation::Setpoint();
    navigator_.sentZero();
  }
  if (diagnostics_.failuresInARow("navigator") == FailureCount::kMany)
    navigator_.abort("aborted: the navigator's steps fail; see 'callbacks' in /diagnostics");
  publish(last_, now);
  if (last_.enabled) guard_.brakeIfNobodyDoes(now, frames().odom);
}

navigation::NavigatorOutput NavigatorNode::decide(double now_sec) {
  if (!clockStandsStill(now_sec)) return navigator_.step(input_, now_sec);
  navigator_.sentZero();
  navigation::NavigatorOutput output = last_;
  output.setpoint = navigation::Setpoint();
  output.reason = now_sec == 0.0 ? "waiting for /clock" : "/clock stands still";
  return output;
}

void NavigatorNode::restartIfClockJumpedBack(double now_sec) {
  if (!clock_.jumpedBack(now_sec)) return;
  ROS_WARN("the clock jumped back: inputs forgotten%s", last_.enabled ? ", mission aborted" : "");
  input_ = {};
  odom_clock_.clear();
  trail_.clear();
  marker_publisher_.publish(allGone(toStamp(now_sec), frames().odom));
  if (last_.enabled) navigator_.abort("aborted: the clock jumped back");
}

void NavigatorNode::publish(const navigation::NavigatorOutput& output, const ros::Time& now) {
  const bool stands_by = output.state == navigation::State::kIdle && !lockstep_ && !is_disabled_;
  if (output.enabled || was_enabled_ || stands_by)
    publishSetpoint(output.enabled ? output.setpoint : navigation::Setpoint(), now);
  was_enabled_ = output.enabled;
  publishState(output, now);
  publishMarkers(output, now);
}

// The path is recorded all the time, so that a late subscriber sees it as well.
void NavigatorNode::publishMarkers(const navigation::NavigatorOutput& output, const ros::Time& now) {
  if (!input_.vehicle) return;
  trail_.add(input_.vehicle->T_odom_base.translation(), output.state);
  const double since_sec = now.toSec() - drawn_sec_;
  if (marker_publisher_.getNumSubscribers() == 0 || (since_sec >= 0.0 && since_sec < kMarkerPeriodSec))
    return;
  drawn_sec_ = now.toSec();
  marker_publisher_.publish(flightMarkers(output, input_, trail_, params_.navigator, now, frames().odom));
}

void NavigatorNode::publishSetpoint(const navigation::Setpoint& setpoint, const ros::Time& now) {
  std::optional<Eigen::Matrix3d> R_odom_base;
  if (params_.setpoint_frame == kBaseAxes)
    R_odom_base = input_.vehicle ? Eigen::Matrix3d(geometry::yawRotation(-setpoint.heading_error_rad) *
                                                   input_.vehicle->T_odom_base.linear())
                                 : Eigen::Matrix3d::Identity();
  const bool directionless = R_odom_base && !input_.vehicle;  // unknown attitude: stand still
  geometry_msgs::TwistStamped message =
      toTwistMsg(directionless ? navigation::Setpoint() : setpoint, frames(), R_odom_base);
  message.header.stamp = now;
  const double now_sec = steadyNowSec();
  last_gate_.receive(message.twist, now_sec);
  message.twist = last_gate_.output(now_sec).value_or(geometry_msgs::Twist());
  setpoint_publisher_.publish(message);
  guard_.sent();
}

void NavigatorNode::publishState(const navigation::NavigatorOutput& output, const ros::Time& now) {
  window_ingress::IngressState message = toMsg(output);
  if (action_) action_->hear(message);
  const bool news =
      message.state != said_.state || message.reason != said_.reason || message.enabled != said_.enabled;
  const double period_sec = output.enabled ? kStatePeriodEnabledSec : kStatePeriodIdleSec;
  if (!lockstep_ && !news && steadyNowSec() - said_sec_ < period_sec) return;
  if (message.state != said_.state) {
    ROS_INFO("%s: %s", message.state_name.c_str(), message.reason.c_str());
    if (navigation::isEnd(output.state)) ROS_INFO("the vehicle %s", vehicleHealth().text.c_str());
  }
  message.header = headerOf(now, frames().odom);
  state_publisher_.publish(message);
  if (action_) action_->feedBack(message);
  said_ = message;
  said_sec_ = steadyNowSec();
}

void NavigatorNode::stop() {
  timer_.stop();
  const bool is_left_to_others = isLeftToOthers();
  navigator_.abort("aborted: the navigator's node ends");
  if (action_) action_->stop();
  if (is_left_to_others) return;
  for (int i = 0; i < 5; ++i) {
    publishSetpoint(navigation::Setpoint(), ros::Time::now());
    ros::WallDuration(0.05).sleep();
  }
}

void NavigatorNode::reportHealth() {
  diagnostics_.add("engaged", [this] { return engagementHealth(); });
  diagnostics_.addOutput("cmd_vel", {setpoint_publisher_});
  diagnostics_.add("mission", [this] { return missionHealth(); });
  diagnostics_.add("vehicle", [this] { return vehicleHealth(); });
  diagnostics_.add("camera", [this] { return cameraHealth(); });
  diagnostics_.add("master", [this] { return masterHealth(); });
  diagnostics_.add("last_gate", [this] {
    const std::string& fault = last_gate_.fault();
    return fault.empty() ? Health{}
                         : Health{Health::kError, "an invalid setpoint is replaced by zero: " + fault};
  });
}

// Drops odometry that no longer arrives, whatever its stamps: the ROS clock may stand still.
void NavigatorNode::forgetSilentInputs() {
  if (odom_.silentSec() > params_.max_silence_sec) input_.vehicle.reset();
  input_.engaged = engagement_.holds(steadyNowSec());
  input_.passed_on = guard_.passesOn();
}

bool NavigatorNode::clockStandsStill(double now_sec) {
  const double steady_sec = steadyNowSec();
  if (now_sec != last_now_sec_) clock_moved_sec_ = steady_sec;
  last_now_sec_ = now_sec;
  return now_sec == 0.0 || steady_sec - clock_moved_sec_ > kFrozenClockSec;
}

Health NavigatorNode::engagementHealth() const {
  return engagement_.health(engaged_subscriber_.getTopic(), steadyNowSec(),
                            static_cast<int>(engaged_subscriber_.getNumPublishers()));
}

Health NavigatorNode::missionHealth() const {
  const std::string text = std::string(navigation::toString(last_.state)) + ": " + last_.reason;
  const bool bad = last_.state == navigation::State::kAborted || last_.state == navigation::State::kHold ||
                   last_.report.vehicle.ignores_setpoints;
  return {bad ? Health::kWarn : Health::kOk, text};
}

Health NavigatorNode::vehicleHealth() const {
  const navigation::MeasuredVehicle& vehicle = last_.report.vehicle;
  std::string said = formatted("response time %.2f s, %s", vehicle.response_sec,
                               vehicle.is_measured ? "measured in flight" : "assumed");
  if (std::isfinite(vehicle.acceleration_mps2))
    said += formatted("; acceleration up to %.1f m/s^2", vehicle.acceleration_mps2);
  if (const double bias_mps = vehicle.velocity_bias_base_mps.norm(); bias_mps > 0.0)
    said += formatted("; velocity bias of odometry %.2f m/s, subtracted", bias_mps);
  return {Health::kOk, said};
}

Health NavigatorNode::cameraHealth() const {
  if (!input_.camera_fault.empty()) return {Health::kWarn, input_.camera_fault};
  const navigation::CameraInBody& camera = params_.navigator.vehicle.camera;
  return {Health::kOk,
          formatted("%.2f m ahead, field of view %.2f x %.2f rad, %.2g rad per pixel, from %s",
                    camera.forward_m, camera.horizontal_fov_rad, camera.vertical_fov_rad, camera.pixel_rad,
                    input_.camera ? "camera_info and tf" : "the parameters vehicle/...")};
}

std::unique_ptr<Node> makeIngressNavigator(ros::NodeHandle& nh, ros::NodeHandle& pnh) {
  return std::make_unique<NavigatorNode>(nh, pnh);
}

}  // namespace window_ingress::adapters
