/// A vehicle without a renderer, for tests of the navigator. The velocity follows the setpoint with lag and
/// delay. The window is seen while all of it is in the field of view. The estimate is the truth with errors
/// that grow with distance.
#pragma once

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <optional>
#include <random>

#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/navigation/navigator.hpp"
#include "without_glass.hpp"

namespace window_ingress::test {

struct PlantParams {
  double start_distance_m = 5.0;  ///< from the window's centre
  double off_axis_rad = 0.0;      ///< bearing of the start from the window's normal, left positive
  double facing_rad = 0.0;        ///< heading against the direction to the window
  double height_error_m = 0.3;    ///< of the start above the window's centre
  double lag_sec = 0.2;           ///< time constant of the velocity
  double acceleration_mps2 = 4.0;
  double camera_latency_sec = 0.05;
  double yaw_sigma_rad_at_4m = 0.01;     ///< at 4 m; grows with the square of the distance
  double position_sigma_m_at_4m = 0.02;  ///< at 4 m; grows with the square of the distance
  double odom_drift_mps = 0.0;           ///< along y
  double gust_mps = 0.0;                 ///< sideways wind velocity, slowly varying
  bool is_ambiguous = false;             ///< the sign is not trusted until the height has changed by 0.4 m
  unsigned seed = 1;
  geometry::OpeningSize opening{1.2, 1.0};
  openness::Openness openness = openness::Openness::kOpen;  ///< verdict reported to the navigator
};

class KinematicPlant {
 public:
  static constexpr double kStepSec = 1.0 / 30.0;

  explicit KinematicPlant(const PlantParams& params)
      : openness(params.openness), params_(params), random_(params.seed) {
    T_odom_window_ = geometry::makePose(geometry::yawRotation(0.7), Eigen::Vector3d(3.0, -2.0, 1.5));
    const double a = params.off_axis_rad;
    const Eigen::Vector3d start(-params.start_distance_m * std::cos(a), params.start_distance_m * std::sin(a),
                                params.height_error_m);
    position_ = T_odom_window_ * start;
    start_height_ = position_.z();
    const Eigen::Vector3d to_window = T_odom_window_.translation() - position_;
    yaw_ = std::atan2(to_window.y(), to_window.x()) + params.facing_rad;
  }

  navigation::NavigatorInput input() {
    navigation::NavigatorInput input;
    if (!hides_odometry) input.vehicle = vehicle();
    if (sees_ && time_ - sees_->stamp_sec < 2.0) input.target = sees_;
    input.image_stamp_sec = time_;
    return input;
  }

  void move(const navigation::Setpoint& setpoint) {
    queue_.push_back(setpoint);
    const auto command = queue_.front();
    if (queue_.size() > 3) queue_.pop_front();
    Eigen::Vector3d step = (command.velocity_odom_mps - velocity_) * (kStepSec / params_.lag_sec);
    const double most = params_.acceleration_mps2 * kStepSec;
    if (step.norm() > most) step *= most / step.norm();
    velocity_ += step;
    yaw_rate_ += (command.yaw_rate_radps - yaw_rate_) * (kStepSec / params_.lag_sec);
    const double gust = params_.gust_mps * std::sin(0.9 * time_ + params_.seed);
    carried_mps_ =
        T_odom_window_.linear().col(1) * gust + pushed_m_.cwiseMin(kPushM).cwiseMax(-kPushM) / kStepSec;
    pushed_m_ -= pushed_m_.cwiseMin(kPushM).cwiseMax(-kPushM);
    position_ += (velocity_ + carried_mps_) * kStepSec;
    yaw_ = geometry::wrapAngle(yaw_ + yaw_rate_ * kStepSec);
    time_ += kStepSec;
    drift_.y() += params_.odom_drift_mps * kStepSec;
    look();
    watch();
  }

  double time() const { return time_; }
  /// Body's centre in the window frame; x negative in front.
  Eigen::Vector3d offset() const { return T_odom_window_.inverse() * position_; }
  Eigen::Vector3d velocityInWindow() const { return T_odom_window_.linear().transpose() * velocity_; }
  bool hasHitTheWall() const { return hit_; }
  double furthestSideways() const { return furthest_; }
  double yaw() const { return yaw_; }
  const Eigen::Isometry3d& window() const { return T_odom_window_; }
  /// Moves the vehicle by this way within a few steps.
  void push(const Eigen::Vector3d& by_m) { pushed_m_ += by_m; }
  void shiftOdometry(const Eigen::Vector3d& by_m) { drift_ += by_m; }

  openness::Openness openness;
  bool hides_window = false;
  bool hides_odometry = false;
  bool z_points_down = false;  ///< in odometry, not in the setpoints

 private:
  navigation::VehicleState vehicle() const {
    navigation::VehicleState state;
    state.stamp_sec = time_;
    state.T_odom_base = geometry::makePose(geometry::yawRotation(yaw_), position_ + drift_);
    state.velocity_odom_mps = velocity_ + carried_mps_;
    if (z_points_down) {
      state.T_odom_base.translation().z() *= -1.0;
      state.velocity_odom_mps.z() *= -1.0;
    }
    return state;
  }

