#include "adapters/world/world_node.hpp"

#include <std_srvs/Trigger.h>

#include <algorithm>
#include <limits>

#include "adapters/runtime/parameter_server.hpp"
#include "adapters/runtime/services.hpp"

namespace window_ingress::adapters {
namespace {

using std_srvs::Trigger;

constexpr double kTickSec = 0.005;
constexpr double kStartSec = 100.0;  // a stamp of zero means unstamped
constexpr double kClockRateHz = 100.0;
constexpr double kMaxDebtSec = 0.05;  // time that the machine falls behind by more is dropped, not caught up
constexpr double kVehicleSilenceSec = 0.5, kAnySilenceSec = 1e9;
constexpr double kStepSec = simulation::World::kStepSec;

simulation::Scenario load(const WorldNodeParams& params) {
  simulation::Scenario scenario;
  if (!params.scenario.empty())
    scenario = simulation::loadScenario(params.scenario, static_cast<std::uint32_t>(params.seed));
  if (params.start_at == "vehicle" && scenario.vehicle.profile != "external")
    throw InputError("start_at: vehicle needs a scenario with 'vehicle: external'; " +
                     (params.scenario.empty() ? "none is given" : params.scenario + " has its own vehicle") +
                     ": add that line, or use sim.launch");
  return scenario;
}

}  // namespace

WorldNode::WorldNode(ros::NodeHandle& nh, ros::NodeHandle& pnh)
    : params_(readParameters<WorldNodeParams>(pnh)),
      diagnostics_(nh, pnh),
      epoch_sec_(kStartSec),
      created_sec_(steadyNowSec()),
      ticked_sec_(created_sec_),
      camera_info_(nh, "world", checkedUrl(params_.camera_info_url)),
      publishers_(nh, params_.frames, params_.camera_frame, params_.lockstep),
      referee_(nh, params_.verdict_file) {
  const simulation::Scenario scenario = load(params_);
  if (scenario.vehicle.profile != "external") publishers_.advertiseVehicle(nh);
  for (const auto& fault : scenario.faults) refuseDeadGuard(fault);
  if (params_.lockstep) {
    refuseInLockstep(scenario);
    lockstep_.emplace(nh, params_.camera_frame, params_.lockstep_timeout_sec);
    diagnostics_.add("lockstep", [this] { return lockstep_->health(); });
  }
  calibrate(scenario);
  restart();
  subscribe(nh);
  diagnostics_.add("speed", [this] { return speedHealth(); });
  reset_ = advertise<Trigger>(pnh, "reset", [this](auto&) { return reset(); });
  detector_reset_ = nh.serviceClient<Trigger>("window_detector/reset");
  pose_reset_ = nh.serviceClient<Trigger>("homography_pose/reset");
  inject_ = advertise<Inject>(pnh, "inject", [this](const auto& request) { return inject(request); });
  timer_ = diagnostics_.createTimer(nh, kTickSec, "tick", [this] { tick(); });
}

// A calibration of the camera (camera_info_url, set_camera_info), or else the truth.
void WorldNode::calibrate(const simulation::Scenario& scenario) {
  if (!params_.camera_info_url.empty() && camera_info_.isCalibrated()) return;
  camera_info_.setCameraInfo(toMsg(scenario.camera.model()));
}

void WorldNode::subscribe(ros::NodeHandle& nh) {
  state_subscriber_ = diagnostics_.subscribe(nh, "state", 10, &WorldNode::receiveState, this);
  if (isExternal()) {
    vehicle_.emplace(diagnostics_, "vehicle_odom", std::nullopt, kVehicleSilenceSec);
    vehicle_->subscribe(nh, 10, &WorldNode::receiveVehicle, this);
  } else {
    command_.emplace(diagnostics_, "cmd_vel", std::nullopt, kAnySilenceSec);
    command_->subscribe(nh, 1, &WorldNode::receiveCommand, this);
  }
  if (lockstep_) diagnostics_.afterEachMessage([this] { tickLockstep(); });
}

void WorldNode::restart() {
  simulation::Scenario scenario = load(params_);
  if (T_odom_start_) scenario.startAt(*T_odom_start_);
  if (world_ && !isExternal()) epoch_sec_ += world_->timeSec();  // stamps never go back
  world_.reset();
  world_ = std::make_unique<simulation::World>(scenario, static_cast<std::uint32_t>(params_.seed));
  R_odom_base_ = world_->truth().T_odom_base.linear();
  answer_.reset();
  followed_sec_ = -1.0;
  clock_due_sec_ = debt_sec_ = 0.0;
  images_due_ = images_lost_ = 0;
  began_sec_ = steadyNowSec();
  images_.emplace(world_->scenario().camera.rate_hz);
  truth_due_.emplace(world_->scenario().odometry.rate_hz);
  referee_.restart();
  publishers_.facts(*world_, now());
  if (!lockstep_) return;
  lockstep_->sent().reference = lockstep_->sent().image = now();
  lockstep_->sent().has_image = false;
  if (running_) lockstep_->ask(now());
}

// --- time --------------------------------------------------------------------------------------------------

void WorldNode::tick() {
  if (isExternal()) return deliverNewestImages();
  if (lockstep_) return tickLockstep();
  const double now_sec = steadyNowSec();
  debt_sec_ += running_ ? (now_sec - ticked_sec_) * params_.real_time_factor : 0.0;
  ticked_sec_ = now_sec;
  running_ = running_ || mayRun();
  lost_sec_ += std::max(0.0, debt_sec_ - kMaxDebtSec);
  debt_sec_ = std::min(debt_sec_, kMaxDebtSec);
  for (; debt_sec_ >= kStepSec; debt_sec_ -= kStepSec) {
    stepOnce();
    deliverImages();
  }
}

// The first step asks at time zero: its answer shows that all nodes run and are connected.
void WorldNode::tickLockstep() {
  if (!running_ && mayRun()) {
    running_ = true;
    tellTime();
    lockstep_->ask(now());
  }
  const bool early = (steadyNowSec() - began_sec_) * params_.real_time_factor < world_->timeSec();
  if (!running_ || (params_.realtime && early)) return;
  const bool may_give_up = steadyNowSec() - created_sec_ >= params_.wait_sec;
  if (lockstep_->goesOn(state_subscriber_.getNumPublishers() > 0, may_give_up)) advanceToNextStep();
}

// Images are sent after the vehicle has answered everything before them.
void WorldNode::advanceToNextStep() {
  if (answer_) world_->command(*answer_);
  answer_.reset();
  deliverImages();
  do stepOnce();
  while (!imageIsDue());
  tellTime();
  lockstep_->ask(now());
}

// The shutter first opens at the end of the first step.
bool WorldNode::imageIsDue() {
  const double exposed_sec = world_->timeSec() - world_->scenario().camera.latency_sec;
  return exposed_sec + 1e-9 >= kStepSec && images_->due(exposed_sec);
}

bool WorldNode::mayRun() {
  const bool awaited = publishers_.imagesAreAwaited() && publishers_.odometryIsAwaited() &&
                       (!lockstep_ || lockstep_->hasListeners());
  return awaited || steadyNowSec() - created_sec_ >= params_.wait_sec;
}

void WorldNode::stepOnce() {
  world_->advance();
  if (!isExternal() && world_->timeSec() >= clock_due_sec_) tellTime();
  while (const auto sample = world_->takeImu()) sendImu(*sample);
  while (const auto sample = world_->takeOdometry()) sendOdometry(*sample);
  while (const auto sample = world_->takeTransform())
    publishers_.transform(*sample, stampOf(sample->stamp_sec));
  if (truth_due_->due(world_->timeSec())) publishers_.truth(*world_, now());
  referee_.judge(*world_, now());
}

void WorldNode::tellTime() {
  if (const auto reading_sec = world_->readClock()) publishers_.clock(stampOf(*reading_sec));
  clock_due_sec_ = world_->timeSec() + 1.0 / kClockRateHz - 0.5 * kStepSec;
}

ros::Time WorldNode::stampOf(double world_sec) const { return toStamp(epoch_sec_ + world_sec); }

// --- what leaves -------------------------------------------------------------------------------------------

void WorldNode::deliverImages() {
  while (const auto sample = world_->takeCalibration()) sendCalibration(*sample);
  while (const auto frame = world_->takeFrame()) deliver(*frame);
}

void WorldNode::deliver(const simulation::CameraFrame& frame) {
  const ros::Time stamp = stampOf(frame.stamp_sec);
  const bool sent = publishers_.frame(frame, stamp);
  if (!sent || !lockstep_) return;
  lockstep_->sent().image = stamp;
  lockstep_->sent().has_image = true;
}

// Sends the calibration of set_camera_info, with the same errors as the world's own.
void WorldNode::sendCalibration(const simulation::CalibrationSample& sample) {
  sensor_msgs::CameraInfo info = camera_info_.getCameraInfo();
  const double zoom = sample.camera.fx / world_->camera().fx;
  for (double* focal : {&info.K[0], &info.K[4], &info.P[0], &info.P[5]}) *focal *= zoom;
  const ros::Time stamp = stampOf(sample.stamp_sec);
  publishers_.cameraInfo(info, stamp);
  if (lockstep_) lockstep_->sent().camera_info = stamp;
}

void WorldNode::sendOdometry(const simulation::OdometrySample& sample) {
  const ros::Time stamp = stampOf(sample.stamp_sec);
  publishers_.odometry(sample, stamp);
  if (sample.T_odom_base.matrix().allFinite()) R_odom_base_ = sample.T_odom_base.linear();
  if (lockstep_) lockstep_->sent().odom = stamp;
}

void WorldNode::sendImu(const simulation::ImuSample& sample) {
  const ros::Time stamp = stampOf(sample.stamp_sec);
  publishers_.imu(sample, stamp);
  if (lockstep_) lockstep_->sent().imu = stamp;
}

// --- what comes --------------------------------------------------------------------------------------------

void WorldNode::receiveCommand(const geometry_msgs::TwistStampedConstPtr& message) {
  command_->admits(message->header.stamp);
  if (lockstep_) lockstep_->hearSetpoint(message->header.stamp);
  const auto setpoint = fromMsg(*message, params_.frames, R_odom_base_);
  if (!setpoint) return command_->refused(setpoint.reason);
  command_->accepted();
  const simulation::VelocityCommand command{setpoint.value->velocity_odom_mps,
                                            setpoint.value->yaw_rate_radps};
  lockstep_ ? void(answer_ = command) : world_->command(command);
}

void WorldNode::receiveState(const window_ingress::IngressStateConstPtr& message) {
  referee_.hear(*message, *world_);
  if (lockstep_) lockstep_->hearState(*message);
}

Reply WorldNode::reset() {
  if (params_.next_seed_at_reset && params_.seed < std::numeric_limits<int>::max()) ++params_.seed;
  T_odom_start_.reset();
  if (isExternal()) running_ = false;  // until the vehicle is heard again
  restart();
  const Reply reply{true, "scenario '" + params_.scenario + "', seed " + std::to_string(params_.seed) +
                              " from its start" + makeOthersForget()};
  ROS_INFO("reset: %s", reply.message.c_str());
  return reply;
}

// Makes other nodes forget the previous world. \return text to append to the answer
std::string WorldNode::makeOthersForget() {
  std::string said;
  for (ros::ServiceClient* client : {&detector_reset_, &pose_reset_}) {
    Trigger call;
    const bool done = client->exists() && client->call(call) && call.response.success;
    said += "; " + client->getService() + (done ? ": " + call.response.message : " does not answer");
  }
  return said;
}

Reply WorldNode::inject(const window_ingress::InjectRequest& request) {
  simulation::FaultParams fault;
  fault.unit = request.unit;
  fault.kind = request.kind;
  fault.duration_sec = request.duration_sec;
  const bool unheard = lockstep_ && (fault.unit == "clock" || fault.unit == "tf");
  Reply reply;
  try {
    if (unheard) throw InputError("fault: in lockstep nothing uses " + fault.unit);
    refuseDeadGuard(fault);
    world_->inject(fault);
    reply = {true, fault.unit + " " + fault.kind +
                       formatted(" from %.3f s for %g s", now().toSec(), fault.duration_sec)};
  } catch (const InputError& error) {
    reply.message = error.what();
  }
  ROS_INFO("inject: %s", reply.message.c_str());
  return reply;
}

Health WorldNode::speedHealth() const {
  if (isExternal()) return externalHealth();
  if (!ros::Time::isSimTime())
    return {Health::kError, "use_sim_time is not set: nodes will refuse the stamps as too old"};
  if (!running_) return {Health::kWarn, "waiting for subscribers of image_raw and odom"};
  const double part = lost_sec_ / std::max(1e-3, lost_sec_ + world_->timeSec());
  if (part > 0.1)
    return {Health::kWarn, formatted("slower than requested: %.0f %% of the time lost", 100.0 * part)};
  return {};
}

std::unique_ptr<Node> makeWorld(ros::NodeHandle& nh, ros::NodeHandle& pnh) {
  return std::make_unique<WorldNode>(nh, pnh);
}

}  // namespace window_ingress::adapters
