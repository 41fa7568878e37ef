#include "navigation/behaviours/behaviour.hpp"

#include <algorithm>
#include <cmath>

#include "navigation/mission/opening_policy.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::navigation {
namespace {

/// With a larger difference between position and velocity, neither is reliable without sight of the window.
constexpr double kMaxDisagreementMps = 0.35;
constexpr double kMaxUnexplainedMps = 0.08;  // until a steady velocity bias can be told from a slide

std::string whyNoOdometryToCommitBy(const OdometryQuality& odometry) {
  if (odometry.disagreement_mps > kMaxDisagreementMps)
    return formatted("odometry: position and velocity disagree by %.2f m/s", odometry.disagreement_mps);
  if (!odometry.is_bias_known && odometry.unexplained_mps > kMaxUnexplainedMps)
    return formatted("odometry: its velocity is off by %.2f m/s, not yet known to be a constant bias",
                     odometry.unexplained_mps);
  return "";
}

}  // namespace

double heldSec(bool condition, double now_sec, std::optional<double>& since_sec) {
  if (!condition) since_sec.reset();
  if (condition && !since_sec) since_sec = now_sec;
  return since_sec ? now_sec - *since_sec : -1.0;
}

CommitCriterion criterionWith(const TargetEstimate& target, const Situation& situation,
                              const MissionState& mission, const NavigatorParams& params, double unseen_sec) {
  const Eigen::Matrix3d R_odom_window = uprightRotation(target);
  const auto gustAlong = [&](int axis) {
    const Eigen::Vector3d direction = R_odom_window.col(axis);
    return std::sqrt(std::max(0.0, direction.dot(situation.gusts_odom * direction)));
  };
  CommitCriterionInput input;
  input.relative = relate(*situation.vehicle, target);
  input.opening = target.opening;
  input.pitch_rad = pitchOf(*situation.vehicle);
  input.unseen_sec = unseen_sec;
  input.motion = target.motion;
  input.gusts_mps = {gustAlong(1), gustAlong(2)};
  input.gusts_watched_sec = situation.gusts_watched_sec;
  input.odometry_mps = situation.odometry.unexplained_mps;
  input.drift_m_per_sqrt_sec = situation.odometry.drift_m_per_sqrt_sec;
  CommitCriterion criterion = evaluateCommitCriterion(input, params);
  const std::string why_not = whyNotEntered(target, mission, params.commit);
  criterion.opening_unverified = !why_not.empty();
  if (criterion.holds) criterion.unmet = whyNoOdometryToCommitBy(situation.odometry);
  if (criterion.unmet.empty()) criterion.unmet = target.unverified;
  if (criterion.unmet.empty()) criterion.unmet = why_not;
  criterion.holds = criterion.unmet.empty();
  return criterion;
}

}  // namespace window_ingress::navigation
