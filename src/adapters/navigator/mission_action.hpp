#pragma once

#include <actionlib/server/action_server.h>
#include <ros/node_handle.h>
#include <window_ingress/Facade.h>
#include <window_ingress/IngressAction.h>
#include <window_ingress/IngressState.h>
#include <window_ingress/WindowSize.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "adapters/runtime/diagnostics.hpp"
#include "window_ingress/navigation/navigator.hpp"

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
  MissionAction(ros::NodeHandle& nh, Diagnostics& diagnostics, Mission mission);

  void hear(const window_ingress::IngressState& state);      ///< call in every step: ends the goal
  void feedBack(const window_ingress::IngressState& state);  ///< call for each published state
  void hear(const window_ingress::WindowSize& size);         ///< the size that the pose node uses
  void stop();                                               ///< call when the node ends

 private:
  using Goal = window_ingress::IngressGoal;
  using Result = window_ingress::IngressResult;
  using Server = actionlib::ActionServer<window_ingress::IngressAction>;

  void receiveGoal(Server::GoalHandle goal);
  void receiveCancel(const Server::GoalHandle& goal);
  void receiveFacade(const window_ingress::Facade& facade);
  std::string whyRefused(const Goal& goal) const;
  std::string whyUnknown(std::uint32_t window_id) const;
  bool isChosen(std::uint32_t window_id) const;
  void choose(std::uint32_t window_id);
  void start();
  void refuse(Server::GoalHandle& goal, const std::string& why);
  void finish(std::uint8_t outcome, const std::string& why);

  enum class Phase { kNone, kChoosing, kFlying };

  Mission mission_;
  Phase phase_ = Phase::kNone;
  Server::GoalHandle goal_;        // valid unless the phase is kNone
  double chosen_since_sec_ = 0.0;  // on the steady clock
  window_ingress::Facade facade_;
  window_ingress::WindowSize window_size_;
  ros::Publisher choice_;
  ros::Subscriber facade_subscriber_;
  std::unique_ptr<Server> server_;
};

}  // namespace window_ingress::adapters
