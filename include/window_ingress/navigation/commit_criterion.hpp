/// Conditions for approaching the window (funnel) and for flying on without seeing it (commit criterion).
#pragma once

#include <Eigen/Core>
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
  double pitch_rad = 0.0;           ///< pitch of the vehicle, nose down positive [rad]
  double unseen_sec = 0.0;          ///< age of the window estimate [s]
  estimation::TargetMotion motion;  ///< of the window
  /// Root mean square of gust velocity, sideways and vertical [m/s].
  Eigen::Vector2d gusts_mps = Eigen::Vector2d::Zero();
  double gusts_watched_sec = 15.0;    ///< observation time; a shorter one adds more for stronger gusts
  double odometry_mps = 0.0;          ///< error of the odometry's velocity [m/s]
  double drift_m_per_sqrt_sec = 0.0;  ///< of the odometry, measured; the parameter is the minimum
};

/// Whether the vehicle may commit now, and with what margin. Pairs are sideways and vertical.
struct CommitCriterion {
  /// Half the opening less half the body less `margin_m`.
  Eigen::Vector2d clearance_m = Eigen::Vector2d::Zero();
  /// Predicted at the plane: the remaining offset plus `sigma_factor` times the spread of estimate, odometry
  /// drift on the blind way, and gusts.
  Eigen::Vector2d miss_m = Eigen::Vector2d::Zero();
  /// Offset at the plane without random errors, if the velocity keeps its deviation from what steering asks
  /// for.
  Eigen::Vector2d settled_m = Eigen::Vector2d::Zero();
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

  bool hasClearance() const { return (clearance_m.array() > 0.0).all(); }
};

CommitCriterion evaluateCommitCriterion(const CommitCriterionInput& input, const NavigatorParams& params);

}  // namespace window_ingress::navigation
