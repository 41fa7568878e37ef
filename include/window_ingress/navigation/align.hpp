#pragma once

#include "window_ingress/navigation/behaviour.hpp"

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
  explicit HeightProbe(const NavigatorParams& params) : params_(params) {}

  void reset() { *this = HeightProbe(params_); }
  bool isExhausted() const { return count_ >= params_.align.max_probes; }
  int count() const { return count_; }

  /// Upward velocity of the probe at this height.
  double climb(double height_m);

 private:
  NavigatorParams params_;
  std::optional<double> start_m_;
  bool returns_ = false;
  int count_ = 0;
};

/// The paper's small steps (P19), as a yardstick: lets the vehicle move `step_m`, then makes it look for a
/// while.
class StepPacer {
 public:
  explicit StepPacer(const AlignParams& params) : params_(params) {}

  /// The velocity, or none during the look.
  Eigen::Vector3d pace(const Eigen::Vector3d& velocity_mps, const Situation& situation);

 private:
  AlignParams params_;
  std::optional<Eigen::Vector3d> from_odom_m_;
  double pause_until_sec_ = -1e300;
};

/// ALIGN (P15): yaw keeps the window in view, height follows its centre, and once the normal is trusted the
/// vehicle moves sideways onto it. It never moves towards the window, and while the normal is not trusted it
/// only changes height.
class Align {
 public:
  explicit Align(const NavigatorParams& params) : params_(params), probe_(params), pacer_(params.align) {}

  void enter(double now_sec);
  Decision step(const Situation& situation);

 private:
  Decision resolveSign(const Situation& situation, const RelativeState& relative);
  Decision moveOntoAxis(const Situation& situation, const RelativeState& relative);
  Decision probeForLeave(const Situation& situation, Decision decision);

  NavigatorParams params_;
  HeightProbe probe_;
  StepPacer pacer_;
  double ambiguous_since_sec_ = 0.0;
  std::optional<double> in_funnel_since_sec_;
};

}  // namespace window_ingress::navigation
