#pragma once

#include "navigation/behaviours/behaviour.hpp"

namespace window_ingress::navigation {

/// Excitation that needs no sign: straight up by a fixed amplitude and back, then straight down and back, in
/// turn.
///
/// While two planar hypotheses are alive, every sideways step by the pose is a coin flip. A change of height
/// is not: it is the same for both hypotheses, leads to no wrong side, and it takes the camera off the height
/// of the window, where both hypotheses are equally upright; seen from above or below, upright borders lean
/// differently for the two.
class HeightProbe {
 public:
  explicit HeightProbe(const NavigatorParams& params) : params_(&params) {}
  explicit HeightProbe(NavigatorParams&&) = delete;  ///< they are looked at in every step

  void reset() { *this = HeightProbe(*params_); }
  bool isExhausted() const { return count_ >= params_->align.max_probes; }
  int count() const { return count_; }

  /// One that has not begun leaves from this height, and comes back to it; else from where it is asked first.
  void beginAt(double height_m);
  /// Upward velocity of the probe at this height.
  double climb(double height_m);

 private:
  const NavigatorParams* params_;
  std::optional<double> start_m_;
  bool returns_ = false;
  int count_ = 0;
};

/// The paper's small steps (P19), as a yardstick: the vehicle moves `step_m`, stops, looks for a while, and
/// so on; a step leads sideways or forward, never both.
class StepPacer {
 public:
  explicit StepPacer(const NavigatorParams& params) : params_(&params) {}
  explicit StepPacer(NavigatorParams&&) = delete;  ///< they are looked at in every step

  bool isStepped() const { return params_->scheme == "stepped"; }
  /// The velocity as wished unless the scheme is stepped; then that of the present step, or none during the
  /// look. \param R_odom_window the window's axes
  Eigen::Vector3d pace(const Eigen::Vector3d& velocity_odom_mps, const Eigen::Matrix3d& R_odom_window,
                       const Situation& situation);

 private:
  /// Of the wish, the part along the step's axis, so slow that the step can end in time.
  Eigen::Vector3d along(const Eigen::Vector3d& velocity_odom_mps, double left_m) const;

  const NavigatorParams* params_;
  std::optional<Eigen::Vector3d> from_odom_m_;       ///< where the present step began; none: looking
  Eigen::Vector3d along_ = Eigen::Vector3d::Zero();  ///< the present step's axis, odom
  std::optional<double> standing_since_sec_;
};

/// ALIGN (P15): yaw keeps the window in view, height follows its centre, and once the normal is trusted the
/// vehicle moves sideways onto it. It never moves towards the window, and while the normal is not trusted it
/// only changes height.
class Align : public Behaviour {
 public:
  Align(const NavigatorParams& params, double now_sec) : Behaviour(params), ambiguous_since_sec_(now_sec) {}

  Decision step(const Situation& situation, MissionState& memory) override;

 private:
  Decision resolveSign(const Situation& situation, const MissionState& memory, const RelativeState& relative);
  bool isNearAxis(const RelativeState& relative, const CommitCriterion& criterion, bool is_forbidden) const;
  Decision moveOntoAxis(const Situation& situation, MissionState& memory, const RelativeState& relative);
  Decision probeForLeave(const Situation& situation, const RelativeState& relative, Decision decision);

  HeightProbe probe_{*params_};
  StepPacer pacer_{*params_};
  double ambiguous_since_sec_;
  std::optional<double> in_funnel_since_sec_;
};

}  // namespace window_ingress::navigation
