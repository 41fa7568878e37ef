/// What a state does in one step: a wished setpoint, an optional event, and the reason.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "navigation/motion/input_monitor.hpp"
#include "window_ingress/navigation/commit_criterion.hpp"
#include "window_ingress/navigation/transition_table.hpp"

namespace window_ingress::navigation {

constexpr int kFoundImages = 3;  ///< distinct images that must show a window before the vehicle flies at it

struct Decision {
  Setpoint wish;
  bool keeps_place = false;  ///< the vehicle keeps its place on every axis without a wished velocity
  std::optional<Event> event;
  std::string reason;
};

/// What the mission remembers between steps: its own choices, counts and places.
struct MissionState {
  std::optional<TargetEstimate> trusted;         ///< last estimate whose normal was trusted
  std::optional<TargetEstimate> committed;       ///< window that COMMIT flies through, in odom
  double committed_sec = 0.0;                    ///< time of `committed`; its uncertainty grows from then on
  std::optional<Eigen::Vector3d> window_odom_m;  ///< last place of the window, normal trusted or not
  std::optional<Eigen::Vector3d> home_odom_m;    ///< where the mission began, for the fence
  Eigen::Vector3d from_home_m = Eigen::Vector3d::Zero();      ///< the vehicle's last place less `home_odom_m`
  std::optional<double> keeping_since_sec;                    ///< since when the vehicle is to keep a place
  std::optional<Eigen::Vector3d> place_odom_m;                ///< place to keep: where it stands or stood
  Eigen::Vector3d place_carried_m = Eigen::Vector3d::Zero();  ///< part of it: `ContinuousOdometry::carriedM`
  std::vector<Eigen::Vector3d> others_odom_m;                 ///< windows that are not the target
  std::vector<Eigen::Vector3d> left_odom_m;  ///< windows left for good: closed, or all tries failed
  std::vector<std::uint32_t> given_up;       ///< numbers of the windows that were left, in that order
  bool opening_asked = false;                ///< the vehicle waits at the commit line for the operator
  bool opening_confirmed = false;            ///< the operator has confirmed that the target is open
  bool was_near = false;                     ///< the vehicle has approached a window: eaves may be above it
  bool was_in_front = true;  ///< the vehicle was clear of the opening at its last known position
  int others = 0;            ///< how often the vehicle flew at a window that was not the target
  int back_offs = 0;
  std::string unmet;              ///< last reason why the commit criterion did not hold
  double predicted_miss_m = 0.0;  ///< of the commit, when it could last be broken off
  double blind_sec = 0.0;         ///< longest time without sight of the window during COMMIT, up to the plane

  /// Forgets the window flown at and the operator's confirmation.
  void leaveWindow();
  /// As `leaveWindow`, for good: the mission does not fly at this window again.
  void giveUpWindow(const TargetEstimate& window);
  /// As `leaveWindow`, and forgets the other windows: one of them may have been misjudged.
  void forgetWindow();
  /// Forgets every place in the odometry frame; home keeps its place relative to the vehicle.
  void forgetPlaces();
  /// Notes where the vehicle is: the first time it is home. Moves the kept place back by the drift
  /// (`ContinuousOdometry::carriedM`) since its choice.
  void followVehicle(const Eigen::Vector3d& position_odom_m, const Eigen::Vector3d& carried_m);
};

/// What the vehicle does in one state, from entering to leaving that state.
class Behaviour {
 public:
  explicit Behaviour(const NavigatorParams& params) : params_(&params) {}
  explicit Behaviour(NavigatorParams&&) = delete;  ///< the parameters must outlive this
  virtual ~Behaviour() = default;

  virtual Decision step(const Situation& situation, MissionState& mission) = 0;

 protected:
  const NavigatorParams* params_;
};

/// The behaviour of a new state; null if the state has none. \param from the state before \param may_climb
/// see `Search`
std::unique_ptr<Behaviour> behaviourOf(State state, State from, double now_sec, bool may_climb,
                                       const NavigatorParams& params);

/// How long the condition has held [s]; negative if it does not hold. Updates the time at which it began.
double heldSec(bool condition, double now_sec, std::optional<double>& since_sec);

/// Leaves a target that turned out to be another window or closed, and remembers its place.
std::optional<Decision> leaveOtherWindow(const Situation& situation, MissionState& mission);

/// The target was left for good, or lies in the direction of a window that is known to be another one. Only
/// the direction counts, because the distance was computed with a size that window does not have.
bool isKnownOther(const TargetEstimate& target, const VehicleState& vehicle, const MissionState& mission);

/// The commit criterion for this window, now. \param unseen_sec time since the last information about it
CommitCriterion criterionWith(const TargetEstimate& target, const Situation& situation,
                              const MissionState& mission, const NavigatorParams& params,
                              double unseen_sec = 0.0);

/// Forward velocity less the wind's component towards the window; headwind is not compensated.
double againstTailwind(double forward_mps, const TargetEstimate& target, const Situation& situation);

/// Yaw rate that removes the heading error, less the yaw that is already commanded.
double yawRateFor(double error_rad, const Situation& situation, const NavigatorParams& params);

/// Velocity along one axis that removes the error (goal minus present): proportional to small errors, limited
/// to the speed from which the vehicle can stop for large ones (square-root controller, as in autopilots).
double velocityTowards(double error_m, double limit_mps, const NavigatorParams& params);

/// Velocity in odom axes: the given forward speed, plus motion across onto the window's axis and against the
/// wind, within the speed limit. Priority: away from the window, then across, then forward.
Eigen::Vector3d velocityAlongAxis(const RelativeState& relative, const TargetEstimate& target,
                                  double forward_mps, const Eigen::Vector3d& wind_odom_mps,
                                  const NavigatorParams& params);

}  // namespace window_ingress::navigation
