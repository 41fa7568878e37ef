#pragma once

#include <algorithm>
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

/// Values on their way, first in first out: none comes out before what went in before it.
template <typename Value>
class DelayLine {
 public:
  void push(double arrival_sec, Value value) {
    if (!waiting_.empty()) arrival_sec = std::max(arrival_sec, waiting_.back().first);
    waiting_.emplace_back(arrival_sec, std::move(value));
  }
  /// The oldest value that has arrived by now, which is forgotten; nothing once all of them were taken.
  std::optional<Value> take(double now_sec) {
    if (waiting_.empty() || waiting_.front().first > now_sec + 1e-9) return std::nullopt;
    std::optional<Value> oldest = std::move(waiting_.front().second);
    waiting_.pop_front();
    return oldest;
  }
  /// The latest value that has arrived by now; it and the older ones are forgotten.
  std::optional<Value> takeLatest(double now_sec) {
    std::optional<Value> latest;
    while (auto next = take(now_sec)) latest = std::move(next);
    return latest;
  }

 private:
  std::deque<std::pair<double, Value>> waiting_;
};

}  // namespace window_ingress::simulation
