#pragma once

#include "navigation/behaviours/align.hpp"
#include "navigation/behaviours/behaviour.hpp"

namespace window_ingress::navigation {

/// APPROACH (P16): forward along the normal, still correcting sideways and in height. The forward speed
/// shrinks to nothing at the wall of the funnel, and so that the vehicle can stop at the commit line as long
/// as the criterion does not hold.
class Approach : public Behaviour {
 public:
  using Behaviour::Behaviour;

  Decision step(const Situation& situation, MissionState& memory) override;

 private:
  double forwardSpeed(const CommitCriterion& criterion, const RelativeState& relative) const;
  /// Beside the axis, to see whether the opening is open.
  double asideM(const CommitCriterion& criterion, const Situation& situation) const;
  double patienceSec(const TargetEstimate& target) const;
  std::optional<Event> judge(const CommitCriterion& criterion, const RelativeState& relative,
                             const Situation& situation, std::string& reason);

  StepPacer pacer_{*params_};
  std::optional<double> outside_since_sec_;
  std::optional<double> waiting_since_sec_;
  bool looks_ = false;  ///< at the line, to see whether the opening is open
};

}  // namespace window_ingress::navigation
