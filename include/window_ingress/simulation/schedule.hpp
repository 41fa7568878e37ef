#pragma once

#include <deque>
#include <optional>
#include <utility>

namespace window_ingress::simulation {

/// Says at which physics steps something with a rate of its own happens, without drifting from that rate.
class Periodic {
 public:
  explicit Periodic(double rate_hz) : period_sec_(1.0 / rate_hz) {}
  /// True at most once for each period; call with times that do not decrease.
  bool due(double now_sec) {
    if (now_sec + 1e-9 < static_cast<double>(count_) * period_sec_) return false;
    ++count_;
    return true;
  }

 private:
  double period_sec_;
  long count_ = 0;
};

/// Values on their way: what goes in at t comes out at t + delay.
template <typename Value>
class DelayLine {
 public:
  explicit DelayLine(double delay_sec) : delay_sec_(delay_sec) {}
  void push(double now_sec, Value value) { waiting_.emplace_back(now_sec + delay_sec_, std::move(value)); }
  /// The latest value that has arrived by now; it and the older ones are forgotten.
  std::optional<Value> take(double now_sec) {
    std::optional<Value> latest;
    while (!waiting_.empty() && waiting_.front().first <= now_sec + 1e-9) {
      latest = std::move(waiting_.front().second);
      waiting_.pop_front();
    }
    return latest;
  }

 private:
  double delay_sec_;
  std::deque<std::pair<double, Value>> waiting_;
};

}  // namespace window_ingress::simulation
