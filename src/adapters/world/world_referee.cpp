#include "adapters/world/world_referee.hpp"

#include <ros/console.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "adapters/conversions/msg_conversion.hpp"

namespace window_ingress::adapters {
namespace {

constexpr double kJudgePeriodSec = 0.05, kVerdictPeriodSec = 1.0;

using VerdictMsg = window_ingress::FlightVerdict;

}  // namespace

std::string toJson(const VerdictMsg& verdict) {
  nlohmann::ordered_json json;
  json["outcome"] = verdict.outcome_name;
  json["reason"] = verdict.reason;
  json["stamp"] = verdict.header.stamp.toSec();
  json["time_s"] = verdict.time;
  const nlohmann::ordered_json none;
  json["offset_y_m"] = verdict.crossed ? nlohmann::ordered_json(verdict.offset_y) : none;
  json["offset_z_m"] = verdict.crossed ? nlohmann::ordered_json(verdict.offset_z) : none;
  json["min_clearance_m"] = verdict.was_inside ? nlohmann::ordered_json(verdict.min_clearance) : none;
  json["wrong_side_m"] = verdict.wrong_side;
  json["max_speed_mps"] = verdict.max_speed;
  return json.dump(2) + "\n";
}

WorldReferee::WorldReferee(ros::NodeHandle& nh, const std::string& file) : file_(file) {
  publisher_ = nh.advertise<VerdictMsg>("referee", 1, true);
}

void WorldReferee::restart() {
  claim_ = simulation::Claim::kNone;
  mission_start_sec_ = -1.0;
  heard_of_this_flight_ = false;
  said_ = {};
  judge_due_sec_ = verdict_due_sec_ = 0.0;
}

void WorldReferee::hear(const window_ingress::IngressState& message, const simulation::World& world) {
  using State = window_ingress::IngressState;
  const bool is_over = message.state == State::PASSED || message.state == State::ABORTED;
  heard_of_this_flight_ = heard_of_this_flight_ || !is_over;
  if (!heard_of_this_flight_) return;
  if (message.state == State::PASSED) claim_ = simulation::Claim::kPassed;
  if (message.state == State::ABORTED) claim_ = simulation::Claim::kAborted;
  if (message.state == State::IDLE) claim_ = simulation::Claim::kNone;
  if (mission_start_sec_ < 0.0 && message.state != State::IDLE) mission_start_sec_ = world.timeSec();
}

void WorldReferee::judge(const simulation::World& world, const ros::Time& now) {
  if (world.timeSec() < judge_due_sec_) return;
  judge_due_sec_ = world.timeSec() + kJudgePeriodSec;
  const bool over = said_.outcome != VerdictMsg::RUNNING;
  const VerdictMsg message = over ? said_ : verdict(world, now);
  const bool news = message.outcome != said_.outcome;
  if (!news && world.timeSec() < verdict_due_sec_) return;
  publisher_.publish(message);
  said_ = message;
  verdict_due_sec_ = world.timeSec() + kVerdictPeriodSec;
  if (!news) return;
  ROS_INFO("referee: %s: %s", message.outcome_name.c_str(), message.reason.c_str());
  write();
}

// A vehicle that waits for its mission uses up no time; one without state messages flies from the start.
double WorldReferee::limitBegins(const simulation::World& world) const {
  if (mission_start_sec_ >= 0.0) return mission_start_sec_;
  return heard_of_this_flight_ ? world.timeSec() : 0.0;
}

VerdictMsg WorldReferee::verdict(const simulation::World& world, const ros::Time& now) const {
  const simulation::Referee& referee = world.referee();
  const simulation::Verdict judgement = referee.judge(claim_, limitBegins(world));
  VerdictMsg message;
  message.header = headerOf(now, "window");
  message.outcome = static_cast<std::uint8_t>(judgement.outcome);
  message.outcome_name = simulation::toString(judgement.outcome);
  message.reason = judgement.reason;
  message.crossed = referee.crossing().has_value();
  const double until_sec = message.crossed ? referee.crossing()->time_sec : world.timeSec();
  message.time = mission_start_sec_ < 0.0 ? 0.0 : until_sec - mission_start_sec_;
  message.offset_y = message.crossed ? referee.crossing()->offset_y_m : 0.0;
  message.offset_z = message.crossed ? referee.crossing()->offset_z_m : 0.0;
  message.was_inside = referee.minClearance().has_value();
  message.min_clearance = referee.minClearance().value_or(0.0);
  message.wrong_side = referee.wrongSide();
  message.max_speed = referee.maxSpeed();
  return message;
}

void WorldReferee::finish() const {
  if (said_.outcome == VerdictMsg::RUNNING) write();
}

void WorldReferee::write() const {
  if (file_.empty()) return;
  std::ofstream file(file_);
  file << toJson(said_);
  file.close();
  if (!file) ROS_ERROR("verdict_file: cannot write %s", file_.c_str());
}

}  // namespace window_ingress::adapters
