#include "navigation/motion/disturbance_observer.hpp"

#include <algorithm>
#include <cmath>

namespace window_ingress::navigation {
namespace {

constexpr double kStrongestGustMps = 3.0;
// Limit: a vehicle that steers against gusts seems to answer slowly, and long smoothing would hide them.
constexpr double kMaxSmoothingSec = 0.3;
constexpr double kUsualGustMps = 0.06;
constexpr double kStoodSec = 1.0;    // prior: this long at rest without wind
constexpr double kEnoughM2ps = 0.2;  // a second of acceleration to 0.8 m/s
constexpr double kGustsM2ps = 0.9;   // squared: three times the turn by gusts of 0.3 m/s that last a second
constexpr double kMinShareGone = 0.6;
constexpr double kModelError = 0.15;  // fraction of the velocity change still commanded

Eigen::Vector3d verticalOf(const Eigen::Vector3d& velocity_mps) { return {0.0, 0.0, velocity_mps.z()}; }

Eigen::Vector3d clipped(const Eigen::Vector3d& velocity_mps, double limit_mps) {
  const double norm = velocity_mps.norm();
  return norm > limit_mps ? Eigen::Vector3d(velocity_mps * (limit_mps / norm)) : velocity_mps;
}

Eigen::Vector3d shortened(const Eigen::Vector3d& velocity_mps, double by_mps) {
  const double norm = velocity_mps.norm();
  return norm > by_mps ? Eigen::Vector3d(velocity_mps * (1.0 - by_mps / norm)) : Eigen::Vector3d(0, 0, 0);
}

}  // namespace

// Velocity from the setpoints alone.
Eigen::Vector3d DisturbanceObserver::modelVelocity() const {
  const Eigen::Vector3d& all_mps = response_.velocity();
  return {all_mps.x(), all_mps.y(), climbResponse().velocity().z()};
}

void DisturbanceObserver::reset() {
  restart();
  response_.reset();
  climb_.reset();
}

void DisturbanceObserver::restart() {
  response_.restart();
  climb_.restart();
  disturbance_mps_.setZero();
  gust_mps_.setZero();
  gusts_m2ps_.setZero();
  watched_sec_ = 0.0;
  directions_ = Directions();
}

void DisturbanceObserver::Directions::fade(double keep) {
  sec *= keep, said_m2ps *= keep;
  said_m *= keep, done_m *= keep, both_m2ps *= keep;
}

// Regression of the measured motion on the modelled one. A vehicle that only stands against wind shows no
// direction.
double DisturbanceObserver::turnedRad() const {
  const double sec = directions_.sec + kStoodSec;
  const double spread_m2ps = directions_.said_m2ps - std::norm(directions_.said_m) / sec;
  const std::complex<double> goes =
      directions_.both_m2ps - std::conj(directions_.said_m) * directions_.done_m / sec;
  if (spread_m2ps < kEnoughM2ps || std::abs(goes) < kMinShareGone * spread_m2ps) return 0.0;
  const double turned_rad = std::arg(goes);
  return turned_rad * turned_rad * spread_m2ps > kGustsM2ps ? turned_rad : 0.0;
}

void DisturbanceObserver::compareDirections(const Eigen::Vector3d& measured_mps, double dt_sec) {
  const Eigen::Vector3d& model_mps = response_.velocity();
  const std::complex<double> said(model_mps.x(), model_mps.y()), done(measured_mps.x(), measured_mps.y());
  directions_.fade(1.0 - share(dt_sec, kGustMemorySec));
  directions_.sec += dt_sec;
  directions_.said_m2ps += dt_sec * std::norm(said);
  directions_.said_m += dt_sec * said;
  directions_.done_m += dt_sec * done;
  directions_.both_m2ps += dt_sec * std::conj(said) * done;
}

// Until enough was measured, the usual gusts count as a prior.
Eigen::Matrix3d DisturbanceObserver::gusts() const {
  const Eigen::Matrix3d usual_m2ps = kUsualSec * kUsualGustMps * kUsualGustMps * Eigen::Matrix3d::Identity();
  return (gusts_m2ps_ + usual_m2ps) / watchedSec();
}

void DisturbanceObserver::update(const Eigen::Vector3d& measured_mps, const Eigen::Vector3d& commanded_mps,
                                 double dt_sec) {
  if (!measured_mps.allFinite() || !commanded_mps.allFinite() || !(dt_sec > 0.0)) return;
  response_.update(measured_mps, commanded_mps, dt_sec);
  climb_.update(verticalOf(measured_mps), verticalOf(commanded_mps), dt_sec);
  compareDirections(measured_mps, dt_sec);
  const Eigen::Vector3d model_mps = modelVelocity();
  const Eigen::Vector3d surprise_mps = measured_mps - model_mps - disturbance_mps_;
  disturbance_mps_ += share(dt_sec, kWindSec) * clipped(surprise_mps, max_wind_mps_);
  disturbance_mps_ = clipped(disturbance_mps_, max_wind_mps_);
  const double to_come_mps = (commanded_mps - model_mps).norm();
  const Eigen::Vector3d gust_mps =
      shortened(clipped(surprise_mps, kStrongestGustMps), kModelError * to_come_mps);
  gust_mps_ += share(dt_sec, std::min(response_.responseSec(), kMaxSmoothingSec)) * (gust_mps - gust_mps_);
  const double keep = 1.0 - share(dt_sec, kGustMemorySec);
  gusts_m2ps_ = keep * gusts_m2ps_ + dt_sec * gust_mps_ * gust_mps_.transpose();
  watched_sec_ = keep * watched_sec_ + dt_sec;
}

}  // namespace window_ingress::navigation
