#include "adapters/world_node.hpp"

#include <rosgraph_msgs/Clock.h>
#include <window_ingress/ReferencePicture.h>

#include <algorithm>

#include "adapters/guarded.hpp"
#include "adapters/image_message.hpp"
#include "adapters/parameters.hpp"
#include "adapters/stamps.hpp"
#include "adapters/world_messages.hpp"

namespace window_ingress::adapters {
namespace {

constexpr double kTickSec = 0.005;
constexpr double kMostDebtSec = 0.05;  // what the machine cannot keep up with is given up, not caught up
constexpr double kJudgePeriodSec = 0.05, kVerdictPeriodSec = 1.0;

constexpr bool same(int constant, simulation::Outcome outcome) {
  return constant == static_cast<int>(outcome);
}
using VerdictMsg = window_ingress::FlightVerdict;
static_assert(same(VerdictMsg::RUNNING, simulation::Outcome::kRunning) &&
              same(VerdictMsg::PASSED, simulation::Outcome::kPassed) &&
              same(VerdictMsg::COLLISION, simulation::Outcome::kCollision) &&
              same(VerdictMsg::FALSE_INGRESS, simulation::Outcome::kFalseIngress) &&
              same(VerdictMsg::ABORTED, simulation::Outcome::kAborted) &&
              same(VerdictMsg::TIMEOUT, simulation::Outcome::kTimeout));

simulation::Scenario load(const WorldNodeParams& params) {
  if (params.scenario.empty()) return {};
  return simulation::loadScenario(params.scenario, static_cast<std::uint32_t>(params.seed));
}

}  // namespace

WorldNode::WorldNode(ros::NodeHandle& nh, ros::NodeHandle& pnh)
    : params_(readParameters<WorldNodeParams>(pnh)),
      diagnostics_(nh, pnh),
      command_health_(diagnostics_, "cmd_vel", 1e9),
      epoch_sec_(params_.start_time_sec),
      created_sec_(steadyNowSec()),
      ticked_sec_(created_sec_),
      camera_info_(nh, "world") {
  clock_publisher_ = nh.advertise<rosgraph_msgs::Clock>("/clock", 1);
  image_publisher_ = nh.advertise<sensor_msgs::Image>("image_raw", 1);
  info_publisher_ = nh.advertise<sensor_msgs::CameraInfo>("camera_info", 1);
  odom_publisher_ = nh.advertise<nav_msgs::Odometry>("odom", 10);
  imu_publisher_ = nh.advertise<sensor_msgs::Imu>("imu", 10);
  truth_odom_publisher_ = nh.advertise<nav_msgs::Odometry>("ground_truth/odom", 10);
  truth_window_publisher_ = nh.advertise<geometry_msgs::PoseStamped>("ground_truth/window", 1, true);
  truth_in_camera_publisher_ = nh.advertise<geometry_msgs::PoseStamped>("ground_truth/window_in_camera", 1);
  verdict_publisher_ = nh.advertise<window_ingress::FlightVerdict>("referee", 1, true);
  reference_publisher_ = nh.advertise<window_ingress::ReferencePicture>("reference", 1, true);
  command_subscriber_ = subscribeGuarded<geometry_msgs::TwistStamped>(
      nh, "cmd_vel", 1, diagnostics_, [this](const auto& message) { receiveCommand(message); });
  state_subscriber_ = subscribeGuarded<window_ingress::IngressState>(
      nh, "state", 10, diagnostics_, [this](const auto& message) { receiveState(message); });
  command_health_.watch(command_subscriber_);
  diagnostics_.add("speed", [this] { return speedHealth(); });
  reset_ = pnh.advertiseService("reset", &WorldNode::reset, this);
  restart();
  publishMounting();
  timer_ = createGuardedTimer(nh, kTickSec, "tick", diagnostics_, [this] { tick(); });
}

void WorldNode::restart() {
  if (world_) epoch_sec_ += world_->timeSec();  // stamps never go back
  world_.reset();
  world_ = std::make_unique<simulation::World>(load(params_), static_cast<std::uint32_t>(params_.seed));
  R_odom_base_ = world_->truth().T_odom_base.linear();
  claim_ = simulation::Claim::kNone;
  mission_start_sec_ = -1.0;
  said_ = {};
  clock_due_sec_ = judge_due_sec_ = verdict_due_sec_ = debt_sec_ = 0.0;
  camera_info_.setCameraInfo(toMsg(world_->camera()));
  truth_window_publisher_.publish(
      toPoseStampedMsg(world_->T_odom_window(), headerOf(stampOf(0.0), params_.frames.odom)));
  publishReference();
}

void WorldNode::tick() {
  const double now_sec = steadyNowSec();
  debt_sec_ += running_ ? (now_sec - ticked_sec_) * params_.real_time_factor : 0.0;
  ticked_sec_ = now_sec;
  running_ = running_ || mayRun();
  lost_sec_ += std::max(0.0, debt_sec_ - kMostDebtSec);
  debt_sec_ = std::min(debt_sec_, kMostDebtSec);
  for (; debt_sec_ >= simulation::World::kStepSec; debt_sec_ -= simulation::World::kStepSec) stepOnce();
}

bool WorldNode::mayRun() {
  const bool awaited = image_publisher_.getNumSubscribers() > 0 && odom_publisher_.getNumSubscribers() > 0;
  return awaited || steadyNowSec() - created_sec_ >= params_.wait_sec;
}

void WorldNode::stepOnce() {
  world_->advance();
  if (world_->timeSec() >= clock_due_sec_) publishClock();
  while (const auto sample = world_->takeImu()) publishImu(*sample);
  while (const auto sample = world_->takeOdometry()) publishOdometry(*sample);
  if (const auto frame = world_->takeFrame()) publishFrame(*frame);
  publishVerdict();
}

void WorldNode::receiveCommand(const geometry_msgs::TwistStampedConstPtr& message) {
  command_health_.arrived();
  const auto setpoint = fromMsg(*message, params_.frames, R_odom_base_);
  if (!setpoint) return command_health_.refused(setpoint.reason);
  command_health_.accepted();
  world_->command({setpoint.value->velocity_odom_mps, setpoint.value->yaw_rate_radps});
}

void WorldNode::receiveState(const window_ingress::IngressStateConstPtr& message) {
  using State = window_ingress::IngressState;
  if (message->state == State::PASSED) claim_ = simulation::Claim::kPassed;
  if (message->state == State::ABORTED) claim_ = simulation::Claim::kAborted;
  if (message->state == State::IDLE) claim_ = simulation::Claim::kNone;
  if (mission_start_sec_ < 0.0 && message->state != State::IDLE) mission_start_sec_ = world_->timeSec();
}

bool WorldNode::reset(Trigger::Request&, Trigger::Response& response) {
  restart();
  response.success = true;
  response.message =
      "scenario '" + params_.scenario + "', seed " + std::to_string(params_.seed) + " from its start";
  return true;
}

ros::Time WorldNode::stampOf(double world_sec) const { return toStamp(epoch_sec_ + world_sec); }

void WorldNode::publishClock() {
  rosgraph_msgs::Clock message;
  message.clock = stampOf(world_->timeSec());
  clock_publisher_.publish(message);
  clock_due_sec_ = world_->timeSec() + 1.0 / params_.clock_rate_hz - 0.5 * simulation::World::kStepSec;
}

void WorldNode::publishFrame(const simulation::CameraFrame& frame) {
  const std_msgs::Header stamped = headerOf(stampOf(frame.stamp_sec), params_.camera_frame);
  sensor_msgs::CameraInfo info = camera_info_.getCameraInfo();
  info.header = stamped;
  info_publisher_.publish(info);
  if (image_publisher_.getNumSubscribers() > 0) image_publisher_.publish(toImageMsg(frame.image, stamped));
  truth_in_camera_publisher_.publish(toPoseStampedMsg(frame.T_camera_window, stamped));
}

void WorldNode::publishOdometry(const simulation::OdometrySample& sample) {
  const auto message = toOdometryMsg(sample, stampOf(sample.stamp_sec), params_.frames);
  odom_publisher_.publish(message);
  R_odom_base_ = sample.T_odom_base.linear();
  tf_.sendTransform(toTransformStampedMsg(sample.T_odom_base, message.header, params_.frames.base));
  publishTruth(world_->timeSec());
}

void WorldNode::publishImu(const simulation::ImuSample& sample) {
  imu_publisher_.publish(toImuMsg(sample, stampOf(sample.stamp_sec), params_.frames));
}

void WorldNode::publishTruth(double stamp_sec) {
  truth_odom_publisher_.publish(toOdometryMsg(world_->truth(), stampOf(stamp_sec), params_.frames));
}

void WorldNode::publishMounting() {
  static_tf_.sendTransform(
      mountingOf(world_->T_base_camera(), stampOf(0.0), params_.frames, params_.camera_frame));
}

// What an operator would have photographed before the flight.
void WorldNode::publishReference() {
  geometry::Quadrilateral corners;
  window_ingress::ReferencePicture message;
  message.picture =
      *toImageMsg(world_->referencePicture(&corners), headerOf(stampOf(0.0), params_.camera_frame));
  for (std::size_t i = 0; i < 4; ++i) {
    message.corner_x[i] = corners[i].x();
    message.corner_y[i] = corners[i].y();
  }
  reference_publisher_.publish(message);
}

window_ingress::FlightVerdict WorldNode::verdict() const {
  const simulation::Referee& referee = world_->referee();
  const simulation::Verdict judgement = referee.judge(claim_);
  window_ingress::FlightVerdict message;
  message.header = headerOf(stampOf(world_->timeSec()), "window");
  message.outcome = static_cast<std::uint8_t>(judgement.outcome);
  message.outcome_name = simulation::toString(judgement.outcome);
  message.reason = judgement.reason;
  message.crossed = referee.crossing().has_value();
  const double until_sec = message.crossed ? referee.crossing()->time_sec : world_->timeSec();
  message.time = mission_start_sec_ < 0.0 ? 0.0 : until_sec - mission_start_sec_;
  message.offset_y = message.crossed ? referee.crossing()->offset_y_m : 0.0;
  message.offset_z = message.crossed ? referee.crossing()->offset_z_m : 0.0;
  message.was_inside = referee.minClearance().has_value();
  message.min_clearance = referee.minClearance().value_or(0.0);
  message.wrong_side = referee.wrongSide();
  message.max_speed = referee.maxSpeed();
  return message;
}

// The first outcome stands: what happens afterwards is no longer the flight.
void WorldNode::publishVerdict() {
  if (world_->timeSec() < judge_due_sec_) return;
  judge_due_sec_ = world_->timeSec() + kJudgePeriodSec;
  const bool over = said_.outcome != window_ingress::FlightVerdict::RUNNING;
  const window_ingress::FlightVerdict message = over ? said_ : verdict();
  const bool news = message.outcome != said_.outcome;
  if (!news && world_->timeSec() < verdict_due_sec_) return;
  if (news) ROS_INFO("referee: %s: %s", message.outcome_name.c_str(), message.reason.c_str());
  verdict_publisher_.publish(message);
  said_ = message;
  verdict_due_sec_ = world_->timeSec() + kVerdictPeriodSec;
}

Health WorldNode::speedHealth() const {
  if (!ros::Time::isSimTime())
    return {Health::kError, "use_sim_time is not set: nodes will take the stamps for old"};
  if (!running_) return {Health::kWarn, "waiting for subscribers of image_raw and odom"};
  const double part = lost_sec_ / std::max(1e-3, lost_sec_ + world_->timeSec());
  if (part > 0.1)
    return {Health::kWarn, "slower than asked: " + std::to_string(part * 100.0) + " % of the time lost"};
  return {};
}

}  // namespace window_ingress::adapters
