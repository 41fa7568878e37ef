#include "adapters/runtime/diagnostics.hpp"

#include <ros/console.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

#include "adapters/runtime/console_output.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::adapters {
namespace {

constexpr double kPeriodSec = 1.0;  // period of messages while nothing changes
constexpr double kLookSec = 0.2;
constexpr double kUnhealthyClockSec = 1.0;
// After the start, or the first time on /clock: other nodes are starting, so nothing is reported as wrong.
constexpr double kGraceSec = 3.0;
constexpr double kClockGraceSec = 15.0;  // for /clock itself: a bag begins after all nodes have started

Health consoleHealth() {
  if (!consoleIsStuck()) return {};
  return {Health::kWarn,
          "the terminal or log of this node is blocked (Ctrl-S? disk full?): lines are lost there, but not "
          "in /rosout"};
}

constexpr double kQuietSec = 5.0;   // pause between two warnings about one topic
constexpr double kSmoothing = 0.1;  // of the measured message period

}  // namespace

double steadyNowSec() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Health outputHealth(int listeners, const std::string& topics, double running_sec) {
  const std::vector<std::pair<std::string, double>> values = {{"subscribers", listeners}};
  if (listeners > 0 || running_sec < kSilenceSec) return {Health::kOk, "ok", values};
  return {Health::kWarn, "nobody subscribes to " + topics, values};
}

Diagnostics::Diagnostics(const ros::NodeHandle& nh, const ros::NodeHandle& pnh)
    : updater_(nh, pnh, pnh.getNamespace()),
      started_sec_(steadyNowSec()),
      begun_sec_(started_sec_),
      clock_moved_sec_(started_sec_) {
  updater_.setHardwareID("none");
  add("callbacks", [this] { return failures_.health(); });
  add("clock", [this] { return clockHealth(); });
  add("console", [] { return consoleHealth(); });
  timer_ = ros::NodeHandle(nh).createSteadyTimer(ros::WallDuration(kLookSec),
                                                 [this](const ros::SteadyTimerEvent&) {
                                                   try {
                                                     look();
                                                   } catch (const std::exception& error) {
                                                     ROS_ERROR("diagnostics: %s", error.what());
                                                   }
                                                 });
}

double Diagnostics::runningSec() const { return steadyNowSec() - started_sec_; }

void Diagnostics::add(const std::string& name, std::function<Health()> check) {
  items_[name].check = std::move(check);
  updater_.add(name, [this, name](diagnostic_updater::DiagnosticStatusWrapper& status) {
    const Health& health = items_[name].now;
    status.summary(static_cast<unsigned char>(health.level), health.text);
    for (const auto& [key, value] : health.values) status.add(key, value);
  });
}

void Diagnostics::addOutput(const std::string& name, const std::vector<ros::Publisher>& outputs) {
  add(name, [this, outputs] {
    int listeners = 0;
    for (const ros::Publisher& output : outputs) listeners += static_cast<int>(output.getNumSubscribers());
    const std::string others = outputs.size() > 1 ? " or the topics derived from it" : "";
    return outputHealth(listeners, outputs.front().getTopic() + others, runningSec());
  });
}

void Diagnostics::look() {
  bool news = false;
  for (auto& [name, item] : items_) news = lookAt(name, item) || news;
  if (!news && steadyNowSec() - published_sec_ < kPeriodSec) return;
  published_sec_ = steadyNowSec();
  updater_.force_update();
}

// True if the level or the text, numbers aside, has changed.
bool Diagnostics::lookAt(const std::string& name, Item& item) {
  const Health::Level before = item.now.level;
  item.now = item.check();
  const Health& now = item.now;
  sayOnConsole(name, item);
  const std::string said = withoutNumbers(now.text);
  const bool news = before != now.level || (now.level != Health::kOk && said != item.said);
  item.said = said;
  return news;
}

void Diagnostics::sayOnConsole(const std::string& name, Item& item) const {
  const Health& now = item.now;
  const bool awaits =
      name == "clock" ? runningSec() < kClockGraceSec : steadyNowSec() - begun_sec_ < kGraceSec;
  const bool starts = awaits && now.level != Health::kOk;
  const int level = starts ? kAwaited : now.level;
  if (item.on_console == level) return;
  item.on_console = level;
  if (level == kAwaited) ROS_INFO("waiting for %s: %s", name.c_str(), now.text.c_str());
  if (level == Health::kError) ROS_ERROR("%s: %s", name.c_str(), now.text.c_str());
  if (level == Health::kWarn) ROS_WARN("%s: %s", name.c_str(), now.text.c_str());
  if (level == Health::kOk) ROS_INFO("%s: %s", name.c_str(), now.text.c_str());
}

bool FailureCount::failed(const std::string& callback, const std::string& what) {
  ++all_;
  last_ = callback + ": " + what;
  return ++in_a_row_[callback] <= kMany;
}

