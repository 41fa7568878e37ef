#include "window_ingress/navigation/motion_guard.hpp"

#include <algorithm>

namespace window_ingress::navigation {
namespace {

Eigen::Vector3d onlyVertical(const Eigen::Vector3d& velocity) { return {0.0, 0.0, velocity.z()}; }

/// The velocity less its part towards the window.
Eigen::Vector3d withoutForward(const Eigen::Vector3d& velocity, const TargetEstimate& target) {
  const Eigen::Vector3d normal = uprightRotation(target).col(0);
  return velocity - std::max(0.0, velocity.dot(normal)) * normal;
}

Eigen::Vector3d permittedByState(const Eigen::Vector3d& velocity, State state, const Situation& situation,
                                 const MissionMemory& memory, const NavigatorParams& params) {
  const auto& target = situation.target;
  const bool is_trusted = target && target->sign_trusted;
  switch (state) {
    case State::kSearch:
      return onlyVertical(velocity);
    case State::kAlign:
      if (!is_trusted) return onlyVertical(velocity);
      return withoutForward(velocity, *target);
    case State::kApproach: {
      if (!is_trusted) return onlyVertical(velocity);
      const Contract contract = contractWith(*target, *situation.vehicle, params);
      const bool before_line = relate(*situation.vehicle, *target).distance() > contract.commit_distance_m;
      const bool may_advance = contract.holds || (before_line && contract.in_funnel);
      return may_advance ? velocity : withoutForward(velocity, *target);
    }
    case State::kCommit:
      return memory.committed ? velocity : Eigen::Vector3d(Eigen::Vector3d::Zero());
    case State::kBackOff:
      return memory.trusted ? withoutForward(velocity, *memory.trusted)
                            : Eigen::Vector3d(Eigen::Vector3d::Zero());
    case State::kIdle:
    case State::kPassed:
    case State::kHold:
    case State::kAborted:
      break;
  }
  return Eigen::Vector3d::Zero();
}

double withinHeights(double climb_mps, double height_m, const NavigatorParams& params) {
  const auto& [braking, response] = std::pair(params.vehicle.braking_mps2, params.vehicle.response_sec);
  const double up = stoppingSpeed(params.limits.max_height_m - height_m, braking, response);
  const double down = stoppingSpeed(height_m - params.limits.min_height_m, braking, response);
  return std::clamp(climb_mps, -down, up);
}

}  // namespace

Eigen::Vector3d permittedVelocity(const Eigen::Vector3d& velocity_odom_mps, State state,
                                  const Situation& situation, const MissionMemory& memory,
                                  const NavigatorParams& params) {
  if (!situation.vehicle) return Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity = permittedByState(velocity_odom_mps, state, situation, memory, params);
  velocity.z() = withinHeights(velocity.z(), situation.vehicle->T_odom_base.translation().z(), params);
  return velocity;
}

}  // namespace window_ingress::navigation
