#pragma once

#include <algorithm>
#include <cmath>

namespace window_ingress::estimation {

/// Corrects stamps from a clock that is ahead. Nothing is measured after it has arrived, so a stamp ahead of
/// its arrival shows such a clock (PX4's behind MAVROS were 84 to 164 ms ahead). The largest lead seen is
/// subtracted from every stamp; it decays slowly, because clocks drift.
class SenderClock {
 public:
  /// \return the stamp in the receiver's clock; a stamp or arrival that is not finite changes nothing
  double atReceiver(double stamp_sec, double arrival_sec) {
    const double ahead_sec = stamp_sec - arrival_sec;
    if (!std::isfinite(ahead_sec) || ahead_sec > kMaxSec) return stamp_sec;
    const double elapsed_sec = std::clamp(arrival_sec - arrival_sec_, 0.0, 1.0);
    arrival_sec_ = arrival_sec;
    ahead_sec_ = std::max({0.0, ahead_sec_ - kFadesSecPerSec * elapsed_sec, ahead_sec});
    return stamp_sec - aheadSec();
  }
  /// Amount that is subtracted; 0 up to `kUsualSec`, which the ticks of a clock explain.
  double aheadSec() const { return ahead_sec_ > kUsualSec ? ahead_sec_ : 0.0; }
  void clear() { *this = SenderClock(); }

  static constexpr double kUsualSec = 0.02, kMaxSec = 0.5;

 private:
  static constexpr double kFadesSecPerSec = 2e-4;  ///< more than any quartz drifts, little in a flight
  double ahead_sec_ = 0.0, arrival_sec_ = 0.0;
};

}  // namespace window_ingress::estimation
