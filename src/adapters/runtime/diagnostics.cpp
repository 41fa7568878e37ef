#include "adapters/runtime/diagnostics.hpp"

#include <ros/console.h>

#include <algorithm>
#include <chrono>

#include "adapters/runtime/console_decoupling.hpp"
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

bool Diagnostics::catchAll(const std::string& name, const std::function<void()>& work) {
  std::string what = "an exception of unknown type";
  try {
    work();
    failures_.succeeded(name);
    return true;
  } catch (const std::exception& error) {
    what = error.what();
  } catch (...) {
  }
  if (failures_.failed(name, what)) ROS_ERROR("callback failed: %s: %s", name.c_str(), what.c_str());
  return false;
}

void Diagnostics::handle(const std::string& topic, const std::function<void()>& work) {
  catchAll(topic, [&] {
    work();
    if (after_message_) after_message_();
  });
}

ros::SteadyTimer Diagnostics::createTimer(ros::NodeHandle& nh, double period_sec, const std::string& name,
                                          std::function<void()> work) {
  return nh.createSteadyTimer(ros::WallDuration(period_sec),
                              [=](const ros::SteadyTimerEvent&) { catchAll(name, work); });
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

}  // namespace window_ingress::adapters
