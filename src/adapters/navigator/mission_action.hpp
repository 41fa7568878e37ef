#pragma once

#include <actionlib/server/action_server.h>
#include <ros/node_handle.h>
#include <std_msgs/UInt32.h>
#include <window_ingress/Facade.h>
#include <window_ingress/IngressAction.h>
#include <window_ingress/IngressState.h>
#include <window_ingress/WindowSize.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "adapters/runtime/diagnostics.hpp"
#include "window_ingress/navigation/navigator.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::adapters {

/// The mission as an action, for a planner that controls more than this flight. It only requests and reports:
/// the navigator decides whether to fly and brakes by itself, with or without a client.
class MissionAction {
 public:
  struct Mission {
    std::function<std::string()> flying;  ///< why no other mission may begin now; empty if it may
    std::function<Reply(const navigation::MissionPolicy&)> start;
    std::function<Reply()> abort;  ///< zero has been sent when it returns
  };

  /// \param diagnostics must outlive this
  MissionAction(ros::NodeHandle& nh, Diagnostics& diagnostics, Mission mission)
      : mission_(std::move(mission)),
        choice_(nh.advertise<std_msgs::UInt32>("chosen_window", 1)),
        facade_subscriber_(diagnostics.subscribe(nh, "facade", 1, &MissionAction::receiveFacade, this)),
        server_(nh, "ingress", catching(diagnostics, &MissionAction::receiveGoal),
                catching(diagnostics, &MissionAction::receiveCancel), false) {
    server_.start();
  }

