/// What a node says of itself on /diagnostics: one status per cause, naming the topic, within two seconds.
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>

#include <exception>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace window_ingress::adapters {

/// A topic that says nothing for this long, on the steady clock, is silent [s].
constexpr double kSilenceSec = 1.4;

/// One thing to know about a node.
struct Health {
  enum Level { kOk = 0, kWarn = 1, kError = 2 };
  Level level = kOk;
  std::string text = "ok";
  std::vector<std::pair<std::string, double>> values = {};  ///< numbers beside it, with unit in the name
};

/// Whether an output is heard by anybody. Start-up is forgiven.
/// \param listeners in all, of the topics named \param topics for people \param running_sec since the start
Health outputHealth(int listeners, const std::string& topics, double running_sec);

/// Seconds on the steady clock, which neither /clock nor NTP moves.
double steadyNowSec();

/// Counts callbacks that failed, in all and in a row for each of them.
class FailureCount {
 public:
  static constexpr int kMany = 5;  ///< in a row: no longer a mishap

  void succeeded(const std::string& callback) { in_a_row_.erase(callback); }
  /// \return false if this callback has failed so often that saying it once more helps nobody
  bool failed(const std::string& callback, const std::string& what);
  int inARow(const std::string& callback) const;
  Health health() const;

 private:
  std::map<std::string, int> in_a_row_;
  int all_ = 0;
  std::string last_;
};

/// Collects what is wrong, publishes it once a second and as soon as something else is the matter, and says
/// on the console what has changed; in the first seconds, in which neighbours come up, as what is waited for.
class Diagnostics {
 public:
  Diagnostics(const ros::NodeHandle& nh, const ros::NodeHandle& pnh);

  /// Asks `check` for its state five times a second.
  void add(const std::string& name, std::function<Health()> check);
  /// Warns while nobody subscribes to any of these outputs; the first is named.
  void addOutput(const std::string& name, const std::vector<ros::Publisher>& outputs);

  double runningSec() const;  ///< since the start, on the steady clock

  void succeeded(const std::string& callback) { failures_.succeeded(callback); }
  void caught(const std::string& callback, const std::string& what);  ///< counted, and said on the console
  const FailureCount& failures() const { return failures_; }

 private:
  struct Item {
    std::function<Health()> check;
    Health now;
    std::string said = "ok";       // without numbers
    int on_console = Health::kOk;  // what was said there last
  };
  static constexpr int kAwaited = 3;  // beside the levels
  void look();
  bool lookAt(const std::string& name, Item& item);
  void sayOnConsole(const std::string& name, Item& item) const;
  Health clockHealth();

  diagnostic_updater::Updater updater_;
  ros::SteadyTimer timer_;
  std::map<std::string, Item> items_;
  double published_sec_ = 0.0;
  FailureCount failures_;
  double started_sec_ = 0.0, begun_sec_ = 0.0;  // the same but under simulated time, which begins later
  double clock_sec_ = -1.0, clock_moved_sec_ = 0.0;
};

/// Whether messages of one topic arrive, and whether they can be used.
class TopicHealth {
 public:
  /// \param silence_sec how long the topic may be silent, on the steady clock
  TopicHealth(Diagnostics& diagnostics, const std::string& name, double silence_sec);

  /// Name and publishers are asked of the subscriber, of roscpp or image_transport, when they are needed.
  template <typename Subscriber>
  void watch(const Subscriber& subscriber) {
    topic_ = [subscriber] { return subscriber.getTopic(); };
    publishers_ = [subscriber] { return static_cast<int>(subscriber.getNumPublishers()); };
  }

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

/// No exception leaves a callback: it would end the process, the vehicle still flying.
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
