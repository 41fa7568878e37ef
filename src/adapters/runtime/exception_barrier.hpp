/// No exception leaves a callback: it would end the process, the vehicle still flying.
#pragma once

#include <ros/node_handle.h>

#include <exception>
#include <functional>
#include <string>
#include <utility>

#include "adapters/runtime/diagnostics.hpp"

namespace window_ingress::adapters {

/// Calls `work`; an exception is counted and reported in `diagnostics` under `name`.
/// \return false if there was one
template <typename Work>
bool catchAll(Diagnostics& diagnostics, const std::string& name, Work&& work) {
  try {
    std::forward<Work>(work)();
    diagnostics.succeeded(name);
    return true;
  } catch (const std::exception& error) {
    diagnostics.caught(name, error.what());
  } catch (...) {
    diagnostics.caught(name, "something that is no std::exception");
  }
  return false;
}

/// Subscribes with a callback whose exceptions are caught; `callback(const boost::shared_ptr<const
/// Message>&)`.
template <typename Message>
ros::Subscriber subscribeCatching(ros::NodeHandle& nh, const std::string& topic, int queue,
                                  Diagnostics& diagnostics,
                                  std::function<void(const boost::shared_ptr<const Message>&)> callback) {
  using Pointer = boost::shared_ptr<const Message>;
  const boost::function<void(const Pointer&)> safe = [&diagnostics, topic, callback](const Pointer& message) {
    catchAll(diagnostics, topic, [&] { callback(message); });
  };
  return nh.subscribe<Message>(topic, queue, safe, ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
}

/// A timer on the steady clock, which ticks even while /clock stands still, with a callback whose exceptions
/// are caught.
inline ros::SteadyTimer createCatchingTimer(ros::NodeHandle& nh, double period_sec, const std::string& name,
                                            Diagnostics& diagnostics, std::function<void()> callback) {
  return nh.createSteadyTimer(ros::WallDuration(period_sec),
                              [&diagnostics, name, callback](const ros::SteadyTimerEvent&) {
                                catchAll(diagnostics, name, callback);
                              });
}

}  // namespace window_ingress::adapters
