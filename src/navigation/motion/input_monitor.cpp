#include "navigation/motion/input_monitor.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "navigation/motion/moving_target.hpp"
#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/navigation/relative_state.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::navigation {
namespace {

/// Empty if the stamp is recent and not in the future.
std::string ageFault(const char* what, double stamp_sec, double now_sec, double max_age_sec,
                     double max_future_sec) {
  const double age_sec = now_sec - stamp_sec;
  if (!std::isfinite(age_sec)) return formatted("%s: stamp is not finite", what);
  if (age_sec > max_age_sec) return formatted("%s %.2f s old", what, age_sec);
  if (age_sec < -max_future_sec) return formatted("%s: stamp is %.2f s in the future", what, -age_sec);
  return "";
}

constexpr double kFarAwayM = 1e5;
constexpr double kFasterThanAnyMps = 20.0;
constexpr double kMoving = 0.1;       // [m/s], [rad/s]
constexpr double kRepeatsSec = 0.25;  // limit for a repeated sample that claims motion
constexpr double kDeadTimeSec = 0.5;  // a vehicle commanded to move must have moved after this time
constexpr double kTrustedYawJumpRad = 0.35;
constexpr double kJumpPersistSec = 0.5;  // a window is believed at its new place after this time
constexpr double kMaxTiltRad = 0.26;     // a window that leans more is rejected
constexpr double kPeriodWeight = 0.2;    // of the newest period between two images

double headingOf(const TargetEstimate& target) { return geometry::yawOf(target.T_odom_window.linear()); }

bool isPositive(const Eigen::Matrix<double, 6, 6>& covariance) {
  constexpr double kAlike = 1e-6;
  if (!covariance.allFinite()) return false;
  Eigen::Matrix4d upright;  // x, y, z, yaw
  upright << covariance.topLeftCorner<3, 3>(), covariance.topRightCorner<3, 1>(),
      covariance.bottomLeftCorner<1, 3>(), covariance(5, 5);
  const bool is_symmetric = upright.isApprox(upright.transpose(), kAlike);
  return is_symmetric && upright.llt().info() == Eigen::Success;  // llt reads one half only
}

bool hasUsableMotion(const TargetEstimate& target) {
  constexpr double kFastestWindowMps = 2.0, kLongestSec = 1000.0;
  const auto isWithin = [](double value, double most) { return value >= 0.0 && value <= most; };
  const estimation::TargetMotion& motion = target.motion;
  const double velocity_mps = motion.velocity_odom_mps.stableNorm();
  if (motion.model.stands()) return isWithin(motion.model.speed_mps, 0.0) && isWithin(velocity_mps, 0.0);
  return isWithin(motion.model.speed_mps, kFastestWindowMps) && isWithin(velocity_mps, kFastestWindowMps) &&
         isWithin(motion.velocity_sigma_mps, kFastestWindowMps) && motion.model.time_sec > 0.0 &&
         motion.model.time_sec <= kLongestSec && std::isfinite(target.pose_stamp_sec);
}

}  // namespace

std::string faultOf(const VehicleState& vehicle) {
  if (!std::isfinite(vehicle.stamp_sec)) return "odometry: stamp is not finite";
  if (!geometry::isValidPose(vehicle.T_odom_base)) return "odometry: pose is not finite or not a rotation";
  if (!vehicle.velocity_odom_mps.allFinite()) return "odometry: velocity is not finite";
  const double position_m = vehicle.T_odom_base.translation().stableNorm();
  if (position_m > kFarAwayM)
    return formatted("odometry: %.3g m from its origin, limit %.3g m", position_m, kFarAwayM);
  const double speed_mps = vehicle.velocity_odom_mps.stableNorm();
  if (speed_mps > kFasterThanAnyMps)
    return formatted("odometry: speed %.3g m/s, limit %.3g m/s", speed_mps, kFasterThanAnyMps);
  return "";
}

std::string faultOf(const TargetEstimate& target) {
  if (!std::isfinite(target.stamp_sec)) return "window: stamp is not finite";
  if (!geometry::isValidPose(target.T_odom_window)) return "window: pose is not finite or not a rotation";
  if (target.T_odom_window.translation().stableNorm() > kFarAwayM)
    return formatted("window: farther away than the limit of %.3g m", kFarAwayM);
  const double tilt_rad = std::acos(std::clamp(target.T_odom_window.linear()(2, 2), -1.0, 1.0));
  if (tilt_rad > kMaxTiltRad) return formatted("window: leans by %.2f rad", tilt_rad);
  if (!isPositive(target.covariance)) return "window: covariance unknown";
  if (!hasUsableMotion(target)) return "window: implausible motion";
  const auto& opening = target.opening;
  const bool has_size =
      opening.width_m > 0.0 && opening.height_m > 0.0 && opening.width_m < 20.0 && opening.height_m < 20.0;
  return has_size ? "" : "window: size of the opening unknown";
}

