/// Judges what comes in before anybody flies by it: age, order, finiteness, jumps.
#pragma once

#include <optional>
#include <string>

#include "navigation/motion/continuous_odometry.hpp"
#include "window_ingress/navigation/navigator.hpp"
#include "window_ingress/navigation/navigator_params.hpp"

namespace window_ingress::navigation {

/// The input of one step, judged, in a frame odom without jumps (`ContinuousOdometry`). What is set can be
/// used; what is not has a fault that says why, with numbers.
struct Situation {
  double now_sec = 0.0;
  double dt_sec = 0.0;                  ///< since the step before, 0 to 0.2 s
  std::optional<VehicleState> vehicle;  ///< predicted to now
  std::string vehicle_fault;
  bool vehicle_jumped = false;  ///< what was known in the old odometry frame is void
  std::optional<TargetEstimate> target;
  std::string target_fault;
  bool target_is_new = false;     ///< from another image than the target of the step before
  std::string setpoint_fault;     ///< why setpoints do not reach the autopilot; empty: they do
  std::string image_fault;        ///< empty: images come, or nobody says
  std::string camera_fault;       ///< why no image can give a pose; empty: there is no reason
  double image_period_sec = 0.0;  ///< between the images searched, of late; 0: not known yet
};

/// Remembers the last good samples. A target sample that is bad counts as none came: the last good one holds
/// until it is too old. Odometry has no such grace: a sample that is not finite stops the vehicle in the same
/// step.
class InputMonitor {
 public:
  /// Without new odometry for longer than this the vehicle stops. One that comes late, but comes, is flown by
  /// until it is older than `InputParams::max_vehicle_age_sec`: its velocity tells the way since.
  static constexpr double kMissingSec = 0.2;

  explicit InputMonitor(const InputParams& params) : params_(params) {}

  Situation judge(const NavigatorInput& input, double now_sec);
  /// What the vehicle was told last: odometry that repeats itself to the bit meanwhile is stuck.
  void told(const Setpoint& setpoint, double now_sec);
  void reset();
  /// Between odom, as messages mean it, and the frame without jumps that situations are in.
  const ContinuousOdometry& odometry() const { return odometry_; }

 private:
  void judgeClock(double now_sec, Situation& situation);
  void judgeVehicle(const NavigatorInput& input, Situation& situation);
  void judgeTarget(const NavigatorInput& input, Situation& situation);
  void judgeImage(const NavigatorInput& input, Situation& situation);
  bool isStuck(const VehicleState& vehicle);
  void measurePeriod(double image_stamp_sec);
  TargetEstimate inSmooth(TargetEstimate target) const;
  bool staysAtNewPlace(const TargetEstimate& target) const;
  bool acceptTarget(const TargetEstimate& target, double now_sec);

  InputParams params_;
  std::optional<double> last_now_sec_;
  std::optional<VehicleState> vehicle_;  ///< as it came
  double arrived_sec_ = 0.0;             ///< when that came
  std::optional<VehicleState> smooth_;   ///< the same in the frame without jumps
  ContinuousOdometry odometry_;
  std::optional<TargetEstimate> target_;
  std::optional<TargetEstimate> moved_target_;  ///< disagrees with `target_`; believed if it stays
  double moved_since_sec_ = 0.0;
  std::optional<double> image_stamp_sec_;
  double image_period_sec_ = 0.0;
  double unchanged_since_sec_ = 0.0;        ///< stamp of the first of the samples that are all the same
  std::optional<double> told_to_move_sec_;  ///< since then, without a pause
  bool is_stuck_ = false;                   ///< until a sample differs
  double not_before_sec_ = -1e300;  ///< targets of images up to this stamp belong to an old odometry frame
};

/// What makes this sample unusable whatever its age; empty if nothing does.
std::string faultOf(const VehicleState& vehicle);
std::string faultOf(const TargetEstimate& target);

}  // namespace window_ingress::navigation
