#pragma once

#include <cmath>
#include <cstddef>
#include <deque>
#include <optional>
#include <utility>

#include "simulation/scenario/fault_params.hpp"

namespace window_ingress::simulation {

/// The way of one kind of data out of the world or into it: what is put in comes out at once, unless a fault
/// acts. Then some of it is lost, late, repeated or spoiled. Times must not decrease.
///
/// `Traits::repeat(old, fresh)`: the old value as it is said again in place of the fresh one.
/// `Traits::spoil(value, fault)`: for the kinds "garbage" and "wrong".
///
/// When a fault ends, what it still held back is lost: order is kept, and nothing of it is felt later on.
template <typename Value, typename Traits>
class FaultLine {
 public:
  explicit FaultLine(Traits traits = {}) : traits_(std::move(traits)) {}

  /// \param fault what acts now, or none
  void put(double now_sec, Value value, const FaultParams* fault) {
    notice(fault);
    if (fault == nullptr) {
      before_ = value;
      makeReady(std::move(value));
    } else if (passes(now_sec, *fault)) {
      change(value, *fault);
      const double due_sec = fault->kind == "delayed" ? now_sec + fault->delay_sec : now_sec;
      held_.emplace_back(due_sec, std::move(value));
    }
  }

  /// The next of what has arrived by now, in order; to be called until there is nothing.
  std::optional<Value> take(double now_sec, const FaultParams* fault) {
    notice(fault);
    for (; !held_.empty() && held_.front().first <= now_sec + 1e-9; held_.pop_front())
      makeReady(std::move(held_.front().second));
    if (ready_.empty()) return std::nullopt;
    std::optional<Value> first = std::move(ready_.front());
    ready_.pop_front();
    return first;
  }

 private:
  static constexpr std::size_t kMaxReady = 1000;  // what nobody takes is forgotten

  void makeReady(Value value) {
    ready_.push_back(std::move(value));
    if (ready_.size() > kMaxReady) ready_.pop_front();
  }

  void notice(const FaultParams* fault) {
    if (fault == acting_) return;
    acting_ = fault;
    held_.clear();
    next_sec_ = -1.0;
  }

  bool passes(double now_sec, const FaultParams& fault) {
    if (fault.kind == "off") return false;
    if (fault.kind == "intermittent")
      return std::fmod(now_sec - fault.at_sec + 1e-9, fault.off_sec + fault.on_sec) >= fault.off_sec;
    if (fault.kind != "slow") return true;
    if (now_sec + 1e-9 < next_sec_) return false;
    next_sec_ = now_sec + 1.0 / fault.rate_hz;
    return true;
  }

  void change(Value& value, const FaultParams& fault) {
    if (fault.kind == "stuck") {
      if (!before_) before_ = value;  // stuck from the start: the first is repeated
      value = traits_.repeat(*before_, value);
    } else if (fault.kind == "garbage" || fault.kind == "wrong") {
      traits_.spoil(value, fault);
    }
  }

  Traits traits_;
  const FaultParams* acting_ = nullptr;
  std::optional<Value> before_;
  double next_sec_ = -1.0;
  std::deque<std::pair<double, Value>> held_;
  std::deque<Value> ready_;
};

}  // namespace window_ingress::simulation
