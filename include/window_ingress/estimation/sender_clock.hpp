#pragma once

namespace window_ingress::estimation {

/// Corrects stamps from a clock that is ahead. Nothing is measured after it has arrived, so a stamp ahead of
/// its arrival shows such a clock (PX4's behind MAVROS were 84 to 164 ms ahead). The largest lead seen is
/// subtracted from every stamp; it decays slowly, because clocks drift.
class SenderClock {
 public:
  /// \return the stamp in the receiver's clock; a stamp or arrival that is not finite changes nothing
  double atReceiver(double stamp_sec, double arrival_sec);
  /// Amount that is subtracted; 0 up to `kUsualSec`, which the ticks of a clock explain.
  double aheadSec() const { return ahead_sec_ > kUsualSec ? ahead_sec_ : 0.0; }
  void clear() { *this = SenderClock(); }

  static constexpr double kUsualSec = 0.02, kMaxSec = 0.5;

 private:
  double ahead_sec_ = 0.0, arrival_sec_ = 0.0;
};

}  // namespace window_ingress::estimation