// The window's pose in odom belongs to the time of its image.
TargetEstimate InputMonitor::inSmooth(TargetEstimate target) const {
  const Eigen::Isometry3d T_smooth_odom = odometry_.T_smooth_odom(target.stamp_sec);
  const Eigen::Matrix3d& R = T_smooth_odom.linear();
  target.T_odom_window = T_smooth_odom * target.T_odom_window;
  target.covariance.topLeftCorner<3, 3>() = R * target.covariance.topLeftCorner<3, 3>() * R.transpose();
  target.covariance.topRightCorner<3, 3>() = R * target.covariance.topRightCorner<3, 3>();
  target.covariance.bottomLeftCorner<3, 3>() = target.covariance.topRightCorner<3, 3>().transpose();
  target.motion.velocity_odom_mps = R * target.motion.velocity_odom_mps;
  return target;
}

Situation InputMonitor::judge(const NavigatorInput& input, double now_sec) {
  Situation situation;
  judgeClock(now_sec, situation);
  judgeVehicle(input, situation);
  judgeTarget(input, situation);
  judgeImage(input, situation);
  situation.camera_fault = input.camera_fault;
  if (input.camera && input.camera_fault.empty()) situation.camera_fault = faultOf(*input.camera);
  if (!input.passed_on) situation.setpoint_fault = "setpoints are not passed on: the guard is silent";
  return situation;
}

void InputMonitor::judgeClock(double now_sec, Situation& situation) {
  situation.now_sec = now_sec;
  if (!std::isfinite(now_sec)) return;
  const double dt_sec = last_now_sec_ ? now_sec - *last_now_sec_ : 0.0;
  if (dt_sec < -params_.max_future_sec) {
    reset();
    situation.vehicle_jumped = true;
  }
  situation.dt_sec = std::clamp(dt_sec, 0.0, 0.2);
  last_now_sec_ = now_sec;
}

void InputMonitor::judgeVehicle(const NavigatorInput& input, Situation& situation) {
  situation.vehicle_fault = input.vehicle ? faultOf(*input.vehicle) : "no odometry";
  if (situation.vehicle_fault.empty() && situation.vehicle_jumped)
    situation.vehicle_fault = "the clock jumped back";
  if (!situation.vehicle_fault.empty()) return;
  const bool is_newer = !vehicle_ || input.vehicle->stamp_sec > vehicle_->stamp_sec;
  const VehicleState sample = is_newer ? *input.vehicle : *vehicle_;
  situation.vehicle_fault = takeSample(sample, is_newer, situation.now_sec);
  if (!situation.vehicle_fault.empty()) return;
  if (is_newer) smooth_ = odometry_.add(sample);
  situation.odometry = {odometry_.disagreementMps(), odometry_.unexplainedMps(), odometry_.driftMPerSqrtSec(),
                        odometry_.shiftM(), odometry_.isBiasKnown()};
  if (!smooth_) {
    situation.vehicle_fault = "odometry continued at another place after a gap";
    situation.vehicle_jumped = true;
    not_before_sec_ = sample.stamp_sec;
    target_.reset();
    moved_target_.reset();
    return;
  }
  VehicleState now = *smooth_;
  now.velocity_odom_mps = odometry_.unbiased(*smooth_);
  now.T_odom_base.translation() +=
      now.velocity_odom_mps * std::max(0.0, situation.now_sec - vehicle_->stamp_sec);
  situation.vehicle = now;
}

std::string InputMonitor::takeSample(const VehicleState& sample, bool is_newer, double now_sec) {
  const std::string age =
      ageFault("odometry", sample.stamp_sec, now_sec, params_.max_vehicle_age_sec, params_.max_future_sec);
  if (!age.empty()) return age;
  if (is_newer) arrived_sec_ = now_sec;
  const double missing_sec = now_sec - arrived_sec_;
  if (missing_sec > kMissingSec) return formatted("odometry: none for %.2f s", missing_sec);
  if (is_newer) watchRepeats(sample);
  vehicle_ = sample;
  if (is_stuck_) return formatted("odometry stuck for %.2f s", sample.stamp_sec - unchanged_since_sec_);
  if (const std::string empty = empty_twist_.look(sample); !empty.empty()) return "odometry: its " + empty;
  return "";
}

