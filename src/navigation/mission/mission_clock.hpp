#pragma once

namespace window_ingress::navigation {

/// Time of the mission and of its present state. A clock that jumps makes the inputs stale, but uses up no
/// time of the mission and gives none back.
class MissionClock {
 public:
  void pass(double to_sec);  ///< not finite: ignored
  void startMission(double now_sec) { now_sec_ = started_sec_ = now_sec; }
  void enterState() { since_sec_ = now_sec_; }

  double nowSec() const { return now_sec_; }
  double inMissionSec() const { return now_sec_ - started_sec_; }
  double inStateSec() const { return now_sec_ - since_sec_; }

 private:
  double now_sec_ = 0.0, started_sec_ = 0.0, since_sec_ = 0.0;
};

}  // namespace window_ingress::navigation
