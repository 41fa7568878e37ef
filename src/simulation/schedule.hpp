#pragma once

#include <algorithm>
#include <deque>
#include <optional>
#include <utility>

namespace window_ingress::simulation {

/// Decides at which physics steps a periodic event happens, without drift from its rate.
class Periodic {
 public:
  explicit Periodic(double rate_hz) : period_sec_(1.0 / rate_hz) {}
  /// True at most once per period; times of the calls must not decrease.
  bool due(double now_sec) {
    if (now_sec + 1e-9 < static_cast<double>(count_) * period_sec_) return false;
    ++count_;
    return true;
  }

 private:
  double period_sec_;
  long count_ = 0;
};

/// Delayed values, first in first out: no value overtakes an earlier one.
template <typename Value>
class DelayLine {
 public:
  void push(double arrival_sec, Value value) {
    if (!waiting_.empty()) arrival_sec = std::max(arrival_sec, waiting_.back().first);
    waiting_.emplace_back(arrival_sec, std::move(value));
  }
  /// Takes the oldest value that has arrived; empty if there is none.
  std::optional<Value> take(double now_sec) {
    if (waiting_.empty() || waiting_.front().first > now_sec + 1e-9) return std::nullopt;
    std::optional<Value> oldest = std::move(waiting_.front().second);
    waiting_.pop_front();
    return oldest;
  }

 private:
  std::deque<std::pair<double, Value>> waiting_;
};

}  // namespace window_ingress::simulation
