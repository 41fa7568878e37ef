#include "navigation/motion/permitted_directions.hpp"

#include <algorithm>
#include <cmath>

#include "navigation/behaviours/position_hold.hpp"
#include "navigation/motion/stopping.hpp"

namespace window_ingress::navigation {
namespace {

/// The velocity less its part towards the window.
Eigen::Vector3d withoutForward(const Eigen::Vector3d& velocity, const TargetEstimate& target) {
  const Eigen::Vector3d normal = normalOf(target);
  return velocity - std::max(0.0, velocity.dot(normal)) * normal;
}

/// Any vertical velocity; horizontally only back to the kept place.
Eigen::Vector3d verticalAndToPlace(const Eigen::Vector3d& velocity, const Situation& situation,
                                   const MissionState& mission, const NavigatorParams& params) {
  Eigen::Vector3d permitted =
      onlyToPlace({velocity.x(), velocity.y(), 0.0}, *situation.vehicle, mission, params.hold);
  permitted.z() = velocity.z();
  return permitted;
}

/// Away from the wall. In front of the opening also sideways and vertically towards its axis, away from the
/// frame.
Eigen::Vector3d awayAndToAxis(const Eigen::Vector3d& velocity, const VehicleState& vehicle,
                              const TargetEstimate& target) {
  const Eigen::Matrix3d R_odom_window = uprightRotation(target);
  const RelativeState relative = relate(vehicle, target);
  Eigen::Vector3d kept = R_odom_window.transpose() * velocity;
  kept.x() = std::min(0.0, kept.x());
  const bool is_before_opening = std::abs(relative.lateral()) < target.opening.width_m / 2.0 &&
                                 std::abs(relative.vertical()) < target.opening.height_m / 2.0;
  for (int axis = 1; axis < 3; ++axis)
    if (!is_before_opening || kept[axis] * relative.position_window_m[axis] > 0.0) kept[axis] = 0.0;
  return R_odom_window * kept;
}

Eigen::Vector3d permittedBeforeWindow(const Eigen::Vector3d& velocity, State state,
                                      const Situation& situation, const MissionState& mission,
                                      const NavigatorParams& params) {
  const auto& target = *situation.target;
  const double distance_m = relate(*situation.vehicle, target).distance();
  if (distance_m <= 0.0) return verticalAndToPlace(velocity, situation, mission, params);
  const CommitCriterion criterion = criterionWith(target, situation, mission, params);
  const bool before_line = distance_m > criterion.commit_distance_m;
  const bool may_advance = state == State::kApproach && target.approach_forbidden.empty() &&
                           (criterion.holds || (before_line && criterion.in_funnel));
  if (may_advance) return velocity;
  const Eigen::Vector3d kept = withoutForward(velocity, target);
  const bool is_beside_opening = distance_m < params.limits.wall_distance_m && !criterion.in_funnel;
  return is_beside_opening ? awayAndToAxis(kept, *situation.vehicle, target) : kept;
}

Eigen::Vector3d permittedBackwards(const Eigen::Vector3d& velocity, const VehicleState& vehicle,
                                   const TargetEstimate& window, const VehicleParams& body) {
  const bool in_reveal = relate(vehicle, window).distance() < body.half_length_m;
  return in_reveal ? awayAndToAxis(velocity, vehicle, window) : withoutForward(velocity, window);
}

Eigen::Vector3d permittedByState(const Eigen::Vector3d& velocity, State state, const Situation& situation,
                                 const MissionState& mission, const NavigatorParams& params) {
  const auto& target = situation.target;
  const bool is_trusted = target && target->sign_trusted;
  switch (state) {
    case State::kSearch:
      return verticalAndToPlace(velocity, situation, mission, params);
    case State::kAlign:
    case State::kApproach:
      if (!is_trusted) return verticalAndToPlace(velocity, situation, mission, params);
      return permittedBeforeWindow(velocity, state, situation, mission, params);
    case State::kCommit:
      return mission.committed ? velocity : Eigen::Vector3d(Eigen::Vector3d::Zero());
    case State::kBackOff:
      return mission.trusted
                 ? permittedBackwards(velocity, *situation.vehicle, *mission.trusted, params.vehicle)
                 : Eigen::Vector3d(Eigen::Vector3d::Zero());
    case State::kHold:
    case State::kPassed:
      return onlyToPlace(velocity, *situation.vehicle, mission, params.hold);
    case State::kIdle:
    case State::kAborted:
      break;
  }
  return Eigen::Vector3d::Zero();
}

/// Limits the outward speed so that the vehicle can stop at the fence.
Eigen::Vector3d withinFence(const Eigen::Vector3d& velocity, const Eigen::Vector3d& position_m,
                            const MissionState& mission, const NavigatorParams& params) {
  if (!mission.home_odom_m) return velocity;
  Eigen::Vector3d outward = position_m - *mission.home_odom_m;
  outward.z() = 0.0;
  const double away_m = outward.norm();
  if (away_m < 1e-6) return velocity;
  outward /= away_m;
  const double most_mps = stoppingSpeed(params.limits.fence_radius_m - away_m, params.vehicle);
  return velocity - std::max(0.0, velocity.dot(outward) - most_mps) * outward;
}

}  // namespace

Eigen::Vector3d permittedVelocity(const Eigen::Vector3d& velocity_odom_mps, State state,
                                  const Situation& situation, const MissionState& mission,
                                  const NavigatorParams& params) {
  if (!situation.vehicle) return Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity = permittedByState(velocity_odom_mps, state, situation, mission, params);
  const Eigen::Vector3d position_m = situation.vehicle->T_odom_base.translation();
  velocity.z() =
      std::clamp(velocity.z(), -stoppingSpeed(position_m.z() - params.limits.min_height_m, params.vehicle),
                 stoppingSpeed(params.limits.max_height_m - position_m.z(), params.vehicle));
  return withinFence(velocity, position_m, mission, params);
}

bool isHeldByFence(const Eigen::Vector3d& velocity_odom_mps, const Situation& situation,
                   const MissionState& mission, const NavigatorParams& params) {
  const Eigen::Vector3d within =
      withinFence(velocity_odom_mps, situation.vehicle->T_odom_base.translation(), mission, params);
  return within.norm() < 0.1 && (velocity_odom_mps - within).norm() > 1e-3;
}

}  // namespace window_ingress::navigation
