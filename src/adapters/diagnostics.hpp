/// What a node says of itself on /diagnostics: one status per cause, naming the topic, within two seconds.
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>

#include <functional>
#include <map>
#include <string>

namespace window_ingress::adapters {

/// One thing to know about a node.
struct Health {
  enum Level { kOk = 0, kWarn = 1, kError = 2 };
  Level level = kOk;
  std::string text = "ok";
};

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

/// Collects what is wrong, publishes it once a second, and says on the console what has changed.
class Diagnostics {
 public:
  Diagnostics(const ros::NodeHandle& nh, const ros::NodeHandle& pnh);

  /// Asks `check` for its state each second.
  void add(const std::string& name, std::function<Health()> check);

  void succeeded(const std::string& callback) { failures_.succeeded(callback); }
  void caught(const std::string& callback, const std::string& what);  ///< counted, and said on the console
  const FailureCount& failures() const { return failures_; }

 private:
  void run(const std::string& name, const std::function<Health()>& check,
           diagnostic_updater::DiagnosticStatusWrapper& status);
  Health clockHealth();

  diagnostic_updater::Updater updater_;
  ros::SteadyTimer timer_;
  std::map<std::string, Health> said_;
  FailureCount failures_;
  double started_sec_ = 0.0;
  double clock_sec_ = -1.0, clock_moved_sec_ = 0.0;
};

/// Whether messages of one topic arrive, and whether they can be used.
class TopicHealth {
 public:
  /// \param silence_sec how long the topic may be silent, on the steady clock
  TopicHealth(Diagnostics& diagnostics, const std::string& name, double silence_sec);

  /// Name and publishers are asked of the subscriber when they are needed.
  void watch(std::function<std::string()> topic, std::function<int()> publishers);
  void watch(const ros::Subscriber& subscriber);

  void arrived() {
    arrived_sec_ = steadyNowSec();
    ++messages_;
  }
  /// \param warning what is odd about the message, or nothing
  void accepted(const std::string& warning = "");
  void refused(const std::string& why);  ///< also says so on the console, at most every 5 s

  /// Since the last message that could be used [s], on the steady clock; infinite before the first.
  double silentSec() const;
  Health health() const;

 private:
  std::string name_;
  double silence_sec_;
  std::function<std::string()> topic_;
  std::function<int()> publishers_;
  double started_sec_, arrived_sec_ = -1.0, accepted_sec_ = -1.0, said_sec_ = -1.0;
  long messages_ = 0, refusals_ = 0;
  std::string refusal_, warning_;
};

}  // namespace window_ingress::adapters
