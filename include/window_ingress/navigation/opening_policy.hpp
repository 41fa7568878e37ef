/// Whether the vehicle may fly into an opening, as to whether it is one.
#pragma once

#include <optional>
#include <string>

#include "window_ingress/navigation/behaviour.hpp"

namespace window_ingress::navigation {

/// That it was seen to be closed, and by what; empty if it was not.
std::string whyClosed(const TargetEstimate& target);

/// Why nobody may fly through it yet: it is closed; or it was not seen to be open, the operator has not said
/// so, and `commit/unverified_opening` does not allow it. Empty if nothing speaks against it.
std::string whyNotEntered(const TargetEstimate& target, const MissionMemory& memory,
                          const CommitParams& params);

/// If the target was seen to be closed: remembers where, and leaves it for good.
std::optional<Decision> leaveClosedOpening(const Situation& situation, MissionMemory& memory);

/// Where to stand beside the window's axis to see more of what is behind it, waiting for so long: to one
/// side, then to the other [m].
double lookAside(double waiting_sec, const Contract& contract, const CommitParams& params);

}  // namespace window_ingress::navigation