  bool isInView() const {
    const Eigen::Isometry3d T_base_odom =
        geometry::makePose(geometry::yawRotation(yaw_), position_).inverse();
    for (const auto& corner : geometry::openingCorners(params_.opening)) {
      const Eigen::Vector3d p = T_base_odom * (T_odom_window_ * corner) - Eigen::Vector3d(0.1, 0, 0);
      if (p.x() < 0.1 || std::abs(p.y() / p.x()) > std::tan(0.695) ||
          std::abs(p.z() / p.x()) > std::tan(0.56))
        return false;
    }
    return true;
  }

  void look() {
    if (hides_window || !isInView()) return;
    const double scale = std::pow(std::max(0.5, -offset().x()) / 4.0, 2);
    const double sigma_yaw = params_.yaw_sigma_rad_at_4m * scale,
                 sigma_m = params_.position_sigma_m_at_4m * scale;
    std::normal_distribution<double> gauss;
    navigation::TargetEstimate estimate;
    const Eigen::Vector3d error = sigma_m * Eigen::Vector3d(gauss(random_), gauss(random_), gauss(random_));
    has_changed_height_ = has_changed_height_ || std::abs(position_.z() - start_height_) > 0.4;
    estimate.sign_trusted = !params_.is_ambiguous || has_changed_height_;
    estimate.T_odom_window = T_odom_window_;
    estimate.T_odom_window.translation() += error + drift_;
    const double flip = estimate.sign_trusted ? 0.0 : 0.5 * (gauss(random_) > 0 ? 1 : -1);
    estimate.T_odom_window.linear() = geometry::yawRotation(0.7 + flip + sigma_yaw * gauss(random_));
    estimate.covariance.diagonal() << Eigen::Vector3d::Constant(sigma_m * sigma_m),
        Eigen::Vector3d::Constant(sigma_yaw * sigma_yaw);
    estimate.opening = params_.opening;
    estimate.openness.openness = openness;
    estimate.openness.reason = "as the plant says";
    estimate.stamp_sec = time_;
    pending_.push_back(estimate);
    while (!pending_.empty() && pending_.front().stamp_sec <= time_ - params_.camera_latency_sec) {
      sees_ = pending_.front();
      pending_.pop_front();
    }
  }

  /// The wall is a slab 0.2 m thick behind the window's plane; the body a box that turns with the heading.
  void watch() {
    const double heading = geometry::wrapAngle(yaw_ - 0.7);
    const Eigen::Vector3d p = offset();
    furthest_ = std::max(furthest_, std::abs(p.y()));
    const double half = 0.25 * (std::abs(std::cos(heading)) + std::abs(std::sin(heading)));
    if (p.x() + half < 0.0 || p.x() - half > 0.2) return;
    const bool clear = std::abs(p.y()) + half < params_.opening.width_m / 2 &&
                       std::abs(p.z()) + 0.12 < params_.opening.height_m / 2;
    if (!clear) hit_ = true;
  }

  PlantParams params_;
  std::mt19937 random_;
  Eigen::Isometry3d T_odom_window_;
  static constexpr double kPushM = 0.03;  ///< in a step
  Eigen::Vector3d carried_mps_ = Eigen::Vector3d::Zero(), pushed_m_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero(), velocity_ = Eigen::Vector3d::Zero(),
                  drift_ = Eigen::Vector3d::Zero();
  double yaw_ = 0.0, yaw_rate_ = 0.0, time_ = 100.0, start_height_ = 0.0, furthest_ = 0.0;
  bool has_changed_height_ = false, hit_ = false;
  std::deque<navigation::Setpoint> queue_;
  std::deque<navigation::TargetEstimate> pending_;
  std::optional<navigation::TargetEstimate> sees_;
};

struct FlownMission {
  navigation::NavigatorOutput last;
  double duration_sec = 0.0;
  bool hit = false;
  Eigen::Vector3d end_offset = Eigen::Vector3d::Zero();
  std::vector<navigation::State> states;  ///< in order, without repetition
};

/// Flies until the mission has ended. `disturb` sees every step before the navigator does.
inline FlownMission fly(KinematicPlant& plant, navigation::Navigator& navigator, double most_sec = 120.0,
                        const std::function<void(double, const navigation::NavigatorOutput&)>& disturb = {}) {
  FlownMission mission;
  const double start = plant.time();
  navigator.start(plant.input(), plant.time());
  while (plant.time() - start < most_sec) {
    if (disturb) disturb(plant.time() - start, mission.last);
    mission.last = navigator.step(plant.input(), plant.time());
    if (mission.states.empty() || mission.states.back() != mission.last.state)
      mission.states.push_back(mission.last.state);
    plant.move(mission.last.setpoint);
    if (isEnd(mission.last.state) || plant.hasHitTheWall()) break;
  }
  mission.duration_sec = plant.time() - start;
  mission.hit = plant.hasHitTheWall();
  mission.end_offset = plant.offset();
  return mission;
}

}  // namespace window_ingress::test
