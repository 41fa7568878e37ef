/// What must hold before the vehicle may move towards the window, and before it may fly on without seeing it.
#pragma once

#include <string>

#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/navigation/navigator_params.hpp"
#include "window_ingress/navigation/relative_state.hpp"

namespace window_ingress::navigation {

/// Fastest speed from which the vehicle still stops within `distance_m`, answering after `response_sec`:
/// v * response + v^2 / (2 * braking) = distance. 0 for distances that are not positive.
double stoppingSpeed(double distance_m, double braking_mps2, double response_sec);

/// Way until standing still: v * response + v^2 / (2 * braking) [m].
double stoppingDistance(double speed_mps, double braking_mps2, double response_sec);

/// Distance of the body's centre to the plane at which the vehicle commits: the opening, off-centre by the
/// present error and with the camera pitched as given, is about to outgrow the field of view; or, if that is
/// nearer, where the vehicle can just stop before its nose is in the opening. Trap: the wide field of view of
/// a level camera shrinks with its pitch.
double commitDistance(const RelativeState& relative, const geometry::OpeningSize& opening, double pitch_rad,
                      const NavigatorParams& params);

/// The bargain with the wall, at this moment.
struct Contract {
  double clearance_lateral_m = 0.0;  ///< half the opening less half the body less the margin
  double clearance_vertical_m = 0.0;
  double miss_lateral_m =
      0.0;  ///< predicted: offset after the response time, sigma_factor sigmas, drift on the blind way
  double miss_vertical_m = 0.0;
  double commit_distance_m = 0.0;
  double funnel_m = 0.0;   ///< by how much the funnel is wider than the clearance at this distance
  double openness = 0.0;   ///< 1 well within the funnel, 0 at its wall or outside: scales the forward speed
  bool in_funnel = false;  ///< both misses within clearance + funnel
  bool holds = false;  ///< both misses within the clearance, heading along the normal, little sideways speed
  std::string unmet;   ///< why it does not hold, with numbers; empty if it does

  double missM() const { return miss_lateral_m > miss_vertical_m ? miss_lateral_m : miss_vertical_m; }
};

/// \param pitch_rad of the vehicle, nose down positive
Contract evaluateContract(const RelativeState& relative, const geometry::OpeningSize& opening,
                          double pitch_rad, const NavigatorParams& params);

}  // namespace window_ingress::navigation
