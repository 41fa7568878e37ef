#pragma once

#include <ros/console.h>
#include <ros/node_handle.h>
#include <window_ingress/FlightVerdict.h>
#include <window_ingress/IngressState.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "adapters/conversions/msg_conversion.hpp"
#include "simulation/world.hpp"

namespace window_ingress::adapters {

/// The content of the verdict's file.
inline std::string toJson(const window_ingress::FlightVerdict& verdict) {
  nlohmann::ordered_json json;
  json["outcome"] = verdict.outcome_name;
  json["reason"] = verdict.reason;
  json["stamp"] = verdict.header.stamp.toSec();
  json["time_s"] = verdict.time;
  const auto known = [](bool is_known, double value) {
    return is_known ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
  };
  json["offset_y_m"] = known(verdict.crossed, verdict.offset_y);
  json["offset_z_m"] = known(verdict.crossed, verdict.offset_z);
  json["min_clearance_m"] = known(verdict.was_inside, verdict.min_clearance);
  json["wrong_side_m"] = verdict.wrong_side;
  json["max_speed_mps"] = verdict.max_speed;
  return json.dump(2) + "\n";
}

/// The referee's verdict on a topic and in a file. The first outcome counts; later events are not part of the
/// flight.
class WorldReferee {
 public:
  /// \param file json, written at an outcome and at the end; empty: no file
  WorldReferee(ros::NodeHandle& nh, const std::string& file) : file_(file) {
    publisher_ = nh.advertise<VerdictMsg>("referee", 1, true);
  }

  void restart() {
    claim_ = simulation::Claim::kNone;
    mission_start_sec_ = -1.0;
    heard_of_this_flight_ = false;
    said_ = {};
    judge_due_sec_ = verdict_due_sec_ = 0.0;
  }

  void hear(const window_ingress::IngressState& message, const simulation::World& world) {
    using State = window_ingress::IngressState;
    const bool is_over = message.state == State::PASSED || message.state == State::ABORTED;
    heard_of_this_flight_ = heard_of_this_flight_ || !is_over;
    if (!heard_of_this_flight_) return;
    if (message.state == State::PASSED) claim_ = simulation::Claim::kPassed;
    if (message.state == State::ABORTED) claim_ = simulation::Claim::kAborted;
    if (message.state == State::IDLE) claim_ = simulation::Claim::kNone;
    if (mission_start_sec_ < 0.0 && message.state != State::IDLE) mission_start_sec_ = world.timeSec();
  }

  /// Call after each step of the world.
  void judge(const simulation::World& world, const ros::Time& now) {
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

  /// Call when the node ends.
  void finish() const {
    if (said_.outcome == VerdictMsg::RUNNING) write();
  }

 private:
  using VerdictMsg = window_ingress::FlightVerdict;
  static constexpr double kJudgePeriodSec = 0.05, kVerdictPeriodSec = 1.0;

  // A vehicle that waits for its mission uses up no time; one without state messages flies from the start.
  double limitBegins(const simulation::World& world) const {
    if (mission_start_sec_ >= 0.0) return mission_start_sec_;
    return heard_of_this_flight_ ? world.timeSec() : 0.0;
  }

  VerdictMsg verdict(const simulation::World& world, const ros::Time& now) const {
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

  void write() const {
    if (file_.empty()) return;
    std::ofstream file(file_);
    file << toJson(said_);
    file.close();
    if (!file) ROS_ERROR("verdict_file: cannot write %s", file_.c_str());
  }

  std::string file_;
  ros::Publisher publisher_;
  simulation::Claim claim_ = simulation::Claim::kNone;
  bool heard_of_this_flight_ = false;  // before it, PASSED and ABORTED belong to an earlier flight
  VerdictMsg said_;
  double mission_start_sec_ = -1.0, judge_due_sec_ = 0.0, verdict_due_sec_ = 0.0;  // in the world's time
};

}  // namespace window_ingress::adapters
