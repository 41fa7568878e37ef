/// A node's own state on /diagnostics: one status per cause, with the topic's name, within two seconds.
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

/// A topic without messages for this long, on the steady clock, is silent [s].
constexpr double kSilenceSec = 1.4;

/// State of one part of a node.
struct Health {
  enum Level { kOk = 0, kWarn = 1, kError = 2 };
  Level level = kOk;
  std::string text = "ok";
  std::vector<std::pair<std::string, double>> values = {};  ///< additional numbers, with unit in the name
};

/// Whether an output has subscribers. Their absence is tolerated during start-up.
/// \param listeners sum over all topics \param topics names for the text \param running_sec since the start
Health outputHealth(int listeners, const std::string& topics, double running_sec);

/// Seconds on the steady clock, which neither /clock nor NTP moves.
double steadyNowSec();

/// Counts failed callbacks: in total, and consecutively per callback.
class FailureCount {
 public:
  static constexpr int kMany = 5;  ///< consecutive failures that are no longer occasional

  void succeeded(const std::string& callback) { in_a_row_.erase(callback); }
  /// \return false if this callback has failed too often for another message to help
  bool failed(const std::string& callback, const std::string& what);
  int inARow(const std::string& callback) const;
  Health health() const;

 private:
  std::map<std::string, int> in_a_row_;
  int all_ = 0;
  std::string last_;
};

/// Collects the states of a node. Publishes them once a second and at each change; the console shows changes
/// of level. In the first seconds, while other nodes start, faults are printed as "waiting".
class Diagnostics {
 public:
  Diagnostics(const ros::NodeHandle& nh, const ros::NodeHandle& pnh);

  /// Calls `check` five times a second.
  void add(const std::string& name, std::function<Health()> check);
  /// Warns while none of these outputs has a subscriber; names the first.
  void addOutput(const std::string& name, const std::vector<ros::Publisher>& outputs);

  double runningSec() const;  ///< since the start, on the steady clock

  void succeeded(const std::string& callback) { failures_.succeeded(callback); }
  void caught(const std::string& callback, const std::string& what);  ///< counts and prints the failure
  const FailureCount& failures() const { return failures_; }

 private:
  struct Item {
    std::function<Health()> check;
    Health now;
    std::string said = "ok";       // last text, without numbers
    int on_console = Health::kOk;  // last level printed there
  };
  static constexpr int kAwaited = 3;  // beyond the levels of Health
  void look();
  bool lookAt(const std::string& name, Item& item);
  void sayOnConsole(const std::string& name, Item& item) const;
  Health clockHealth();

  diagnostic_updater::Updater updater_;
  ros::SteadyTimer timer_;
  std::map<std::string, Item> items_;
  double published_sec_ = 0.0;
  FailureCount failures_;
  double started_sec_ = 0.0, begun_sec_ = 0.0;  // start; in simulated time: first time on /clock
  double clock_sec_ = -1.0, clock_moved_sec_ = 0.0;
};

/// Whether a topic's messages arrive and are usable.
class TopicHealth {
 public:
  /// \param silence_sec longest accepted silence of the topic, on the steady clock
  TopicHealth(Diagnostics& diagnostics, const std::string& name, double silence_sec);

  /// Takes name and number of publishers from the subscriber (roscpp or image_transport) when needed.
  template <typename Subscriber>
  void watch(const Subscriber& subscriber) {
    topic_ = [subscriber] { return subscriber.getTopic(); };
    publishers_ = [subscriber] { return static_cast<int>(subscriber.getNumPublishers()); };
  }

  void arrived();
  /// \param warning oddity of an accepted message, or empty
  void accepted(const std::string& warning = "");
  /// Notes the stamp of an accepted message, to report its age.
  void stamped(double stamp_sec);
  void refused(const std::string& why);  ///< also prints on the console, at most every 5 s

  /// Time since the last usable message [s], on the steady clock; infinite before the first.
  double silentSec() const;
  Health health() const;

 private:
  Health verdict() const;

  std::string name_;
  double silence_sec_;
  std::function<std::string()> topic_;
  std::function<int()> publishers_;
  double started_sec_, arrived_sec_ = -1.0, accepted_sec_ = -1.0, said_sec_ = -1.0;
  double age_sec_ = 0.0, period_sec_ = 0.0;  // period_sec_ is smoothed
  long messages_ = 0, refusals_ = 0;
  std::string refusal_, warning_;
};

/// Calls `work`. An exception is counted and reported in `diagnostics` under `name`. No exception may leave a
/// callback, because it would end the process while the vehicle flies.
/// \return false after an exception
template <typename Work>
bool catchAll(Diagnostics& diagnostics, const std::string& name, Work&& work) {
  try {
    std::forward<Work>(work)();
    diagnostics.succeeded(name);
    return true;
  } catch (const std::exception& error) {
    diagnostics.caught(name, error.what());
  } catch (...) {
    diagnostics.caught(name, "an exception of unknown type");
  }
  return false;
}

/// Subscribes `callback(const boost::shared_ptr<const Message>&)`; its exceptions are caught.
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

/// A timer on the steady clock, which ticks even while /clock stands still; exceptions of its callback are
/// caught.
inline ros::SteadyTimer createCatchingTimer(ros::NodeHandle& nh, double period_sec, const std::string& name,
                                            Diagnostics& diagnostics, std::function<void()> callback) {
  return nh.createSteadyTimer(ros::WallDuration(period_sec),
                              [&diagnostics, name, callback](const ros::SteadyTimerEvent&) {
                                catchAll(diagnostics, name, callback);
                              });
}

}  // namespace window_ingress::adapters
