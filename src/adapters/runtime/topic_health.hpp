#pragma once

#include <ros/subscriber.h>

#include <functional>
#include <string>

#include "adapters/runtime/diagnostics.hpp"

namespace window_ingress::adapters {

/// Whether messages of one topic arrive, and whether they can be used.
class TopicHealth {
 public:
  /// \param silence_sec how long the topic may be silent, on the steady clock
  TopicHealth(Diagnostics& diagnostics, const std::string& name, double silence_sec);

  /// Name and publishers are asked of the subscriber when they are needed.
  void watch(std::function<std::string()> topic, std::function<int()> publishers);
  void watch(const ros::Subscriber& subscriber);

  void arrived();
  /// \param warning what is odd about the message, or nothing
  void accepted(const std::string& warning = "");
  /// Stamp of a message that was accepted, beside the clock: its age is told.
  void stamped(double stamp_sec);
  void refused(const std::string& why);  ///< also says so on the console, at most every 5 s

  /// Since the last message that could be used [s], on the steady clock; infinite before the first.
  double silentSec() const;
  Health health() const;

 private:
  Health verdict() const;

  std::string name_;
  double silence_sec_;
  std::function<std::string()> topic_;
  std::function<int()> publishers_;
  double started_sec_, arrived_sec_ = -1.0, accepted_sec_ = -1.0, said_sec_ = -1.0;
  double age_sec_ = 0.0, period_sec_ = 0.0;  // the latter smoothed
  long messages_ = 0, refusals_ = 0;
  std::string refusal_, warning_;
};

}  // namespace window_ingress::adapters
