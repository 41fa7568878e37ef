#include "window_ingress/detection/stage_timer.hpp"

namespace window_ingress::detection {

const char* toString(Stage stage) {
  static constexpr std::array<const char*, kStages> kNames = {
      "track", "preprocess", "edges", "lines", "outlines", "candidates", "reference", "borders"};
  return kNames[static_cast<int>(stage)];
}

void StageTimer::begin() {
  sec_.fill(0.0);
  last_sec_ = clock_();
}

void StageTimer::done(Stage stage) {
  const double now_sec = clock_();
  sec_[static_cast<int>(stage)] += now_sec - last_sec_;
  last_sec_ = now_sec;
}

}  // namespace window_ingress::detection
