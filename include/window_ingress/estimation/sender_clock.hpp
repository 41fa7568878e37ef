#pragma once

namespace window_ingress::estimation {

/// Nothing is measured after it has arrived: stamps that are ahead of their arrival come from a clock that is
/// ahead (PX4's behind MAVROS were seen 84 to 164 ms ahead of their arrival). The most that was seen is taken
/// off every stamp. It fades slowly, since clocks drift.
class SenderClock {
 public:
  /// \return the stamp by the receiver's clock; a stamp or arrival that is not finite changes nothing
  double atReceiver(double stamp_sec, double arrival_sec);
  /// What is taken off: 0 up to `kUsualSec`, which a clock that comes in ticks explains.
  double aheadSec() const { return ahead_sec_ > kUsualSec ? ahead_sec_ : 0.0; }
  void clear() { *this = SenderClock(); }

  static constexpr double kUsualSec = 0.02, kMaxSec = 0.5;

 private:
  double ahead_sec_ = 0.0, arrival_sec_ = 0.0;
};

}  // namespace window_ingress::estimation
