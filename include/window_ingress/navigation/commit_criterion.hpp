/// Conditions for approaching the window (funnel) and for flying on without seeing it (commit criterion).
#pragma once

#include <string>

#include "window_ingress/estimation/target_motion.hpp"
#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/navigation/navigator_params.hpp"
#include "window_ingress/navigation/relative_state.hpp"

namespace window_ingress::navigation {

/// Distance of the body's centre to the plane at which the vehicle commits. There the opening is about to
/// outgrow the field of view, with the present offset (at most half the opening) and the given pitch. If a
/// stop in front of the opening needs more room, that distance is used. Trap: the wide field of view of a
/// level camera shrinks with its pitch.
double commitDistance(const RelativeState& relative, const geometry::OpeningSize& opening, double pitch_rad,
                      const NavigatorParams& params);

/// What the criterion depends on.
struct CommitCriterionInput {
  RelativeState relative;
  geometry::OpeningSize opening;
  double pitch_rad = 0.0;             ///< pitch of the vehicle, nose down positive [rad]
  double unseen_sec = 0.0;            ///< age of the window estimate [s]
  estimation::TargetMotion motion;    ///< of the window
  double gust_lateral_mps = 0.0;      ///< root mean square of sideways gust velocity [m/s]
  double gust_vertical_mps = 0.0;     ///< root mean square of vertical gust velocity [m/s]
  double gusts_watched_sec = 15.0;    ///< observation time; a shorter one adds more for stronger gusts
  double odometry_mps = 0.0;          ///< error of the odometry's velocity [m/s]
  double drift_m_per_sqrt_sec = 0.0;  ///< of the odometry, measured; the parameter is the minimum
};

/// Whether the vehicle may commit now, and with what margin.
struct CommitCriterion {
  double clearance_lateral_m = 0.0;  ///< half the opening less half the body less `margin_m`
  double clearance_vertical_m = 0.0;
  /// Predicted at the plane: the remaining offset plus `sigma_factor` times the spread of estimate, odometry
  /// drift on the blind way, and gusts.
  double miss_lateral_m = 0.0;
  double miss_vertical_m = 0.0;
  /// Offset at the plane without random errors, if the velocity keeps its deviation from what steering asks
  /// for.
  double settled_lateral_m = 0.0;
  double settled_vertical_m = 0.0;
  double commit_distance_m = 0.0;
  double funnel_m = 0.0;   ///< how much wider than the clearance the funnel is at this distance
  double fullness = 0.0;   ///< present offset plus its spread, over the funnel's half width; 1 at its wall
  bool in_funnel = false;  ///< present offsets plus their spread lie within clearance + funnel
  /// Predicted, settled and present offsets lie within the clearance, so straight flight would also do; the
  /// heading is along the normal, and sideways speed is low.
  bool holds = false;
  std::string unmet;  ///< why the criterion does not hold, with numbers; empty if it does
  /// It is not known whether the opening is open, and the policy requires it.
  bool opening_unverified = false;

  double missM() const { return miss_lateral_m > miss_vertical_m ? miss_lateral_m : miss_vertical_m; }
};

CommitCriterion evaluateCommitCriterion(const CommitCriterionInput& input, const NavigatorParams& params);

}  // namespace window_ingress::navigation
