#pragma once

namespace window_ingress::adapters {

/// Notices that the clock went back, as it does when a bag is looped or a simulation reset.
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