int FailureCount::inARow(const std::string& callback) const {
  const auto found = in_a_row_.find(callback);
  return found == in_a_row_.end() ? 0 : found->second;
}

Health FailureCount::health() const {
  if (all_ == 0) return {};
  const bool many =
      std::any_of(in_a_row_.begin(), in_a_row_.end(), [](const auto& e) { return e.second >= kMany; });
  return {many ? Health::kError : Health::kWarn,
          std::to_string(all_) + " callbacks failed; the last one was " + last_};
}

void Diagnostics::caught(const std::string& callback, const std::string& what) {
  if (failures_.failed(callback, what)) ROS_ERROR("callback failed: %s: %s", callback.c_str(), what.c_str());
}

Health Diagnostics::clockHealth() {
  const double now_sec = ros::Time::now().toSec(), steady_sec = steadyNowSec();
  if (now_sec != clock_sec_) {
    clock_sec_ = now_sec;
    clock_moved_sec_ = steady_sec;
  }
  if (!ros::Time::isSimTime()) return {};
  if (now_sec == 0.0) begun_sec_ = steady_sec;
  if (now_sec == 0.0 && steady_sec - started_sec_ < kSilenceSec) return {Health::kOk, "waiting for /clock"};
  if (now_sec == 0.0)
    return {Health::kError,
            "use_sim_time is set but nothing has come on /clock; play the bag with --clock, start the world, "
            "or set use_sim_time to false"};
  if (steady_sec - clock_moved_sec_ > kUnhealthyClockSec)
    return {Health::kWarn, formatted("/clock stands still since %.2f s", steady_sec - clock_moved_sec_)};
  return {};
}

TopicHealth::TopicHealth(Diagnostics& diagnostics, const std::string& name, double silence_sec)
    : name_(name), silence_sec_(silence_sec), started_sec_(steadyNowSec()) {
  diagnostics.add(name, [this] { return health(); });
}

void TopicHealth::arrived() {
  const double now_sec = steadyNowSec(), since_sec = now_sec - arrived_sec_;
  if (arrived_sec_ >= 0.0)
    period_sec_ = period_sec_ > 0.0 ? period_sec_ + kSmoothing * (since_sec - period_sec_) : since_sec;
  arrived_sec_ = now_sec;
  ++messages_;
}

void TopicHealth::accepted(const std::string& warning) {
  accepted_sec_ = steadyNowSec();
  warning_ = warning;
}

void TopicHealth::stamped(double stamp_sec) { age_sec_ = ros::Time::now().toSec() - stamp_sec; }

void TopicHealth::refused(const std::string& why) {
  ++refusals_;
  refusal_ = why;
  const double now_sec = steadyNowSec();
  if (said_sec_ > 0.0 && now_sec - said_sec_ < kQuietSec) return;
  said_sec_ = now_sec;
  ROS_WARN("%s refused: %s", name_.c_str(), why.c_str());
}

double TopicHealth::silentSec() const {
  return accepted_sec_ < 0.0 ? std::numeric_limits<double>::infinity() : steadyNowSec() - accepted_sec_;
}

Health TopicHealth::health() const {
  Health health = verdict();
  const bool silent = arrived_sec_ < 0.0 || steadyNowSec() - arrived_sec_ > silence_sec_;
  health.values = {{"publishers", publishers_ ? publishers_() : 0},
                   {"messages", messages_},
                   {"refused", refusals_},
                   {"rate_hz", silent || period_sec_ <= 0.0 ? 0.0 : 1.0 / period_sec_},
                   {"age_s", age_sec_}};
  return health;
}

Health TopicHealth::verdict() const {
  const double now_sec = steadyNowSec();
  const std::string topic = topic_ ? topic_() : name_;
  const int publishers = publishers_ ? publishers_() : 0;
  const std::string from =
      topic + " (" + std::to_string(publishers) + (publishers == 1 ? " publisher)" : " publishers)");
  if (now_sec - (arrived_sec_ < 0.0 ? started_sec_ : arrived_sec_) > silence_sec_) {
    const char* const hint = publishers == 0 ? "; check the remapping and the message type"
                                             : "; it is advertised, but nothing is sent";
    return {Health::kError, (arrived_sec_ < 0.0 ? "no " : "no more ") + name_ + " on " + from + hint};
  }
  if (arrived_sec_ >= 0.0 && now_sec - (accepted_sec_ < 0.0 ? started_sec_ : accepted_sec_) > silence_sec_)
    return {Health::kError, from + " refused, " + std::to_string(refusals_) + " so far: " + refusal_};
  if (!warning_.empty()) return {Health::kWarn, from + ": " + warning_};
  if (publishers > 1) return {Health::kWarn, "more than one source on " + from};
  if (refusals_ > 0) return {Health::kOk, "ok; " + std::to_string(refusals_) + " refused, last: " + refusal_};
  return {Health::kOk, std::to_string(messages_) + " messages on " + from};
}

}  // namespace window_ingress::adapters
