#pragma once

#include <ros/node_handle.h>
#include <window_ingress/LockstepStep.h>

#include <functional>

#include "adapters/inputs/stamp_gate.hpp"
#include "adapters/runtime/diagnostics.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::adapters {

/// \throws InputError without use_sim_time: a node on a real vehicle must not wait for a simulated world
inline void requireSimulatedTime() {
  if (!ros::Time::isSimTime())
    throw InputError("lockstep is for simulated time only, and use_sim_time is not set");
}

/// A node's side of lockstep with the simulated world: the node works once per step, when everything that the
/// world has sent before has arrived, in any order, which is checked after each message. Simulated time only.
class Lockstep {
 public:
  using Step = window_ingress::LockstepStep;

  /// \param complete whether all messages of the step, and what other nodes derive from them, have arrived
  /// \param work the node's work in this step
  /// \throws InputError as `requireSimulatedTime`
  Lockstep(ros::NodeHandle& nh, Diagnostics& diagnostics, std::function<bool(const Step&)> complete,
           std::function<void(const Step&)> work)
      : complete_(std::move(complete)), work_(std::move(work)) {
    requireSimulatedTime();
    subscriber_ = diagnostics.subscribe(nh, "lockstep", 10, &Lockstep::receive, this);
    diagnostics.afterEachMessage([this] { check(); });
    timer_ = diagnostics.createTimer(nh, kLinkPeriodSec, "lockstep", [this] { check(); });
  }

 private:
  static constexpr double kLinkPeriodSec = 0.02;  // connections to other nodes come up without a message

  void receive(const boost::shared_ptr<const Step>& step) { pending_ = step; }

  void check() {
    if (!pending_ || !complete_(*pending_)) return;
    const boost::shared_ptr<const Step> step = pending_;
    pending_.reset();
    work_(*step);
  }

  std::function<bool(const Step&)> complete_;
  std::function<void(const Step&)> work_;
  boost::shared_ptr<const Step> pending_;
  ros::Subscriber subscriber_;
  ros::SteadyTimer timer_;
};

/// In lockstep a node's clock may be slightly early or late: it must not decide about messages.
inline StampLimits limitsFor(bool lockstep, const StampLimits& limits) {
  constexpr double kAnySec = 1e9;  // a node's clock reads zero before its first message
  return lockstep ? StampLimits{60.0, kAnySec} : limits;
}

/// Queue length of a subscriber: in lockstep no message may be lost.
inline int queueFor(bool lockstep, int queue) { return lockstep ? 1000 : queue; }

}  // namespace window_ingress::adapters
