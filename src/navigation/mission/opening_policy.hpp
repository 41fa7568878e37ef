/// Whether the vehicle may enter the opening, given its openness.
#pragma once

#include <string>

#include "navigation/mission/mission_state.hpp"
#include "window_ingress/navigation/commit_criterion.hpp"
#include "window_ingress/navigation/navigator_params.hpp"

namespace window_ingress::navigation {

/// What is visible behind the opening moves as a room does. A clean pane looks the same.
bool isSeenOpen(const TargetEstimate& target);

/// Why the opening counts as closed; empty if it does not.
std::string whyClosed(const TargetEstimate& target);

/// Why the vehicle may not enter yet; empty if it may. The opening is closed; or the operator has not
/// confirmed it, and it was not seen to be open (unless `commit/unverified_opening` allows that) or may be
/// glazed (unless `commit/glass` excludes that: no sensor can).
std::string whyNotEntered(const TargetEstimate& target, const MissionState& mission,
                          const CommitParams& params);

/// Whether the operator's confirmation would permit entry.
bool isToBeAsked(const TargetEstimate& target, const MissionState& mission, const CommitParams& params);

/// How long to wait at the commit line [s]: for the operator's answer, or for a view behind the opening.
double waitAtLineSec(const TargetEstimate& target, const CommitParams& params);

/// Text for the start of a mission: what is assumed, and what the vehicle will ask at the commit line.
std::string whatIsAssumed(const CommitParams& params);

/// Lateral offset from the window's axis after this waiting time [m], to see more of what is behind the
/// opening: first to one side, then to the other.
double lookAside(double waiting_sec, const CommitCriterion& criterion, const CommitParams& params);

}  // namespace window_ingress::navigation
