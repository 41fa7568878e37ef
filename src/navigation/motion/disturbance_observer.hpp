#pragma once

#include <Eigen/Core>
#include <complex>

#include "navigation/motion/response_estimator.hpp"
#include "window_ingress/navigation/navigator_params.hpp"

namespace window_ingress::navigation {

/// Velocity that wind adds: the measured velocity less that of a model of the vehicle under the same
/// commands, smoothed over `kWindSec`, for subtraction from the next command (P24). The model uses the
/// measured response (`ResponseEstimator`), because the lag of a slow vehicle, mistaken for wind, would be
/// corrected out of phase. A single outlier changes the estimate no more than the strongest wind would.
class DisturbanceObserver {
 public:
  static constexpr double kWindSec = 0.6, kGustMemorySec = 15.0;
  static constexpr double kUsualSec = 0.3;  ///< weight of the usual gusts, as measuring time
  DisturbanceObserver(const VehicleParams& vehicle, const ApproachParams& approach)
      : max_wind_mps_(approach.max_wind_mps), response_(vehicle.response_sec), climb_(vehicle.response_sec) {}

  /// Restarts the estimate: the present disturbance may not be wind.
  void restart();
  /// Restarts for another mission: forgets the measured response as well.
  void reset();
  /// \param measured_mps of the vehicle, \param commanded_mps the previous setpoint; both odom axes
  void update(const Eigen::Vector3d& measured_mps, const Eigen::Vector3d& commanded_mps, double dt_sec);
  /// Limited to `max_wind_mps`.
  const Eigen::Vector3d& disturbance() const { return disturbance_mps_; }
  /// Gusts: mean square of the velocity that neither `disturbance` nor the model's error explains, over
  /// `kGustMemorySec`. Times of large commands count as well, because gusts cause the largest commands.
  Eigen::Matrix3d gusts() const;
  /// Effective measuring time of `gusts`, with fading and prior [s].
  double watchedSec() const { return watched_sec_ + kUsualSec; }
  /// Angle between commanded and flown direction [rad], left positive, over `kGustMemorySec` of horizontal
  /// motion; 0 while command or motion is too small. Constant offsets (wind, velocity bias) cause none.
  double turnedRad() const;
  const ResponseEstimator& response() const { return response_; }
  /// Vertical response, which is slower in most vehicles; the response of all axes until it is measured.
  const ResponseEstimator& climbResponse() const { return climb_.isMeasured() ? climb_ : response_; }

 private:
  /// Time integrals of the horizontal velocity: modelled from the setpoints (said), and measured (done).
  struct Directions {
    double sec = 0.0, said_m2ps = 0.0;
    std::complex<double> said_m = 0.0, done_m = 0.0, both_m2ps = 0.0;
    void fade(double keep);
  };

  void compareDirections(const Eigen::Vector3d& measured_mps, double dt_sec);
  Eigen::Vector3d modelVelocity() const;

  double max_wind_mps_;
  ResponseEstimator response_, climb_;
  Eigen::Vector3d disturbance_mps_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d gust_mps_ = Eigen::Vector3d::Zero();  ///< smoothed, because noise moves no vehicle
  Directions directions_;
  Eigen::Matrix3d gusts_m2ps_ = Eigen::Matrix3d::Zero();
  double watched_sec_ = 0.0;  ///< fading
};

}  // namespace window_ingress::navigation
