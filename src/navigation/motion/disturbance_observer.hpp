#pragma once

#include <Eigen/Core>
#include <algorithm>
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
  void restart() {
    response_.restart();
    climb_.restart();
    disturbance_mps_.setZero();
    gust_mps_.setZero();
    gusts_m2ps_.setZero();
    watched_sec_ = 0.0;
    directions_ = Directions();
    climbs_ = Climbs();
  }
  /// Restarts for another mission: forgets the measured response as well.
  void reset() {
    restart();
    response_.reset();
    climb_.reset();
    answer_ = Answer();
  }

  /// \param measured_mps of the vehicle, \param commanded_mps the previous setpoint; both odom axes
  void update(const Eigen::Vector3d& measured_mps, const Eigen::Vector3d& commanded_mps, double dt_sec) {
    if (!measured_mps.allFinite() || !commanded_mps.allFinite() || !(dt_sec > 0.0)) return;
    response_.update(measured_mps, commanded_mps, dt_sec);
    climb_.update({0.0, 0.0, measured_mps.z()}, {0.0, 0.0, commanded_mps.z()}, dt_sec);
    const Eigen::Vector3d& all_mps = response_.velocity();
    const double keep = 1.0 - share(dt_sec, kGustMemorySec);
    directions_.add({all_mps.x(), all_mps.y()}, {measured_mps.x(), measured_mps.y()}, dt_sec, keep);
    const Eigen::Vector3d model_mps(all_mps.x(), all_mps.y(), climbResponse().velocity().z());
    climbs_.add(model_mps.z(), measured_mps.z(), dt_sec, keep);
    answer_.add(commanded_mps, measured_mps, dt_sec, keep);
    const Eigen::Vector3d surprise_mps = measured_mps - model_mps - disturbance_mps_;
    disturbance_mps_ += share(dt_sec, kWindSec) * clipped(surprise_mps, max_wind_mps_);
    disturbance_mps_ = clipped(disturbance_mps_, max_wind_mps_);
    const double to_come_mps = (commanded_mps - model_mps).norm();
    const Eigen::Vector3d gust_mps =
        shortened(clipped(surprise_mps, kStrongestGustMps), kModelError * to_come_mps);
    gust_mps_ += share(dt_sec, std::min(response_.responseSec(), kMaxSmoothingSec)) * (gust_mps - gust_mps_);
    gusts_m2ps_ = keep * gusts_m2ps_ + dt_sec * gust_mps_ * gust_mps_.transpose();
    watched_sec_ = keep * watched_sec_ + dt_sec;
  }

  /// Limited to `max_wind_mps`.
  const Eigen::Vector3d& disturbance() const { return disturbance_mps_; }
  /// Gusts: mean square of the velocity that neither `disturbance` nor the model's error explains, over
  /// `kGustMemorySec`. Times of large commands count as well, because gusts cause the largest commands. Until
  /// enough was measured, the usual gusts count as a prior.
  Eigen::Matrix3d gusts() const {
    const Eigen::Matrix3d usual_m2ps =
        kUsualSec * kUsualGustMps * kUsualGustMps * Eigen::Matrix3d::Identity();
    return (gusts_m2ps_ + usual_m2ps) / watchedSec();
  }
  /// Effective measuring time of `gusts`, with fading and prior [s].
  double watchedSec() const { return watched_sec_ + kUsualSec; }
  /// Angle between commanded and flown direction [rad], left positive, over `kGustMemorySec` of horizontal
  /// motion; 0 while command or motion is too small. Constant offsets (wind, velocity bias) cause none.
  double turnedRad() const { return directions_.turnedRad(); }
  /// Whether the vehicle sinks where it is told to climb, and the reverse, over `kGustMemorySec`: a
  /// downdraught that carries it so far is no condition to fly in either.
  bool isUpsideDown() const { return climbs_.areReversed(); }
  /// Whether the vehicle has stood since the first command after `reset` although much was asked of it within
  /// `kGustMemorySec`. A steady velocity bias is no motion.
  bool ignoresSetpoints() const { return !answer_.has_moved && answer_.said_m2ps > Answer::kEnoughM2ps; }
  const ResponseEstimator& response() const { return response_; }
  /// Vertical response, which is slower in most vehicles; the response of all axes until it is measured.
  const ResponseEstimator& climbResponse() const { return climb_.isMeasured() ? climb_ : response_; }

 private:
  static constexpr double kStrongestGustMps = 3.0, kUsualGustMps = 0.06;
  /// Limit: a vehicle that steers against gusts seems to answer slowly, and long smoothing would hide them.
  static constexpr double kMaxSmoothingSec = 0.3;
  static constexpr double kModelError = 0.15;  ///< fraction of the velocity change still commanded

  /// Regression of the measured horizontal velocity (done) on the one modelled from the setpoints (said), by
  /// fading time integrals. A vehicle that only stands against wind shows no direction.
  struct Directions {
    static constexpr double kStoodSec = 1.0;    ///< prior: this long at rest without wind
    static constexpr double kEnoughM2ps = 0.2;  ///< a second of acceleration to 0.8 m/s
    /// Squared: three times the turn by gusts of 0.3 m/s that last a second.
    static constexpr double kGustsM2ps = 0.9;
    static constexpr double kMinShareGone = 0.6;

    void add(std::complex<double> said, std::complex<double> done, double dt_sec, double keep) {
      sec = keep * sec + dt_sec;
      said_m2ps = keep * said_m2ps + dt_sec * std::norm(said);
      said_m = keep * said_m + dt_sec * said;
      done_m = keep * done_m + dt_sec * done;
      both_m2ps = keep * both_m2ps + dt_sec * std::conj(said) * done;
    }
    double turnedRad() const {
      const double all_sec = sec + kStoodSec;
      const double spread_m2ps = said_m2ps - std::norm(said_m) / all_sec;
      const std::complex<double> goes = both_m2ps - std::conj(said_m) * done_m / all_sec;
      if (spread_m2ps < kEnoughM2ps || std::abs(goes) < kMinShareGone * spread_m2ps) return 0.0;
      const double turned_rad = std::arg(goes);
      return turned_rad * turned_rad * spread_m2ps > kGustsM2ps ? turned_rad : 0.0;
    }

    double sec = 0.0, said_m2ps = 0.0;
    std::complex<double> said_m = 0.0, done_m = 0.0, both_m2ps = 0.0;
  };

  /// The same for the vertical, with its sign alone, and with the offset: a steady climb has no other part.
  struct Climbs {
    static constexpr double kEnoughM2ps = 0.2;  ///< 2.3 s of 0.3 m/s, or 9 s of 0.15 m/s

    void add(double said, double done, double dt_sec, double keep) {
      said_m2ps = keep * said_m2ps + dt_sec * said * said;
      both_m2ps = keep * both_m2ps + dt_sec * said * done;
    }
    bool areReversed() const {
      return said_m2ps > kEnoughM2ps && both_m2ps < -Directions::kMinShareGone * said_m2ps;
    }

    double said_m2ps = 0.0, both_m2ps = 0.0;
  };

  /// How much was asked of the vehicle, and whether it has moved since the first command.
  struct Answer {
    static constexpr double kEnoughM2ps = 2.0;  ///< 4 s of 0.7 m/s, or 15 s of 0.4 m/s
    static constexpr double kMovesMps = 0.15, kNoiseSec = 0.5, kBiasSec = 3.0;

    void add(const Eigen::Vector3d& said, const Eigen::Vector3d& done, double dt_sec, double keep) {
      if (said_m2ps == 0.0) now_mps = usual_mps = done;
      now_mps += share(dt_sec, kNoiseSec) * (done - now_mps);
      usual_mps += share(dt_sec, kBiasSec) * (done - usual_mps);
      has_moved = has_moved || (now_mps - usual_mps).norm() > kMovesMps;
      said_m2ps = keep * said_m2ps + dt_sec * said.squaredNorm();
    }

    double said_m2ps = 0.0;
    Eigen::Vector3d now_mps = Eigen::Vector3d::Zero(), usual_mps = Eigen::Vector3d::Zero();
    bool has_moved = false;
  };

  static Eigen::Vector3d clipped(const Eigen::Vector3d& velocity_mps, double limit_mps) {
    const double norm = velocity_mps.norm();
    return norm > limit_mps ? Eigen::Vector3d(velocity_mps * (limit_mps / norm)) : velocity_mps;
  }
  static Eigen::Vector3d shortened(const Eigen::Vector3d& velocity_mps, double by_mps) {
    const double norm = velocity_mps.norm();
    return norm > by_mps ? Eigen::Vector3d(velocity_mps * (1.0 - by_mps / norm)) : Eigen::Vector3d(0, 0, 0);
  }

  double max_wind_mps_;
  ResponseEstimator response_, climb_;
  Eigen::Vector3d disturbance_mps_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d gust_mps_ = Eigen::Vector3d::Zero();  ///< smoothed, because noise moves no vehicle
  Directions directions_;
  Climbs climbs_;
  Answer answer_;
  Eigen::Matrix3d gusts_m2ps_ = Eigen::Matrix3d::Zero();
  double watched_sec_ = 0.0;  ///< fading
};

}  // namespace window_ingress::navigation
