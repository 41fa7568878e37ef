/// Requests to the navigator's node: services, the action's goal and cancel; and what if none can arrive.
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <ctime>

#include "adapters/navigator/navigator_node.hpp"
#include "adapters/runtime/services.hpp"

namespace window_ingress::adapters {

using navigation::State;

namespace {

constexpr const char* kForgotten =
    "unknown to the ROS master, which was restarted: take over by the switch, end all launches, start again";

}  // namespace

void NavigatorNode::advertiseServices(ros::NodeHandle& pnh) {
  const auto add = [&](const std::string& name, const std::function<Reply()>& act) {
    services_.push_back(advertise<std_srvs::Trigger>(pnh, name, [=](auto&) { return said(name, act()); }));
  };
  add("start", [this] { return startMission({}); });
  add("abort", [this] { return abortMission("aborted by the operator"); });
  add("reset", [this] { return reset(); });
  add("confirm_opening", [this] { return navigator_.confirmOpening(); });
  services_.push_back(advertise<std_srvs::SetBool>(
      pnh, "enable", [this](const auto& request) { return said("enable", enable(request.data)); }));
}

// Prints the answer of a service; a repeated refusal once.
Reply NavigatorNode::said(const std::string& service, const Reply& reply) {
  const std::string line = service + ": " + (reply.success ? "done: " : "refused: ") + reply.message;
  if (reply.success || line != refused_) ROS_INFO("%s", line.c_str());
  refused_ = reply.success ? "" : line;
  return reply;
}

Reply NavigatorNode::startMission(const navigation::MissionPolicy& policy) {
  const double now_sec = lockstep_ ? step_sec_ : ros::Time::now().toSec();
  if (is_disabled_) return {false, "not started: disabled (~enable)"};
  if (!lockstep_) forgetSilentInputs();
  if (master_ && master_->isForgotten()) return {false, std::string("not started: ") + kForgotten};
  if (!lockstep_ && clockStandsStill(now_sec)) return {false, "the clock stands still: nothing on /clock"};
  if (params_.start_at_once && last_.state == State::kIdle)
    return {false, "start_at_once: the mission starts by itself as soon as it can"};
  Reply reply = navigator_.start(input_, now_sec, policy);
  if (reply.success) {
    for (const std::string& fault : upstream_.texts()) reply.message += "; but beware: " + fault;
    return reply;
  }
  for (const Health& health : {odom_.health(), pose_.health(), engagementHealth()})
    if (health.level == Health::kError) reply.message += "; " + health.text;
  for (const std::string& fault : upstream_.texts()) reply.message += "; " + fault;
  if (pose_.health().level == Health::kError)
    for (const std::string& fault : upstream_.silentNodes()) reply.message += "; " + fault;
  return reply;
}

Reply NavigatorNode::abortMission(const std::string& why) {
  if (is_disabled_ && whyFlying().empty()) return {true, "nothing to abort: disabled (~enable)"};
  const Reply reply = navigator_.abort(why);
  if (reply.success && !lockstep_) publishSetpoint(navigation::Setpoint(), ros::Time::now());
  return reply;
}

// Another set of nodes may be started beside these, and ~abort no longer comes here. In COMMIT it flies
// on.
void NavigatorNode::abortIfForgotten() {
  if (!master_ || !master_->isForgotten() || whyFlying().empty()) return;
  if (navigator_.state() != navigation::State::kCommit)
    navigator_.abort(std::string("aborted: ") + kForgotten);
}

// The guard has braked meanwhile, and a pilot or the autopilot's failsafe may have the vehicle.
void NavigatorNode::abortIfItSlept() {
  constexpr double kSleptSec = 3.0;
  timespec now{};
  clock_gettime(CLOCK_BOOTTIME, &now);  // counts a suspended computer's sleep, too
  const double before_sec = stepped_sec_;
  stepped_sec_ = static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  if (lockstep_ || stepped_sec_ - before_sec < kSleptSec || whyFlying().empty()) return;
  navigator_.abort(formatted("aborted: the navigator itself stood still for %.1f s (suspended? too busy?)",
                             stepped_sec_ - before_sec));
}

Health NavigatorNode::masterHealth() const {
  return master_ && master_->isForgotten() ? Health{Health::kError, kForgotten} : Health{};
}

std::string NavigatorNode::whyFlying() const {
  const State state = navigator_.state();
  if (state == State::kIdle || navigation::isEnd(state)) return "";
  return std::string("already flying: ") + navigation::toString(state);
}

bool NavigatorNode::isLeftToOthers() const {
  return is_disabled_ && (last_.state == State::kIdle || last_.state == State::kPassed);
}

// Disabling in flight first aborts the mission: zeros continue as after ~abort.
Reply NavigatorNode::enable(bool wanted) {
  is_disabled_ = !wanted;
  if (wanted) return {true, "enabled: zeros in IDLE, ~start may be called"};
  const bool flies = !whyFlying().empty();
  if (flies) abortMission("aborted: disabled (~enable)");
  if (!flies && last_.state == State::kPassed) navigator_.abort("");  // keeps its place no longer
  return {true, std::string(flies ? "aborted, " : "") +
                    "disabled: starts nothing and sends nothing; the guard sends zeros "
                    "for setpoint_guard/stop_streaming_after_sec more"};
}

// Publishes the mission's end before it is forgotten, however soon the reset comes.
Reply NavigatorNode::reset() {
  if (!lockstep_ && navigation::isEnd(navigator_.state())) step();
  return navigator_.reset();
}

}  // namespace window_ingress::adapters
