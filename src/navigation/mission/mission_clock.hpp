#pragma once

#include <algorithm>
#include <cmath>

namespace window_ingress::navigation {

/// Time of the mission and of its present state. A clock that jumps makes the inputs stale, but neither uses
/// up nor returns mission time.
class MissionClock {
 public:
  /// Ignores a time that is not finite.
  void pass(double to_sec) {
    constexpr double kLongestStepSec = 1.0;
    if (!std::isfinite(to_sec)) return;
    const double jump_sec = to_sec - now_sec_ - std::clamp(to_sec - now_sec_, 0.0, kLongestStepSec);
    started_sec_ += jump_sec;
    since_sec_ += jump_sec;
    now_sec_ = to_sec;
  }

  void startMission(double now_sec) { now_sec_ = started_sec_ = now_sec; }
  void enterState() { since_sec_ = now_sec_; }

  double nowSec() const { return now_sec_; }
  double inMissionSec() const { return now_sec_ - started_sec_; }
  double inStateSec() const { return now_sec_ - since_sec_; }

 private:
  double now_sec_ = 0.0, started_sec_ = 0.0, since_sec_ = 0.0;
};

}  // namespace window_ingress::navigation
