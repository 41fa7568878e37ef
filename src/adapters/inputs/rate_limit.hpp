#pragma once

#include <algorithm>

namespace window_ingress::adapters {

/// Thins a topic out: admits on average at most `max_hz` messages a second, by their stamps. 0: all.
class RateLimit {
 public:
  explicit RateLimit(double max_hz) : period_sec_(max_hz > 0.0 ? 1.0 / max_hz : 0.0) {}

  bool admits(double stamp_sec) {
    const bool has_jumped_back = stamp_sec < due_sec_ - period_sec_;
    if (stamp_sec < due_sec_ && !has_jumped_back) return false;
    due_sec_ = has_jumped_back ? stamp_sec + period_sec_ : std::max(due_sec_ + period_sec_, stamp_sec);
    return true;
  }

 private:
  double period_sec_, due_sec_ = 0.0;  ///< stamps before `due_sec_` are not admitted
};

}  // namespace window_ingress::adapters
