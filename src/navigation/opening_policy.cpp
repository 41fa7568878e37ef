#include "window_ingress/navigation/opening_policy.hpp"

#include <algorithm>
#include <cmath>

namespace window_ingress::navigation {

using openness::Openness;

std::string whyClosed(const TargetEstimate& target) {
  const bool is_closed = target.openness.openness == Openness::kClosed;
  return is_closed ? "the opening is closed: " + target.openness.reason : "";
}

std::string whyNotEntered(const TargetEstimate& target, const MissionMemory& memory,
                          const CommitParams& params) {
  const auto& seen = target.openness;
  if (seen.openness == Openness::kClosed) return whyClosed(target);
  if (seen.openness == Openness::kOpen || memory.opening_confirmed || params.unverified_opening == "allow")
    return "";
  const std::string why = "not seen to be open: " + seen.reason;
  return params.unverified_opening == "ask" ? "is it open? ~confirm_opening says yes; " + why : why;
}

std::optional<Decision> leaveClosedOpening(const Situation& situation, MissionMemory& memory) {
  const auto& target = *situation.target;
  const std::string why = whyClosed(target);
  if (why.empty()) return std::nullopt;
  memory.giveUpWindow(target);
  Decision decision;
  decision.keeps_place = true;
  decision.event = Event::kOtherWindow;
  decision.reason = why;
  return decision;
}

double lookAside(double waiting_sec, const Contract& contract, const CommitParams& params) {
  constexpr double kSideSec = 2.0, kPartOfClearance = 0.7;
  const double aside_m =
      std::min(params.look_aside_m, kPartOfClearance * std::max(0.0, contract.clearance_lateral_m));
  return std::fmod(waiting_sec, 2.0 * kSideSec) < kSideSec ? aside_m : -aside_m;
}

}  // namespace window_ingress::navigation
