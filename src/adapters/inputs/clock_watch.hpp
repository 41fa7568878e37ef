#pragma once

namespace window_ingress::adapters {

/// Detects a clock that jumps back: a looped bag, or a simulation that was reset.
class ClockWatch {
 public:
  /// \return true once for each jump back by more than 0.1 s
  bool jumpedBack(double now_sec) {
    const bool back = now_sec < last_sec_ - 0.1;
    last_sec_ = now_sec;
    return back;
  }

 private:
  double last_sec_ = 0.0;
};

}  // namespace window_ingress::adapters
