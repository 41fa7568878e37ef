/// What one state does with one step: a wish, perhaps an event, and why.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "navigation/motion/input_monitor.hpp"
#include "window_ingress/navigation/commit_criterion.hpp"
#include "window_ingress/navigation/transition_table.hpp"

namespace window_ingress::navigation {

constexpr int kFoundImages = 3;  ///< different ones that must show a window before it is flown at

struct Decision {
  Setpoint wish;
  bool keeps_place = false;  ///< where the wish has no velocity, the vehicle is to stay where it is
  std::optional<Event> event;
  std::string reason;
};

/// What the mission knows beyond the present step.
struct MissionState {
  std::optional<TargetEstimate> trusted;         ///< last estimate whose normal was trusted
  std::optional<TargetEstimate> committed;       ///< what COMMIT flies by, in odom
  double committed_sec = 0.0;                    ///< as known at this time; its spread has grown since
  std::optional<Eigen::Vector3d> window_odom_m;  ///< where the window was last seen, normal trusted or not
  Eigen::Vector3d told_odom_mps = Eigen::Vector3d::Zero();  ///< velocity last commanded
  double pending_yaw_rad = 0.0;                             ///< told already, not turned yet
  Eigen::Vector3d wind_odom_mps = Eigen::Vector3d::Zero();  ///< velocity added to what is commanded
  Eigen::Matrix3d gusts_odom = Eigen::Matrix3d::Zero();     ///< mean square of what comes and goes [m^2/s^2]
  double gusts_watched_sec = 0.0;                           ///< over this time
  double odometry_disagreement_mps = 0.0;      ///< between its position and its velocity, of late
  double odometry_shift_m = 0.0;               ///< by which its positions were set right so far
  double odometry_unexplained_mps = 0.0;       ///< what of it is no steady bias of the velocity
  double odometry_drift_m_per_sqrt_sec = 0.0;  ///< of its position beside its velocity, as measured
  Eigen::Vector3d odometry_carried_m = Eigen::Vector3d::Zero();  ///< as told last
  bool odometry_bias_known = false;             ///< it has been watched for long enough to know of one
  std::optional<Eigen::Vector3d> home_odom_m;   ///< where the mission began
  std::optional<double> keeping_since_sec;      ///< a place is wanted
  std::optional<Eigen::Vector3d> place_odom_m;  ///< to be kept: where the vehicle stands, has stood
  std::vector<Eigen::Vector3d> others_odom_m;   ///< windows that are not the one looked for
  std::vector<Eigen::Vector3d> left_odom_m;     ///< windows left for good: closed, or tried in vain
  std::vector<std::uint32_t> given_up;          ///< numbers of windows that were left, in that order
  bool opening_asked = false;                   ///< the vehicle waits at the line for the operator's word
  bool opening_confirmed = false;               ///< the operator says that the window flown at is open
  bool was_near = false;                        ///< has approached a window: what is above it may be eaves
  bool was_in_front = true;  ///< clear of the opening, when it was last known where the vehicle was
  int others = 0;            ///< how often one of these was flown at
  int back_offs = 0;
  std::string unmet;              ///< why the criterion was not met, of late
  double predicted_miss_m = 0.0;  ///< of the commit, as of the last moment at which it could be broken off
  double blind_sec = 0.0;         ///< longest time without sight of the window during COMMIT, up to the plane

  /// The window flown at is flown at no longer.
  void leaveWindow();
  /// The same for good.
  void giveUpWindow(const TargetEstimate& window);
  /// Which window is flown at, and which not: one of them may have been misjudged.
  void forgetWindow();
  /// To where it was when the vehicle began to keep it, once it is known how it was carried off meanwhile.
  void bringPlaceBack(const Eigen::Vector3d& carried_m);
  /// Everything that lives in an odometry frame.
  void forgetPlaces();
};

/// What the vehicle does in one state, from the moment at which that is entered until it is left.
class Behaviour {
 public:
  explicit Behaviour(const NavigatorParams& params) : params_(&params) {}
  explicit Behaviour(NavigatorParams&&) = delete;  ///< they are looked at in every step
  virtual ~Behaviour() = default;

  virtual Decision step(const Situation& situation, MissionState& memory) = 0;

 protected:
  const NavigatorParams* params_;
};

/// For how long a condition has held, updating when it began; negative if it does not.
double heldSec(bool condition, double now_sec, std::optional<double>& since_sec);

/// On which side of the window the vehicle is, for when its place will be forgotten.
void noteSide(const Situation& situation, const NavigatorParams& params, MissionState& memory);

/// If the way flown has shown the target to be another window, or closed: remembers that, and says so.
std::optional<Decision> leaveOtherWindow(const Situation& situation, MissionState& memory);

/// The target is known to be closed; or it lies where a window is that is known to be another one: in the
/// same direction, for its distance is computed with a size that it does not have.
bool isKnownOther(const TargetEstimate& target, const VehicleState& vehicle, const MissionState& memory);

/// CommitCriterion of this vehicle with this window, now. \param unseen_sec nothing is known of the
/// window since so long
CommitCriterion criterionWith(const TargetEstimate& target, const VehicleState& vehicle,
                              const MissionState& memory, const NavigatorParams& params,
                              double unseen_sec = 0.0);

/// Forward velocity less what wind adds towards the window; wind that holds the vehicle back is not made up
/// for.
double againstTailwind(double forward_mps, const TargetEstimate& target, const MissionState& memory);

/// Yaw rate that takes the heading error away, less what the vehicle is turning already.
double yawRateFor(double error_rad, const MissionState& memory, const NavigatorParams& params);

/// What the nose is off where it should point [rad]: at the window's middle, and near the wall along its
/// normal, for a turned body is a wider one.
double headingErrorTowards(const RelativeState& relative, const NavigatorParams& params);

/// Velocity along one axis that takes the error (goal less present) away: in proportion to it as long as the
/// vehicle can slow down as fast as that asks for, and beyond, what it can stop from (a square-root
/// controller, as autopilots have it).
double velocityTowards(double error_m, double limit_mps, const NavigatorParams& params);

/// Velocity in odom axes: forward as given, sideways and upward onto the window's axis and against the wind,
/// within the speed limit. Away from the window goes before sideways, sideways before forward.
Eigen::Vector3d velocityAlongAxis(const RelativeState& relative, const TargetEstimate& target,
                                  double forward_mps, const Eigen::Vector3d& wind_odom_mps,
                                  const NavigatorParams& params);

}  // namespace window_ingress::navigation
