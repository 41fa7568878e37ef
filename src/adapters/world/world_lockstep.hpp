#pragma once

#include <ros/console.h>
#include <ros/node_handle.h>
#include <window_ingress/IngressState.h>
#include <window_ingress/LockstepStep.h>

#include <string>

#include "adapters/runtime/diagnostics.hpp"
#include "simulation/scenario/scenario.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::adapters {

/// \throws InputError if the scenario uses a feature that lockstep does not support
inline void refuseInLockstep(const simulation::Scenario& scenario) {
  if (scenario.vehicle.profile == "external")
    throw InputError("lockstep: an external vehicle keeps its own time; set lockstep to false");
  if (scenario.target_chosen)
    throw InputError("lockstep: nothing selects the target (target_chosen); set lockstep to false");
  for (const auto& fault : scenario.faults)
    if (fault.unit == "clock" || fault.unit == "tf")
      throw InputError("lockstep: nothing uses " + fault.unit +
                       ", so its fault has no effect; set lockstep to false");
}

/// \throws InputError for the fault that only `fly` understands
inline void refuseDeadGuard(const simulation::FaultParams& fault) {
  if (fault.unit == "guard")
    throw InputError("fault: only fly simulates the guard; here kill the node setpoint_guard");
}

/// The world's side of lockstep: publishes its steps and knows when the vehicle has answered.
///
/// An answer is a state (if states are published) and a setpoint (unless the state says that none is
/// streamed), both stamped with the step's time or later.
class WorldLockstep {
 public:
  WorldLockstep(ros::NodeHandle& nh, const std::string& camera_frame, double timeout_sec)
      : timeout_sec_(timeout_sec) {
    publisher_ = nh.advertise<window_ingress::LockstepStep>("lockstep", 10, true);
    step_.header.frame_id = camera_frame;
  }

  window_ingress::LockstepStep& sent() { return step_; }  ///< to be updated with everything sent
  void ask(const ros::Time& now) {
    step_.header.stamp = now;
    asked_sec_ = steadyNowSec();
    asking_ = true;
    ++steps_;
    publisher_.publish(step_);
  }

  bool hasListeners() const { return publisher_.getNumSubscribers() > 0; }

  void hearState(const window_ingress::IngressState& state) { state_ = state; }
  void hearSetpoint(const ros::Time& stamp) { setpoint_stamp_ = stamp; }
  /// Whether the world may continue: answered, or a timeout (counted). \param may_give_up whether to time out
  /// before the first answer, while the nodes may still be starting
  bool goesOn(bool states_are_published, bool may_give_up) {
    if (!asking_) return false;
    const bool done = answered(states_are_published);
    ever_answered_ = ever_answered_ || done;
    const bool too_late = (ever_answered_ || may_give_up) && steadyNowSec() - asked_sec_ > timeout_sec_;
    if (!done && !too_late) return false;
    if (!done) {
      ++timeouts_;
      ROS_WARN("lockstep: no answer to the step at %.4f s within %.1f s, going on; %ld so far",
               step_.header.stamp.toSec(), timeout_sec_, timeouts_);
    }
    asking_ = false;
    return true;
  }

  Health health() const {
    if (timeouts_ == 0) return {Health::kOk, std::to_string(steps_) + " steps, all answered"};
    return {Health::kWarn,
            formatted("%ld of %ld steps were not answered in time: this run cannot be repeated exactly",
                      timeouts_, steps_)};
  }

 private:
  bool answered(bool states_are_published) const {
    const ros::Time& now = step_.header.stamp;
    if (!states_are_published) return setpoint_stamp_ >= now;
    return state_.header.stamp >= now && (!state_.enabled || setpoint_stamp_ >= now);
  }

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
