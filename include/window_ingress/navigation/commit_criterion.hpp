/// What must hold before the vehicle may move towards the window, and before it may fly on without seeing it.
#pragma once

#include <string>

#include "window_ingress/estimation/target_motion.hpp"
#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/navigation/navigator_params.hpp"
#include "window_ingress/navigation/relative_state.hpp"

namespace window_ingress::navigation {

/// Distance of the body's centre to the plane at which the vehicle commits: the opening, off-centre by the
/// present error (half of the opening at most) and with the camera pitched as given, is about to outgrow the
/// field of view; or, if that is nearer, where the vehicle can just stop before its nose is in the opening.
/// Trap: the wide field of view of a level camera shrinks with its pitch.
double commitDistance(const RelativeState& relative, const geometry::OpeningSize& opening, double pitch_rad,
                      const NavigatorParams& params);

/// What the criterion depends on.
struct CommitCriterionInput {
  RelativeState relative;
  geometry::OpeningSize opening;
  double pitch_rad = 0.0;           ///< of the vehicle, nose down positive
  double unseen_sec = 0.0;          ///< the estimate is as of so long ago
  estimation::TargetMotion motion;  ///< of the window
  double gust_lateral_mps = 0.0;    ///< root mean square of the velocity that gusts bring
  double gust_vertical_mps = 0.0;   ///< likewise
  double gusts_watched_sec = 15.0;  ///< for so long: the shorter, the more may come than has come
  double odometry_mps = 0.0;        ///< by which the odometry's velocity may be off
  double drift_m_per_sqrt_sec =
      0.0;  ///< of the odometry, as measured; at least that of the parameters counts
};

/// Whether the vehicle may commit at this moment, and by what margin.
struct CommitCriterion {
  double clearance_lateral_m = 0.0;  ///< half the opening less half the body less the margin
  double clearance_vertical_m = 0.0;
  /// Predicted at the plane: what is left of the offset by then, and `sigma_factor` times the spread of
  /// estimate, odometry's drift on the blind way, and gusts.
  double miss_lateral_m = 0.0;
  double miss_vertical_m = 0.0;
  /// Offset at the plane without chance, if what the vehicle's velocity has beside what steering asks of it
  /// goes on.
  double settled_lateral_m = 0.0;
  double settled_vertical_m = 0.0;
  double commit_distance_m = 0.0;
  double funnel_m = 0.0;   ///< by how much the funnel is wider than the clearance at this distance
  double fullness = 0.0;   ///< offset as it is and its spread, over the funnel's half width; 1 at its wall
  bool in_funnel = false;  ///< the offsets as they are, and their spread, within clearance + funnel
  /// Both misses within the clearance, and the offset too: straight on would also do; heading along the
  /// normal, little sideways speed.
  bool holds = false;
  std::string unmet;  ///< why it does not hold, with numbers; empty if it does
  /// It is not known whether the opening is open, and that counts.
  bool opening_unverified = false;

  double missM() const { return miss_lateral_m > miss_vertical_m ? miss_lateral_m : miss_vertical_m; }
};

CommitCriterion evaluateCommitCriterion(const CommitCriterionInput& input, const NavigatorParams& params);

}  // namespace window_ingress::navigation
