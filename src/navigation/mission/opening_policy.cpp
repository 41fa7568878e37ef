#include "navigation/mission/opening_policy.hpp"

#include <algorithm>
#include <cmath>

namespace window_ingress::navigation {

using openness::Openness;

bool isSeenOpen(const TargetEstimate& target) { return target.openness.openness == Openness::kOpen; }

namespace {

/// What must still be known before the vehicle enters; empty if nothing.
std::string doubtAbout(const TargetEstimate& target, const CommitParams& params) {
  if (!isSeenOpen(target) && params.unverified_opening != "allow")
    return "not seen to be open: " + target.openness.reason;
  return params.glass == "excluded" ? "" : "glass is not excluded (commit/glass)";
}

bool asksAbout(const TargetEstimate& target, const CommitParams& params) {
  return isSeenOpen(target) || params.unverified_opening != "deny";
}

}  // namespace

std::string whyClosed(const TargetEstimate& target) {
  const bool is_closed = target.openness.openness == Openness::kClosed;
  return is_closed ? "the opening is closed: " + target.openness.reason : "";
}

std::string whyNotEntered(const TargetEstimate& target, const MissionState& mission,
                          const CommitParams& params) {
  const std::string closed = whyClosed(target);
  if (!closed.empty() || mission.opening_confirmed) return closed;
  const std::string doubt = doubtAbout(target, params);
  return isToBeAsked(target, mission, params) ? "is it open? If so, call ~confirm_opening; " + doubt : doubt;
}

bool isToBeAsked(const TargetEstimate& target, const MissionState& mission, const CommitParams& params) {
  return !mission.opening_confirmed && whyClosed(target).empty() && !doubtAbout(target, params).empty() &&
         asksAbout(target, params);
}

double waitAtLineSec(const TargetEstimate& target, const CommitParams& params) {
  return asksAbout(target, params) ? params.ask_sec : params.look_sec;
}

std::string whatIsAssumed(const CommitParams& params) {
  const bool excluded = params.glass == "excluded";
  const std::string glass =
      excluded ? "assumes that there is no glass (commit/glass)"
               : "will ask for ~confirm_opening at the line: glass is not excluded (commit/glass)";
  if (params.unverified_opening == "deny") return glass + "; turns back if it is not seen to be open";
  if (!excluded) return glass;
  return glass + (params.unverified_opening == "allow"
                      ? "; enters even if it is not seen to be open"
                      : "; will ask for ~confirm_opening if it is not seen to be open");
}

double lookAside(double waiting_sec, const CommitCriterion& criterion, const CommitParams& params) {
  constexpr double kPeriodSec = 5.0, kPartOfClearance = 0.7;
  const double aside_m =
      std::min(params.look_aside_m, kPartOfClearance * std::max(0.0, criterion.clearance_m.x()));
  return aside_m * std::sin(2.0 * M_PI * waiting_sec / kPeriodSec);
}

}  // namespace window_ingress::navigation
