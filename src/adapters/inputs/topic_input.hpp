#pragma once

#include <ros/node_handle.h>

#include <functional>
#include <optional>
#include <string>

#include "adapters/inputs/stamp_gate.hpp"
#include "adapters/runtime/diagnostics.hpp"

namespace window_ingress::adapters {

/// A topic that a node needs: whether its messages arrive and are usable, reported in diagnostics.
class TopicInput {
 public:
  /// \param stamps limits of the messages' stamps; empty: any stamp is admitted
  /// \param silence_sec longest accepted silence of the topic, on the steady clock
  TopicInput(Diagnostics& diagnostics, const std::string& name,
             const std::optional<StampLimits>& stamps = std::nullopt, double silence_sec = kSilenceSec);

  /// Subscribes `(owner->*receive)(message)` to the topic of this name.
  template <typename Message, typename Owner>
  void subscribe(ros::NodeHandle& nh, int queue,
                 void (Owner::*receive)(const boost::shared_ptr<const Message>&), Owner* owner) {
    watch(diagnostics_.subscribe(nh, name_, queue, receive, owner));
  }
  /// Keeps a subscriber (of roscpp or image_transport), whose name and number of publishers are reported.
  template <typename Subscriber>
  void watch(const Subscriber& subscriber) {
    topic_ = [subscriber] { return subscriber.getTopic(); };
    publishers_ = [subscriber] { return static_cast<int>(subscriber.getNumPublishers()); };
  }

  /// Call first for each message. \return false if it is refused for its stamp
  bool admits(const ros::Time& stamp);
  /// \param warning oddity of an accepted message, or empty
  void accepted(const std::string& warning = "");
  /// Notes the stamp of an accepted message, to report its age.
  void stamped(double stamp_sec);
  /// Also prints on the console, at most every 5 s, and not before the clock has begun.
  void refused(const std::string& why);

  std::string topic() const { return topic_ ? topic_() : name_; }
  bool isConnected() const { return publishers_ && publishers_() > 0; }
  ros::Time lastStamp() const { return stamp_; }  ///< of the last message, used or not
  /// Time since the last usable message [s], on the steady clock; infinite before the first.
  double silentSec() const;
  Health health() const;

 private:
  Health verdict() const;

  Diagnostics& diagnostics_;
  std::string name_;
  std::optional<StampGate> gate_;
  double silence_sec_;
  std::function<std::string()> topic_;
  std::function<int()> publishers_;
  ros::Time stamp_;
  double started_sec_, arrived_sec_ = -1.0, accepted_sec_ = -1.0, said_sec_ = -1.0;
  double age_sec_ = 0.0, period_sec_ = 0.0;  // period_sec_ is smoothed
  long messages_ = 0, refusals_ = 0;
  std::string refusal_, warning_;
};

}  // namespace window_ingress::adapters
