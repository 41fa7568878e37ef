#include "adapters/inputs/topic_input.hpp"

#include <ros/console.h>

#include <limits>

namespace window_ingress::adapters {
namespace {

constexpr double kQuietSec = 5.0;   // pause between two warnings about one topic
constexpr double kSmoothing = 0.1;  // of the measured message period

}  // namespace

TopicInput::TopicInput(Diagnostics& diagnostics, const std::string& name,
                       const std::optional<StampLimits>& stamps, double silence_sec)
    : diagnostics_(diagnostics), name_(name), silence_sec_(silence_sec), started_sec_(steadyNowSec()) {
  if (stamps) gate_.emplace(*stamps);
  diagnostics.add(name, [this] { return health(); });
}

bool TopicInput::admits(const ros::Time& stamp) {
  const double now_sec = steadyNowSec(), since_sec = now_sec - arrived_sec_;
  if (arrived_sec_ >= 0.0)
    period_sec_ = period_sec_ > 0.0 ? period_sec_ + kSmoothing * (since_sec - period_sec_) : since_sec;
  arrived_sec_ = now_sec;
  ++messages_;
  stamp_ = stamp;
  const auto late = gate_ ? gate_->whyRefused(stamp, ros::Time::now().toSec()) : std::nullopt;
  if (late) refused(*late);
  return !late;
}

void TopicInput::accepted(const std::string& warning) {
  accepted_sec_ = steadyNowSec();
  warning_ = warning;
}

void TopicInput::stamped(double stamp_sec) { age_sec_ = ros::Time::now().toSec() - stamp_sec; }

void TopicInput::refused(const std::string& why) {
  ++refusals_;
  refusal_ = why;
  // Messages before the first on /clock are no fault yet: the diagnostics' "clock" says when they become one.
  if (ros::Time::isSimTime() && ros::Time::now().isZero()) return;
  const double now_sec = steadyNowSec();
  if (said_sec_ > 0.0 && now_sec - said_sec_ < kQuietSec) return;
  said_sec_ = now_sec;
  ROS_WARN("%s refused: %s", name_.c_str(), why.c_str());
}

double TopicInput::silentSec() const {
  return accepted_sec_ < 0.0 ? std::numeric_limits<double>::infinity() : steadyNowSec() - accepted_sec_;
}

Health TopicInput::health() const {
  Health health = verdict();
  const bool silent = arrived_sec_ < 0.0 || steadyNowSec() - arrived_sec_ > silence_sec_;
  health.values = {{"publishers", publishers_ ? publishers_() : 0},
                   {"messages", messages_},
                   {"refused", refusals_},
                   {"rate_hz", silent || period_sec_ <= 0.0 ? 0.0 : 1.0 / period_sec_},
                   {"age_s", age_sec_}};
  return health;
}

Health TopicInput::verdict() const {
  const double now_sec = steadyNowSec();
  const int publishers = publishers_ ? publishers_() : 0;
  const std::string from =
      topic() + " (" + std::to_string(publishers) + (publishers == 1 ? " publisher)" : " publishers)");
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
