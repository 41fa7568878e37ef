#include "window_ingress/estimation/sender_clock.hpp"

#include <algorithm>
#include <cmath>

namespace window_ingress::estimation {
namespace {

constexpr double kFadesSecPerSec = 2e-4;  // more than any quartz drifts, little in a flight

}  // namespace

double SenderClock::atReceiver(double stamp_sec, double arrival_sec) {
  const double ahead_sec = stamp_sec - arrival_sec;
  if (!std::isfinite(ahead_sec) || ahead_sec > kMaxSec) return stamp_sec;
  const double elapsed_sec = std::clamp(arrival_sec - arrival_sec_, 0.0, 1.0);
  arrival_sec_ = arrival_sec;
  ahead_sec_ = std::max({0.0, ahead_sec_ - kFadesSecPerSec * elapsed_sec, ahead_sec});
  return stamp_sec - aheadSec();
}

}  // namespace window_ingress::estimation