void InputMonitor::told(const Setpoint& setpoint, double now_sec) {
  const bool moves = std::max(setpoint.velocity_odom_mps.norm(), std::abs(setpoint.yaw_rate_radps)) > kMoving;
  if (!moves || !std::isfinite(now_sec))
    told_to_move_sec_.reset();
  else if (!told_to_move_sec_)
    told_to_move_sec_ = now_sec;
}

// A working sensor's noise never repeats itself, and a moving vehicle changes its place.
void InputMonitor::watchRepeats(const VehicleState& vehicle) {
  const bool repeats = vehicle_ && vehicle.T_odom_base.matrix() == vehicle_->T_odom_base.matrix() &&
                       vehicle.velocity_odom_mps == vehicle_->velocity_odom_mps;
  if (!repeats) unchanged_since_sec_ = vehicle.stamp_sec;
  const double for_sec = vehicle.stamp_sec - unchanged_since_sec_;
  const bool says_to_move = vehicle.velocity_odom_mps.norm() > kMoving;
  const bool ought_to_move = told_to_move_sec_ && vehicle.stamp_sec - *told_to_move_sec_ > kDeadTimeSec;
  is_stuck_ = repeats && (is_stuck_ || (says_to_move && for_sec > kRepeatsSec) ||
                          (ought_to_move && for_sec > kDeadTimeSec));
}

void InputMonitor::judgeTarget(const NavigatorInput& input, Situation& situation) {
  const auto ageFaultOf = [&](const TargetEstimate& target) {
    return ageFault("window", target.stamp_sec, situation.now_sec, params_.max_target_age_sec,
                    params_.max_future_sec);
  };
  situation.target_fault = "no window seen";
  if (input.target) {
    std::string fault = faultOf(*input.target);
    if (fault.empty()) fault = ageFaultOf(*input.target);
    if (fault.empty() && input.target->stamp_sec <= not_before_sec_)
      fault = "window: measured before odometry jumped";
    if (fault.empty())
      situation.target_is_new = acceptTarget(inSmooth(*input.target), situation.now_sec);
    else
      situation.target_fault = fault;
  }
  if (!target_ || !ageFaultOf(*target_).empty()) return;
  situation.target = ahead(*target_, situation.now_sec);
  situation.target_fault.clear();
}

bool InputMonitor::acceptTarget(const TargetEstimate& target, double now_sec) {
  if (target_ && target.stamp_sec <= target_->stamp_sec) return false;
  const bool has_moved = target_ && distanceBetween(target, *target_) > params_.max_target_jump_m;
  const bool has_turned =
      target_ && target.sign_trusted && target_->sign_trusted &&
      std::abs(geometry::wrapAngle(headingOf(target) - headingOf(*target_))) > kTrustedYawJumpRad;
  if (has_moved || has_turned) {
    const bool stays_there = moved_target_ &&
                             target.stamp_sec - moved_target_->stamp_sec <= params_.max_target_age_sec &&
                             distanceBetween(target, *moved_target_) < params_.max_target_jump_m;
    if (!stays_there) moved_since_sec_ = now_sec;
    moved_target_ = target;
    if (now_sec - moved_since_sec_ < kJumpPersistSec) return false;
  }
  moved_target_.reset();
  target_ = target;
  return true;
}

void InputMonitor::judgeImage(const NavigatorInput& input, Situation& situation) {
  situation.image_fault = "no image searched so far";
  if (!input.image_stamp_sec) return;
  situation.image_fault = ageFault("last image in window_pose", *input.image_stamp_sec, situation.now_sec,
                                   params_.max_image_age_sec, params_.max_future_sec);
  situation.image_period_sec = image_period_sec_;
  if (!situation.image_fault.empty() || image_stamp_sec_ == input.image_stamp_sec) return;
  const double period_sec = image_stamp_sec_ ? *input.image_stamp_sec - *image_stamp_sec_ : 0.0;
  image_stamp_sec_ = input.image_stamp_sec;
  if (!(period_sec > 0.0 && period_sec < params_.max_image_age_sec)) return;
  image_period_sec_ += (image_period_sec_ > 0.0 ? kPeriodWeight : 1.0) * (period_sec - image_period_sec_);
  situation.image_period_sec = image_period_sec_;
}

}  // namespace window_ingress::navigation
