/// Whether the vehicle may fly into an opening, as to whether it is one.
#pragma once

#include <optional>
#include <string>

#include "navigation/behaviours/behaviour.hpp"

namespace window_ingress::navigation {

/// What lies behind it moves as a room does. A clean pane looks the same.
bool isSeenOpen(const TargetEstimate& target);

/// That it was seen to be closed, and by what; empty if it was not.
std::string whyClosed(const TargetEstimate& target);

/// Why nobody may fly through it yet: it is closed; or the operator has not confirmed it, and it was not seen
/// to be open (unless `commit/unverified_opening` allows that) or may be glazed (unless `commit/glass`
/// excludes that: nothing aboard can). Empty if nothing speaks against it.
std::string whyNotEntered(const TargetEstimate& target, const MissionState& memory,
                          const CommitParams& params);

/// Whether the operator's word would let it in.
bool isToBeAsked(const TargetEstimate& target, const MissionState& memory, const CommitParams& params);

/// How long to wait at the commit line: for the operator's answer, or for what is to be seen [s].
double waitAtLineSec(const TargetEstimate& target, const CommitParams& params);

/// What will be asked at the line and what is assumed, to be said before anything moves.
std::string whatIsAssumed(const CommitParams& params);

/// If the target was seen to be closed: remembers where, and leaves it for good.
std::optional<Decision> leaveClosedOpening(const Situation& situation, MissionState& memory);

/// Where to stand beside the window's axis to see more of what is behind it, waiting for so long: to one
/// side, then to the other [m].
double lookAside(double waiting_sec, const CommitCriterion& criterion, const CommitParams& params);

}  // namespace window_ingress::navigation
