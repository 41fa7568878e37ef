/// What the vehicle does in each state that moves, and in HOLD.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>

#include "navigation/behaviours/behaviour.hpp"

namespace window_ingress::navigation {

/// SEARCH (P14): turns in its place, first towards where the window was last seen, and looks from a greater
/// height after each turn without success. It goes nowhere else. Once something is seen it stops turning away
/// from it until enough images have shown it.
class Search : public Behaviour {
 public:
  static constexpr double kMaxTurnPerImage = 0.25;  ///< part of the field of view, from image to image

  /// \param may_climb false after a mission has been near the window: what is above is then not known to be
  /// free
  Search(const NavigatorParams& params, bool may_climb) : Behaviour(params), may_climb_(may_climb) {}

  Decision step(const Situation& situation, MissionState& memory) override;

 private:
  Decision lookAt(const Situation& situation, const MissionState& memory);
  /// So that an image is neither smeared nor the window passed over between two (trap: faster finds less).
  double fastestTurn(double image_period_sec) const;
  double sweep(const VehicleState& vehicle, MissionState& memory);
  void countTurn(double heading_rad, MissionState& memory);

  bool may_climb_;
  std::optional<double> height_m_;
  std::optional<double> last_heading_rad_;
  double turned_rad_ = 0.0;
  double direction_ = 1.0;
  bool looks_back_ = true;
  int turns_ = 0;
  int frames_ = 0;
};

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

/// COMMIT: through the opening on `MissionState::committed`, which is frozen in odom; sightings on the way
/// that agree with it refine it, a few in a row that do not, or that forbid the approach, turn it back. Past
/// the point of no return it follows them: then it is odometry that went elsewhere. Heading along the normal.
/// Ends standing still behind the window; turns back only while the nose can still be stopped in front of the
/// plane, once it could not only with twice the way to do so: half stopped, it would drift where it can
/// neither pass nor turn.
class Commit : public Behaviour {
 public:
  using Behaviour::Behaviour;

  Decision step(const Situation& situation, MissionState& memory) override;

  /// True, after odometry was gone, if the vehicle is through already, or if the criterion with the committed
  /// window still holds, grown by the drift since; in front of the plane only while the window is seen there.
  static bool canResume(const Situation& situation, const MissionState& memory,
                        const NavigatorParams& params);

 private:
  void heedForbidden(const TargetEstimate& target);
  void refine(const Situation& situation, MissionState& memory);
  void turnBackIfUnsafe(const CommitCriterion& criterion, double blind_sec, Decision& decision) const;
  double forwardSpeed(const RelativeState& relative);
  double speedToExit(double room_m, const RelativeState& relative) const;

  std::optional<Eigen::Vector3d>
      entry_odom_m_;             ///< the window at the commit: no series of small updates leads far from it
  int disagreements_ = 0;        ///< new sightings in a row that put the window elsewhere
  double disagreement_m_ = 0.0;  ///< of the last sighting
  int forbidden_ = 0;            ///< new sightings in a row that say not to fly there
  std::string why_forbidden_;
  bool is_bound_ = false;    ///< was past the point of no return
  bool is_through_ = false;  ///< has reached the exit distance once
};

/// BACK_OFF (P17): away from the window along its last trusted normal in odom, to where it can be seen again.
/// Within the reveal neither turning nor sideways; clear of it, back onto the normal, and yaw points the
/// camera at where the window must be.
class BackOff : public Behaviour {
 public:
  using Behaviour::Behaviour;

  Decision step(const Situation& situation, MissionState& memory) override;

 private:
  Decision withoutNormal(const MissionState& memory) const;
  std::optional<Event> judge(const Situation& situation, const MissionState& memory,
                             const RelativeState& relative, std::string& reason);

  int frames_ = 0;
};

/// HOLD: zero velocity. Where images alone are missing, back from the window after a while. Once the inputs
/// are back for a while, goes on from where it can: the commit, the window, its memory, or a new search.
/// Gives up when they do not come back.
class Hold : public Behaviour {
 public:
  /// \param from the state that was left for the hold
  Hold(const NavigatorParams& params, State from) : Behaviour(params), from_(from) {}

  Decision step(const Situation& situation, MissionState& memory) override;

 private:
  bool mayRetreat(const Situation& situation, const MissionState& memory) const;
  std::optional<Event> wayOn(const Situation& situation, const MissionState& memory,
                             std::string& reason) const;

  State from_;
  double held_sec_ = 0.0;
  double good_sec_ = 0.0;
};

/// The behaviour of a state that begins; null for one that has none. \param from was left for it
std::unique_ptr<Behaviour> behaviourOf(State state, State from, double now_sec, bool may_climb,
                                       const NavigatorParams& params);

}  // namespace window_ingress::navigation
