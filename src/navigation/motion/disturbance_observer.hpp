#pragma once

#include <Eigen/Core>
#include <complex>

#include "navigation/motion/response_estimator.hpp"
#include "window_ingress/navigation/navigator_params.hpp"

namespace window_ingress::navigation {

/// How far the vehicle's velocity stays away from what was commanded, in wind: the measured velocity less
/// that of a model of the vehicle under the same commands, smoothed over `kWindSec`. To be taken
/// off the next command (P24). The model answers as fast as the vehicle was seen to (`ResponseEstimator`):
/// the lag of a slow vehicle taken for wind would be steered against out of phase. One wild sample moves it
/// no more than the strongest wind would.
class DisturbanceObserver {
 public:
  static constexpr double kWindSec = 0.6, kGustMemorySec = 15.0;
  static constexpr double kUsualSec = 0.3;  ///< what gusts usually are counts as if watched for so long
  DisturbanceObserver(const VehicleParams& vehicle, const ApproachParams& approach)
      : max_wind_mps_(approach.max_wind_mps), response_(vehicle.response_sec), climb_(vehicle.response_sec) {}

  /// What moves the vehicle now is not known to be wind.
  void restart();
  /// Another mission: how the vehicle answers is not known, either.
  void reset();
  /// \param measured_mps of the vehicle, \param commanded_mps the setpoint before; both odom axes
  void update(const Eigen::Vector3d& measured_mps, const Eigen::Vector3d& commanded_mps, double dt_sec);
  /// At most `max_wind_mps` long.
  const Eigen::Vector3d& disturbance() const { return disturbance_mps_; }
  /// Mean square of what remains beyond it and beyond what the model may err by, over `kGustMemorySec`:
  /// gusts. Whatever the vehicle is told meanwhile counts, for it is told most while gusts carry it off.
  Eigen::Matrix3d gusts() const;
  /// Over how long, fading as they do, what is usual included [s].
  double watchedSec() const { return watched_sec_ + kUsualSec; }
  /// How far the vehicle goes beside what it is told, left positive, over `kGustMemorySec` of motion in the
  /// plane; 0 as long as it was told, or moved, too little to tell [rad]. What is there whatever it is told
  /// (wind, a biased velocity) turns nothing.
  double turnedRad() const;
  const ResponseEstimator& response() const { return response_; }
  /// Of up and down alone, which most vehicles answer later; of all axes until it has shown.
  const ResponseEstimator& climbResponse() const { return climb_.isMeasured() ? climb_ : response_; }

 private:
  /// What the setpoints alone would have given, and what was measured, both in the plane: sums over the time.
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
  Eigen::Vector3d gust_mps_ = Eigen::Vector3d::Zero();  ///< smoothed: noise carries nobody away
  Directions directions_;
  Eigen::Matrix3d gusts_m2ps_ = Eigen::Matrix3d::Zero();
  double watched_sec_ = 0.0;  ///< fading
};

}  // namespace window_ingress::navigation
