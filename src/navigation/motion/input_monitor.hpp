/// Checks every input before the vehicle flies by it: age, order, finite numbers, jumps.
#pragma once

#include <optional>
#include <string>

#include "navigation/motion/continuous_odometry.hpp"
#include "window_ingress/navigation/empty_twist.hpp"
#include "window_ingress/navigation/navigator.hpp"
#include "window_ingress/navigation/navigator_params.hpp"

namespace window_ingress::navigation {

/// How far odometry's position and velocity agree (`ContinuousOdometry`).
struct OdometryQuality {
  double disagreement_mps = 0.0;      ///< recently, between position and velocity
  double unexplained_mps = 0.0;       ///< difference that no steady velocity bias explains
  double drift_m_per_sqrt_sec = 0.0;  ///< measured drift of position against velocity
  double shift_m = 0.0;               ///< total correction of the positions so far
  bool is_bias_known = false;         ///< the velocity's bias has been measured
};

/// What is known in one step, in the jump-free frame (`ContinuousOdometry`): the checked input, and what was
/// measured in flight so far. A value that is set can be used; each missing value has a fault text with
/// numbers.
struct Situation {
  double now_sec = 0.0;
  double dt_sec = 0.0;                  ///< since the previous step, limited to 0 .. 0.2 s
  std::optional<VehicleState> vehicle;  ///< predicted to now
  std::string vehicle_fault;
  bool vehicle_jumped = false;  ///< all places in the old odometry frame are void
  std::optional<TargetEstimate> target;
  std::string target_fault;
  bool target_is_new = false;     ///< from another image than the previous step's target
  std::string setpoint_fault;     ///< why setpoints do not reach the autopilot; empty if they do
  std::string image_fault;        ///< empty if images come
  std::string camera_fault;       ///< why no image can give a pose; empty if there is no reason
  double image_period_sec = 0.0;  ///< recent mean period of the searched images; 0: not known yet
  OdometryQuality odometry;
  Eigen::Vector3d told_odom_mps = Eigen::Vector3d::Zero();  ///< velocity last commanded
  double pending_yaw_rad = 0.0;                             ///< commanded, but not turned yet
  Eigen::Vector3d wind_odom_mps = Eigen::Vector3d::Zero();  ///< velocity that wind adds
  Eigen::Matrix3d gusts_odom = Eigen::Matrix3d::Zero();     ///< mean square of gusts [m^2/s^2]
  double gusts_watched_sec = 0.0;                           ///< duration of that measurement
};

/// Remembers the last good samples. A bad target sample counts as none: the last good one holds until it is
/// too old. Odometry has no such grace: a sample that is not finite stops the vehicle in the same step.
class InputMonitor {
 public:
  /// Without new odometry for longer than this the vehicle stops. Late odometry is used up to an age of
  /// `InputParams::max_vehicle_age_sec`, because its velocity predicts the way since.
  static constexpr double kMissingSec = 0.2;

  explicit InputMonitor(const InputParams& params) : params_(params) {}

  Situation judge(const NavigatorInput& input, double now_sec);
  /// Notes the last setpoint: odometry is stuck if it repeats itself to the bit while the vehicle is to move.
  void told(const Setpoint& setpoint, double now_sec);
  void reset() { *this = InputMonitor(params_); }
  /// Relation between odom, as in messages, and the jump-free frame of `Situation`.
  const ContinuousOdometry& odometry() const { return odometry_; }

 private:
  void judgeClock(double now_sec, Situation& situation);
  void judgeVehicle(const NavigatorInput& input, Situation& situation);
  /// Notes the newest sample. Returns why it cannot be used; empty if it can.
  std::string takeSample(const VehicleState& sample, bool is_newer, double now_sec);
  void judgeTarget(const NavigatorInput& input, Situation& situation);
  void judgeImage(const NavigatorInput& input, Situation& situation);
  /// Finds out whether odometry has stopped: `is_stuck_`.
  void watchRepeats(const VehicleState& vehicle);
  TargetEstimate inSmooth(TargetEstimate target) const;
  bool acceptTarget(const TargetEstimate& target, double now_sec);

  InputParams params_;
  std::optional<double> last_now_sec_;
  std::optional<VehicleState> vehicle_;  ///< as received
  double arrived_sec_ = 0.0;             ///< time of its arrival
  std::optional<VehicleState> smooth_;   ///< the same sample in the jump-free frame
  ContinuousOdometry odometry_;
  EmptyTwist empty_twist_;
  std::optional<TargetEstimate> target_;
  std::optional<TargetEstimate> moved_target_;  ///< disagrees with `target_`; accepted if it persists
  double moved_since_sec_ = 0.0;
  std::optional<double> image_stamp_sec_;
  double image_period_sec_ = 0.0;
  double unchanged_since_sec_ = 0.0;        ///< stamp of the first of the identical samples
  std::optional<double> told_to_move_sec_;  ///< start of uninterrupted commands to move
  bool is_stuck_ = false;                   ///< until a sample differs
  double not_before_sec_ = -1e300;          ///< images up to this stamp belong to an old odometry frame
};

/// Why this sample is unusable whatever its age; empty if it is usable.
std::string faultOf(const VehicleState& vehicle);
std::string faultOf(const TargetEstimate& target);

}  // namespace window_ingress::navigation
