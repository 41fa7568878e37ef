#pragma once

#include <ros/node_handle.h>
#include <window_ingress/IngressState.h>
#include <window_ingress/LockstepStep.h>

#include <string>

#include "adapters/runtime/diagnostics.hpp"
#include "simulation/scenario/scenario.hpp"

namespace window_ingress::adapters {

/// \throws InputError if the scenario holds what lockstep cannot do
void refuseInLockstep(const simulation::Scenario& scenario);

/// The world's side of lockstep: says where it stands, and knows when the vehicle has answered.
///
/// An answer is a state (if anybody publishes states) and, unless the state says that none is streamed, a
/// setpoint, both stamped with the time of the step or later.
class WorldLockstep {
 public:
  WorldLockstep(ros::NodeHandle& nh, const std::string& camera_frame, double timeout_sec);

  window_ingress::LockstepStep& sent() { return step_; }  ///< to be kept up to date with what was sent
  void ask(const ros::Time& now);
  bool hasListeners() const { return publisher_.getNumSubscribers() > 0; }

  void hearState(const window_ingress::IngressState& state) { state_ = state; }
  void hearSetpoint(const ros::Time& stamp) { setpoint_stamp_ = stamp; }
  /// Whether the world may go on: answered, or waited too long (counted). \param may_give_up before the first
  /// answer the nodes may still be coming up
  bool goesOn(bool states_are_published, bool may_give_up);
  Health health() const;

 private:
  bool answered(bool states_are_published) const;

  double timeout_sec_;
  ros::Publisher publisher_;
  window_ingress::LockstepStep step_;
  window_ingress::IngressState state_;
  ros::Time setpoint_stamp_;
  double asked_sec_ = 0.0;  // on the steady clock
  bool asking_ = false, ever_answered_ = false;
  long steps_ = 0, timeouts_ = 0;
};

}  // namespace window_ingress::adapters