  /// Call in every step: ends the goal.
  void hear(const window_ingress::IngressState& state) {
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

  /// Call for each published state.
  void feedBack(const window_ingress::IngressState& state) {
    if (phase_ != Phase::kFlying) return;
    window_ingress::IngressFeedback feedback;
    feedback.state = state;
    goal_.publishFeedback(feedback);
  }

  /// The size that the pose node uses.
  void hear(const window_ingress::WindowSize& size) { window_size_ = size; }

  /// Call when the node ends.
  void stop() {
    if (phase_ != Phase::kNone) finish(Result::ABORTED, "the navigator's node ends");
  }

 private:
  using Goal = window_ingress::IngressGoal;
  using Result = window_ingress::IngressResult;
  using Server = actionlib::ActionServer<window_ingress::IngressAction>;
  using GoalHandle = Server::GoalHandle;
  enum class Phase { kNone, kChoosing, kFlying };

  static constexpr double kChoiceSec = 2.0;    // time for the pose node to switch the target
  static constexpr double kSameSizeM = 0.005;  // plus three sigma of a size that is still being estimated
  static constexpr std::array kOpenings = {"", "ask", "allow", "deny"};
  static constexpr std::array kGlass = {"", "possible", "excluded"};

  std::function<void(GoalHandle)> catching(Diagnostics& diagnostics,
                                           void (MissionAction::*receive)(GoalHandle&)) {
    return [this, &diagnostics, receive](GoalHandle goal) {
      diagnostics.catchAll("ingress", [&] { (this->*receive)(goal); });
    };
  }

  void receiveGoal(GoalHandle& goal) {
    const std::string why = whyRefused(*goal.getGoal());
    if (!why.empty()) return refuse(goal, why);
    goal_ = goal;
    const std::uint32_t window_id = goal.getGoal()->window_id;
    if (window_id == 0 || isChosen(window_id)) return start();
    choose(window_id);
  }

  std::string whyRefused(const Goal& goal) const {
    if (phase_ != Phase::kNone) return "another goal is under way: cancel it first";
    if (const std::string flying = mission_.flying(); !flying.empty()) return flying;
    if (goal.unverified_opening >= kOpenings.size()) return "unverified_opening must be 0 to 3";
    if (goal.glass >= kGlass.size()) return "glass must be 0 to 2";
    if (const std::string why = whyOtherSize(goal); !why.empty()) return why;
    return goal.window_id == 0 ? "" : whyUnknown(goal.window_id);
  }

  static bool isOther(double asked_m, double known_m, double sigma_m) {
    return asked_m != 0.0 && !(std::abs(asked_m - known_m) <= kSameSizeM + 3.0 * sigma_m);
  }

  std::string whyOtherSize(const Goal& goal) const {
    const window_ingress::WindowSize& known = window_size_;
    if (!isOther(goal.window_width, known.width, known.width_sigma) &&
        !isOther(goal.window_height, known.height, known.height_sigma))
      return "";
    if (known.width == 0.0) return "the window's size cannot be compared: nothing on window_pose so far";
    return formatted("the goal's window is %.2f x %.2f m, the pose node uses %.2f x %.2f m (window_size:=)",
                     goal.window_width, goal.window_height, known.width, known.height);
  }

  std::string whyUnknown(std::uint32_t window_id) const {
    std::string known;
    for (const auto& window : facade_.windows) {
      if (window.id == window_id) return "";
      known += (known.empty() ? "" : ", ") + std::to_string(window.id);
    }
    return "window " + std::to_string(window_id) +
           " is not known (topic facade); known: " + (known.empty() ? "none" : known);
  }

  bool isChosen(std::uint32_t window_id) const {
    return facade_.target_id == window_id && facade_.target_chosen != 0;
  }

  // The pose node knows the windows; its facade shows whether it has accepted this one.
  void choose(std::uint32_t window_id) {
    std_msgs::UInt32 message;
    message.data = window_id;
    choice_.publish(message);
    phase_ = Phase::kChoosing;
    chosen_since_sec_ = steadyNowSec();
  }

  void receiveFacade(const window_ingress::FacadeConstPtr& facade) {
    facade_ = *facade;
    if (phase_ == Phase::kChoosing && isChosen(goal_.getGoal()->window_id)) start();
  }

  void start() {
    if (const std::string flying = mission_.flying(); !flying.empty()) return refuse(goal_, flying);
    const Goal& goal = *goal_.getGoal();
    const Reply reply = mission_.start({kOpenings.at(goal.unverified_opening), kGlass.at(goal.glass)});
    if (!reply.success) return refuse(goal_, reply.message);
    phase_ = Phase::kFlying;
    goal_.setAccepted(reply.message);
  }

  void refuse(GoalHandle& goal, const std::string& why) {
    ROS_INFO("goal: refused: %s", why.c_str());
    goal.setRejected(resultOf(Result::REFUSED, why), why);
    if (goal == goal_) phase_ = Phase::kNone;
  }

  void receiveCancel(GoalHandle& goal) {
    if (phase_ == Phase::kNone || !(goal == goal_)) return;
    const bool waits = phase_ == Phase::kChoosing;
    finish(Result::PREEMPTED, waits ? "cancelled before the start" : mission_.abort().message);
  }

  void finish(std::uint8_t outcome, const std::string& why) {
    ROS_INFO("goal: ended: %s", why.c_str());
    phase_ = Phase::kNone;
    GoalHandle goal;
    std::swap(goal, goal_);
    const Result result = resultOf(outcome, why);
    if (outcome == Result::PASSED) return goal.setSucceeded(result, why);
    if (outcome == Result::PREEMPTED) return goal.setCanceled(result, why);
    if (goal.getGoalStatus().status == actionlib_msgs::GoalStatus::PENDING)
      return goal.setRejected(result, why);
    goal.setAborted(result, why);
  }

  static Result resultOf(std::uint8_t outcome, const std::string& why) {
    Result result;
    result.outcome = outcome;
    result.reason = why;
    return result;
  }

  Mission mission_;
  Phase phase_ = Phase::kNone;
  GoalHandle goal_;                // valid unless the phase is kNone
  double chosen_since_sec_ = 0.0;  // on the steady clock
  window_ingress::Facade facade_;
  window_ingress::WindowSize window_size_;
  ros::Publisher choice_;
  ros::Subscriber facade_subscriber_;
  Server server_;
};

}  // namespace window_ingress::adapters
