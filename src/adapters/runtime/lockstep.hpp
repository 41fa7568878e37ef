#pragma once

#include <ros/node_handle.h>
#include <window_ingress/LockstepStep.h>

#include <functional>

#include "adapters/inputs/stamp_gate.hpp"
#include "adapters/runtime/diagnostics.hpp"

namespace window_ingress::adapters {

/// A node's side of lockstep with the simulated world: its work is done once for each step, when all that the
/// world sent before has come, in whatever order. Simulated time only.
class Lockstep {
 public:
  using Step = window_ingress::LockstepStep;

  /// \param complete whether everything that the step names, and what other nodes make of it, has come
  /// \param work what the node does in this step
  /// \throws InputError without use_sim_time: on a real vehicle nothing may wait for a simulated world
  Lockstep(ros::NodeHandle& nh, Diagnostics& diagnostics, std::function<bool(const Step&)> complete,
           std::function<void(const Step&)> work);

  void check();  ///< to be called whenever something has come

 private:
  std::function<bool(const Step&)> complete_;
  std::function<void(const Step&)> work_;
  boost::shared_ptr<const Step> pending_;
  ros::Subscriber subscriber_;
  ros::SteadyTimer timer_;
};

/// In lockstep the clock of a node may be read early or late by a little: it must not decide about messages.
StampLimits limitsFor(bool lockstep, const StampLimits& limits);

/// How many messages may wait for a callback: in lockstep none may be lost.
inline int queueFor(bool lockstep, int queue) { return lockstep ? 1000 : queue; }

}  // namespace window_ingress::adapters
