#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "window_ingress/navigation/navigation_types.hpp"

namespace window_ingress::navigation {

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
  bool opening_asked = false;      ///< the vehicle has reached the commit line and asked the operator
  bool opening_confirmed = false;  ///< the operator has confirmed that the target is open
  bool was_near = false;           ///< the vehicle has approached a window: eaves may be above it
  bool was_in_front = true;        ///< the vehicle was clear of the opening at its last known position
  int others = 0;                  ///< how often the vehicle flew at a window that was not the target
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

}  // namespace window_ingress::navigation
