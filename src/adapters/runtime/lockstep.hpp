#pragma once

#include <ros/node_handle.h>
#include <window_ingress/LockstepStep.h>

#include <functional>

#include "adapters/inputs/stamp_gate.hpp"
#include "adapters/runtime/diagnostics.hpp"

namespace window_ingress::adapters {

/// A node's side of lockstep with the simulated world: the node works once per step, when everything that the
/// world has sent before has arrived, in any order. Simulated time only.
class Lockstep {
 public:
  using Step = window_ingress::LockstepStep;

  /// \param complete whether all messages of the step, and what other nodes derive from them, have arrived
  /// \param work the node's work in this step
  /// \throws InputError without use_sim_time: a node on a real vehicle must not wait for a simulated world
  Lockstep(ros::NodeHandle& nh, Diagnostics& diagnostics, std::function<bool(const Step&)> complete,
           std::function<void(const Step&)> work);

  void check();  ///< call after each message

 private:
  std::function<bool(const Step&)> complete_;
  std::function<void(const Step&)> work_;
  boost::shared_ptr<const Step> pending_;
  ros::Subscriber subscriber_;
  ros::SteadyTimer timer_;
};

/// In lockstep a node's clock may be slightly early or late: it must not decide about messages.
StampLimits limitsFor(bool lockstep, const StampLimits& limits);

/// Queue length of a subscriber: in lockstep no message may be lost.
inline int queueFor(bool lockstep, int queue) { return lockstep ? 1000 : queue; }

}  // namespace window_ingress::adapters
