#include "adapters/navigator/mission_action.hpp"

#include <std_msgs/UInt32.h>

#include <array>
#include <cmath>
#include <utility>

#include "adapters/runtime/diagnostics.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::adapters {
namespace {

constexpr double kChoiceSec = 2.0;    // time for the pose node to switch the target
constexpr double kSameSizeM = 0.005;  // plus three sigma of a size that is still being estimated
constexpr std::array kOpenings = {"", "ask", "allow", "deny"};
constexpr std::array kGlass = {"", "possible", "excluded"};

navigation::MissionPolicy policyOf(const window_ingress::IngressGoal& goal) {
  return {kOpenings.at(goal.unverified_opening), kGlass.at(goal.glass)};
}

bool isOther(double asked_m, double known_m, double sigma_m) {
  return asked_m != 0.0 && !(std::abs(asked_m - known_m) <= kSameSizeM + 3.0 * sigma_m);
}

std::string whyOtherSize(const window_ingress::IngressGoal& goal, const window_ingress::WindowSize& known) {
  if (!isOther(goal.window_width, known.width, known.width_sigma) &&
      !isOther(goal.window_height, known.height, known.height_sigma))
    return "";
  if (known.width == 0.0) return "the window's size cannot be compared: nothing on window_pose so far";
  return formatted("the goal's window is %.2f x %.2f m, the pose node uses %.2f x %.2f m (window_size:=)",
                   goal.window_width, goal.window_height, known.width, known.height);
}

window_ingress::IngressResult resultOf(std::uint8_t outcome, const std::string& why) {
  window_ingress::IngressResult result;
  result.outcome = outcome;
  result.reason = why;
  return result;
}

}  // namespace

MissionAction::MissionAction(ros::NodeHandle& nh, Diagnostics& diagnostics, Mission mission)
    : mission_(std::move(mission)) {
  choice_ = nh.advertise<std_msgs::UInt32>("chosen_window", 1);
  facade_subscriber_ = subscribeCatching<window_ingress::Facade>(
      nh, "facade", 1, diagnostics, [this](const auto& message) { receiveFacade(*message); });
  server_ = std::make_unique<Server>(
      nh, "ingress",
      [this, &diagnostics](Server::GoalHandle goal) {
        catchAll(diagnostics, "ingress", [&] { receiveGoal(goal); });
      },
      [this, &diagnostics](Server::GoalHandle goal) {
        catchAll(diagnostics, "ingress", [&] { receiveCancel(goal); });
      },
      false);
  server_->start();
}

void MissionAction::receiveGoal(Server::GoalHandle goal) {
  const std::string why = whyRefused(*goal.getGoal());
  if (!why.empty()) return refuse(goal, why);
  goal_ = goal;
  const std::uint32_t window_id = goal.getGoal()->window_id;
  if (window_id == 0 || isChosen(window_id)) return start();
  choose(window_id);
}

std::string MissionAction::whyRefused(const Goal& goal) const {
  if (phase_ != Phase::kNone) return "another goal is under way: cancel it first";
  if (const std::string flying = mission_.flying(); !flying.empty()) return flying;
  if (goal.unverified_opening >= kOpenings.size()) return "unverified_opening must be 0 to 3";
  if (goal.glass >= kGlass.size()) return "glass must be 0 to 2";
  if (const std::string why = whyOtherSize(goal, window_size_); !why.empty()) return why;
  return goal.window_id == 0 ? "" : whyUnknown(goal.window_id);
}

std::string MissionAction::whyUnknown(std::uint32_t window_id) const {
  std::string known;
  for (const auto& window : facade_.windows) {
    if (window.id == window_id) return "";
    known += (known.empty() ? "" : ", ") + std::to_string(window.id);
  }
  return "window " + std::to_string(window_id) +
         " is not known (topic facade); known: " + (known.empty() ? "none" : known);
}

bool MissionAction::isChosen(std::uint32_t window_id) const {
  return facade_.target_id == window_id && facade_.target_chosen != 0;
}

// The pose node knows the windows; its facade shows whether it has accepted this one.
void MissionAction::choose(std::uint32_t window_id) {
  std_msgs::UInt32 message;
  message.data = window_id;
  choice_.publish(message);
  phase_ = Phase::kChoosing;
  chosen_since_sec_ = steadyNowSec();
}

void MissionAction::receiveFacade(const window_ingress::Facade& facade) {
  facade_ = facade;
  if (phase_ == Phase::kChoosing && isChosen(goal_.getGoal()->window_id)) start();
}

void MissionAction::start() {
  const Reply reply = mission_.start(policyOf(*goal_.getGoal()));
  if (!reply.success) return refuse(goal_, reply.message);
  phase_ = Phase::kFlying;
  goal_.setAccepted(reply.message);
}

void MissionAction::refuse(Server::GoalHandle& goal, const std::string& why) {
  ROS_INFO("goal: refused: %s", why.c_str());
  goal.setRejected(resultOf(Result::REFUSED, why), why);
  if (goal == goal_) phase_ = Phase::kNone;
}

void MissionAction::receiveCancel(const Server::GoalHandle& goal) {
  if (phase_ == Phase::kNone || !(goal == goal_)) return;
  const bool waits = phase_ == Phase::kChoosing;
  finish(Result::PREEMPTED, waits ? "cancelled before the start" : mission_.abort().message);
}

void MissionAction::hear(const window_ingress::WindowSize& size) { window_size_ = size; }

void MissionAction::hear(const window_ingress::IngressState& state) {
  using State = window_ingress::IngressState;
  if (phase_ == Phase::kNone) return;
  if (phase_ == Phase::kChoosing) {
    if (steadyNowSec() - chosen_since_sec_ > kChoiceSec)
      refuse(goal_, "the pose node has not accepted the window as target");
    return;
  }
  if (state.state == State::PASSED) return finish(Result::PASSED, state.reason);
  if (state.state == State::ABORTED) return finish(Result::ABORTED, state.reason);
  if (state.state == State::IDLE && mission_.flying().empty()) finish(Result::TAKEN_OVER, state.reason);
}

void MissionAction::feedBack(const window_ingress::IngressState& state) {
  if (phase_ != Phase::kFlying) return;
  window_ingress::IngressFeedback feedback;
  feedback.state = state;
  goal_.publishFeedback(feedback);
}

void MissionAction::stop() {
  if (phase_ != Phase::kNone) finish(Result::ABORTED, "the navigator's node ends");
}

void MissionAction::finish(std::uint8_t outcome, const std::string& why) {
  ROS_INFO("goal: ended: %s", why.c_str());
  phase_ = Phase::kNone;
  Server::GoalHandle goal;
  std::swap(goal, goal_);
  const Result result = resultOf(outcome, why);
  if (outcome == Result::PASSED) return goal.setSucceeded(result, why);
  if (outcome == Result::PREEMPTED) return goal.setCanceled(result, why);
  if (goal.getGoalStatus().status == actionlib_msgs::GoalStatus::PENDING)
    return goal.setRejected(result, why);
  goal.setAborted(result, why);
}

}  // namespace window_ingress::adapters
