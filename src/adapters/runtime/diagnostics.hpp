/// A node's own state on /diagnostics: one status per cause, with the topic's name, within two seconds.
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>

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

  /// Calls `work`. An exception is counted and reported under `name`. No exception may leave a callback,
  /// because it would end the process while the vehicle flies.
  /// \return false after an exception
  bool catchAll(const std::string& name, const std::function<void()>& work);
  /// Consecutive exceptions of `catchAll` under this name.
  int failuresInARow(const std::string& name) const { return failures_.inARow(name); }

  /// Work after each message, in the same `catchAll` as its callback.
  void afterEachMessage(std::function<void()> work) { after_message_ = std::move(work); }
  /// Handles a message of a topic by `work`, in `catchAll`.
  void handle(const std::string& topic, const std::function<void()>& work);
  /// Subscribes `(owner->*receive)(message)`; messages pass through `handle`.
  template <typename Message, typename Owner>
  ros::Subscriber subscribe(ros::NodeHandle& nh, const std::string& topic, int queue,
                            void (Owner::*receive)(const boost::shared_ptr<const Message>&), Owner* owner) {
    using Pointer = boost::shared_ptr<const Message>;
    const boost::function<void(const Pointer&)> safe = [=](const Pointer& message) {
      handle(topic, [&] { (owner->*receive)(message); });
    };
    return nh.subscribe<Message>(topic, queue, safe, ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
  }
  /// A timer on the steady clock, which ticks even while /clock stands still; calls `work` in `catchAll`.
  ros::SteadyTimer createTimer(ros::NodeHandle& nh, double period_sec, const std::string& name,
                               std::function<void()> work);

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
  double runningSec() const { return steadyNowSec() - started_sec_; }
  void sayOnConsole(const std::string& name, Item& item) const;
  Health clockHealth();

  diagnostic_updater::Updater updater_;
  ros::SteadyTimer timer_;
  std::map<std::string, Item> items_;
  double published_sec_ = 0.0;
  FailureCount failures_;
  std::function<void()> after_message_;
  double started_sec_ = 0.0, begun_sec_ = 0.0;  // start; in simulated time: first time on /clock
  double clock_sec_ = -1.0, clock_moved_sec_ = 0.0;
};

}  // namespace window_ingress::adapters
