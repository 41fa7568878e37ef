#include "navigation/mission/mission_clock.hpp"

#include <algorithm>
#include <cmath>

namespace window_ingress::navigation {

void MissionClock::pass(double to_sec) {
  constexpr double kLongestStepSec = 1.0;
  if (!std::isfinite(to_sec)) return;
  const double jump_sec = to_sec - now_sec_ - std::clamp(to_sec - now_sec_, 0.0, kLongestStepSec);
  started_sec_ += jump_sec;
  since_sec_ += jump_sec;
  now_sec_ = to_sec;
}

}  // namespace window_ingress::navigation
