#include "navigation/behaviours/position_hold.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace window_ingress::navigation {
namespace {

constexpr double kThereM = 0.01;
constexpr double kStandingMps = 0.2;  // a vehicle below this speed has found its place

Eigen::Vector3d levelDirection(const Eigen::Vector3d& way) {
  return Eigen::Vector3d(way.x(), way.y(), 0.0).normalized();
}

/// Limits horizontal and vertical speed separately, so that one takes nothing from the other.
Eigen::Vector3d levelAndVertical(const Eigen::Vector3d& velocity, double limit_mps) {
  const double level_mps = velocity.head<2>().norm();
  const double share = level_mps > limit_mps ? limit_mps / level_mps : 1.0;
  return {share * velocity.x(), share * velocity.y(), std::clamp(velocity.z(), -limit_mps, limit_mps)};
}

/// Directions towards the windows in front; along the normal where it is known.
std::vector<Eigen::Vector3d> towardsWindows(const Eigen::Vector3d& position_m, const MissionState& mission) {
  std::vector<Eigen::Vector3d> directions;
  if (mission.trusted) {
    const Eigen::Vector3d normal = normalOf(*mission.trusted);
    const bool is_behind = normal.dot(mission.trusted->T_odom_window.translation() - position_m) < 0.0;
    if (is_behind) return directions;
    directions.push_back(normal);
  } else if (mission.window_odom_m) {
    directions.push_back(levelDirection(*mission.window_odom_m - position_m));
  }
  for (const auto* windows : {&mission.left_odom_m, &mission.others_odom_m})
    for (const Eigen::Vector3d& window_odom_m : *windows)
      directions.push_back(levelDirection(window_odom_m - position_m));
  return directions;
}

/// The part of this way that leads towards no window; zero if windows on both sides leave none.
Eigen::Vector3d towardsNoWindow(Eigen::Vector3d way, const std::vector<Eigen::Vector3d>& windows) {
  constexpr double kTowardsM = 1e-9;
  for (const Eigen::Vector3d& forward : windows) way -= std::max(0.0, way.dot(forward)) * forward;
  const auto leadsThere = [&](const Eigen::Vector3d& forward) { return way.dot(forward) > kTowardsM; };
  return std::any_of(windows.begin(), windows.end(), leadsThere) ? Eigen::Vector3d::Zero().eval() : way;
}

}  // namespace

void rememberPlace(bool is_kept, const Situation& situation, const HoldParams& params,
                   MissionState& mission) {
  // Further from its place than wind and its own errors explain.
  const auto isTorn = [&](const Eigen::Vector3d& position_m) {
    return mission.place_odom_m && (*mission.place_odom_m - position_m).norm() > params.leash_m;
  };
  if (!is_kept || !situation.vehicle || isTorn(situation.vehicle->T_odom_base.translation())) {
    mission.place_odom_m.reset();
    mission.keeping_since_sec.reset();
    return;
  }
  if (!mission.keeping_since_sec) mission.keeping_since_sec = situation.now_sec;
  const bool stands = situation.vehicle->velocity_odom_mps.norm() < kStandingMps;
  const bool has_settled = situation.now_sec - *mission.keeping_since_sec >= kSettleSec;
  if (!mission.place_odom_m && (stands || has_settled))
    mission.place_odom_m = situation.vehicle->T_odom_base.translation();
}

Eigen::Vector3d velocityToPlace(const VehicleState& vehicle, const MissionState& mission,
                                const NavigatorParams& params) {
  if (!mission.place_odom_m) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d way = *mission.place_odom_m - vehicle.T_odom_base.translation() -
                              vehicle.velocity_odom_mps * params.vehicle.response_sec;
  return levelAndVertical(params.align.lateral_gain_hz * way, params.hold.speed_mps);
}

Eigen::Vector3d onlyToPlace(const Eigen::Vector3d& velocity_odom_mps, const VehicleState& vehicle,
                            const MissionState& mission, const HoldParams& params) {
  if (!mission.place_odom_m) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d position_m = vehicle.T_odom_base.translation();
  const Eigen::Vector3d way = *mission.place_odom_m - position_m;
  const Eigen::Vector3d level_way =
      towardsNoWindow({way.x(), way.y(), 0.0}, towardsWindows(position_m, mission));
  const bool leads_back = std::abs(way.z()) >= kThereM && velocity_odom_mps.z() * way.z() > 0.0;
  Eigen::Vector3d velocity(0.0, 0.0, leads_back ? velocity_odom_mps.z() : 0.0);
  if (level_way.norm() >= kThereM)
    velocity += std::max(0.0, velocity_odom_mps.dot(level_way.normalized())) * level_way.normalized();
  return levelAndVertical(velocity, params.speed_mps);
}

}  // namespace window_ingress::navigation
