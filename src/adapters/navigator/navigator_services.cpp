/// Requests to the navigator's node: services, and the action's goal and cancel.
#include "adapters/navigator/navigator_node.hpp"

namespace window_ingress::adapters {

using navigation::State;

void NavigatorNode::advertiseServices(ros::NodeHandle& pnh) {
  const auto advertise = [this, &pnh](const char* name, std::function<Reply()> act) {
    services_.push_back(pnh.advertiseService<Trigger::Request, Trigger::Response>(
        name, [=](Trigger::Request&, Trigger::Response& response) { return answer(name, act(), response); }));
  };
  advertise("start", [this] { return startMission({}); });
  advertise("abort", [this] { return abortMission("aborted by the operator"); });
  advertise("reset", [this] { return reset(); });
  advertise("confirm_opening", [this] { return navigator_.confirmOpening(); });
  services_.push_back(pnh.advertiseService("enable", &NavigatorNode::enable, this));
}

Reply NavigatorNode::startMission(const navigation::MissionPolicy& policy) {
  const double now_sec = nowSec();
  if (is_disabled_) return {false, "not started: disabled (~enable)"};
  if (!lockstep_) forgetSilentInputs();
  if (!lockstep_ && clockStandsStill(now_sec)) return {false, "the clock stands still: nothing on /clock"};
  if (params_.start_at_once && last_.state == State::kIdle)
    return {false, "start_at_once: the mission starts by itself as soon as it can"};
  Reply reply = navigator_.start(input_, now_sec, policy);
  if (reply.success) return reply;
  for (const Health& health : {odom_health_.health(), pose_health_.health(),
                               engagement_.health(engaged_subscriber_.getTopic(), steadyNowSec())})
    if (health.level == Health::kError) reply.message += "; " + health.text;
  for (const std::string& fault : upstream_.texts()) reply.message += "; " + fault;
  if (pose_health_.health().level == Health::kError)
    for (const std::string& fault : upstream_.silentNodes()) reply.message += "; " + fault;
  return reply;
}

Reply NavigatorNode::abortMission(const std::string& why) {
  if (is_disabled_ && whyFlying().empty()) return {true, "nothing to abort: disabled (~enable)"};
  const Reply reply = navigator_.abort(why);
  if (reply.success && !lockstep_) publishSetpoint(navigation::Setpoint(), ros::Time::now());
  return reply;
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
bool NavigatorNode::enable(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response) {
  is_disabled_ = !request.data;
  if (!is_disabled_)
    return answer("enable", {true, "enabled: zeros in IDLE, ~start may be called"}, response);
  const bool flies = !whyFlying().empty();
  if (flies) abortMission("aborted: disabled (~enable)");
  return answer("enable",
                {true, std::string(flies ? "aborted, " : "") + "disabled: sends nothing, starts nothing"},
                response);
}

// Publishes the mission's end before it is forgotten, however soon the reset comes.
Reply NavigatorNode::reset() {
  if (!lockstep_ && navigation::isEnd(navigator_.state())) step();
  return navigator_.reset();
}

template <typename Response>
bool NavigatorNode::answer(const char* service, const Reply& reply, Response& response) {
  const std::string said =
      std::string(service) + ": " + (reply.success ? "done: " : "refused: ") + reply.message;
  if (reply.success || said != refused_) ROS_INFO("%s", said.c_str());  // a repeated request is logged once
  refused_ = reply.success ? "" : said;
  response.success = reply.success;
  response.message = reply.message;
  return true;
}

}  // namespace window_ingress::adapters
