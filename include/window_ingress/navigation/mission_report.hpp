#pragma once

#include "window_ingress/navigation/behaviour.hpp"

namespace window_ingress::navigation {

/// Figures for people and reports; zero where the state has nothing to say.
struct NavigatorReport {
  bool has_relative = false;       ///< the next three are set
  double lateral_m = 0.0;          ///< of the vehicle in the window frame: y, left positive [m]
  double vertical_m = 0.0;         ///< z, up positive [m]
  double distance_m = 0.0;         ///< to the window's plane, positive in front [m]
  double commit_distance_m = 0.0;  ///< where COMMIT would begin now [m]
  double predicted_miss_m = 0.0;   ///< at the commit: offset, 3 sigma and drift, of the worse axis [m]
  double blind_sec = 0.0;       ///< longest time in COMMIT without sight of the window, up to its plane [s]
  int retries = 0;              ///< back-offs so far
  std::uint32_t window_id = 0;  ///< of the window flown at; 0: none, or it has no number
  std::vector<std::uint32_t> given_up;  ///< windows left for good on this mission, in that order
  bool next_window = false;             ///< after one of these the next best is to be the target
};

NavigatorReport reportOn(const Situation& situation, const MissionMemory& memory,
                         const NavigatorParams& params);

}  // namespace window_ingress::navigation
