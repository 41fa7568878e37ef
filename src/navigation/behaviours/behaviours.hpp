/// What the vehicle does in each state that moves, and in HOLD.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>

#include "navigation/behaviours/behaviour.hpp"

namespace window_ingress::navigation {

/// SEARCH (P14): turns in place, first towards the last known place of the window. After each unsuccessful
/// turn the vehicle climbs. It moves nowhere else. Once a window is seen, the vehicle turns towards it until
/// enough images have shown it.
class Search : public Behaviour {
 public:
  static constexpr double kMaxTurnPerImage = 0.25;  ///< fraction of the field of view between two images

  /// \param may_climb false once a mission has been near the window: the space above may not be free
  Search(const NavigatorParams& params, bool may_climb) : Behaviour(params), may_climb_(may_climb) {}

  Decision step(const Situation& situation, MissionState& mission) override;

 private:
  Decision lookAt(const Situation& situation, const MissionState& mission);
  /// Fastest yaw rate [rad/s] without blur and without skipping a window between two images (trap: faster
  /// finds less).
  double fastestTurn(double image_period_sec) const;
  double sweep(const VehicleState& vehicle, MissionState& mission);
  void countTurn(double heading_rad, MissionState& mission);

  bool may_climb_;
  std::optional<double> height_m_;
  std::optional<double> last_heading_rad_;
  double turned_rad_ = 0.0;
  double direction_ = 1.0;
  bool looks_back_ = true;
  int turns_ = 0;
  int frames_ = 0;
};

/// Excitation that needs no sign: straight up by a fixed amplitude and back, then down and back, alternately.
///
/// While both planar hypotheses are alive, a sideways step based on the pose is a coin flip. A change of
/// height is the same for both hypotheses and cannot lead to the wrong side. It also takes the camera off the
/// window's height, where both hypotheses are equally upright. Seen from above or below, upright borders lean
/// differently for the two.
class HeightProbe {
 public:
  explicit HeightProbe(const NavigatorParams& params) : params_(&params) {}
  explicit HeightProbe(NavigatorParams&&) = delete;  ///< the parameters must outlive this

  void reset() { *this = HeightProbe(*params_); }
  bool isExhausted() const { return count_ >= params_->align.max_probes; }
  int count() const { return count_; }

  /// Sets the height at which the probe starts and ends, unless it is set. By default the first `climb` sets
  /// it.
  void beginAt(double height_m);
  /// Vertical velocity of the probe at this height, up positive [m/s].
  double climb(double height_m);

 private:
  const NavigatorParams* params_;
  std::optional<double> start_m_;
  bool returns_ = false;
  int count_ = 0;
};

/// The paper's small steps (P19), as a reference for comparison: the vehicle moves by `step_m`, stops, looks,
/// and repeats. Each step is along one axis of the window only.
class StepPacer {
 public:
  explicit StepPacer(const NavigatorParams& params) : params_(&params) {}
  explicit StepPacer(NavigatorParams&&) = delete;  ///< the parameters must outlive this

  bool isStepped() const { return params_->scheme == "stepped"; }
  /// The wished velocity, unless the scheme is stepped: then the velocity of the present step, or zero during
  /// the pause. \param R_odom_window the window's axes
  Eigen::Vector3d pace(const Eigen::Vector3d& velocity_odom_mps, const Eigen::Matrix3d& R_odom_window,
                       const Situation& situation);

 private:
  /// The wished velocity's component along the step, slow enough to stop at its end.
  Eigen::Vector3d along(const Eigen::Vector3d& velocity_odom_mps, double left_m) const;

  const NavigatorParams* params_;
  std::optional<Eigen::Vector3d> from_odom_m_;       ///< start of the present step; empty during the pause
  Eigen::Vector3d along_ = Eigen::Vector3d::Zero();  ///< the present step's axis, odom
  std::optional<double> standing_since_sec_;
};

/// ALIGN (P15): yaw keeps the window in view and height follows its centre. Once the normal is trusted, the
/// vehicle moves sideways onto it. The vehicle never moves towards the window; with an untrusted normal it
/// only changes height.
class Align : public Behaviour {
 public:
  Align(const NavigatorParams& params, double now_sec) : Behaviour(params), ambiguous_since_sec_(now_sec) {}

  Decision step(const Situation& situation, MissionState& mission) override;

 private:
  Decision resolveSign(const Situation& situation, const MissionState& mission,
                       const RelativeState& relative);
  bool isNearAxis(const RelativeState& relative, const CommitCriterion& criterion, bool is_forbidden) const;
  Decision moveOntoAxis(const Situation& situation, MissionState& mission, const RelativeState& relative);
  Decision probeForLeave(const Situation& situation, const RelativeState& relative, Decision decision);

  HeightProbe probe_{*params_};
  StepPacer pacer_{*params_};
  double ambiguous_since_sec_;
  std::optional<double> in_funnel_since_sec_;
};

/// APPROACH (P16): forward along the normal, with corrections sideways and in height. The forward speed falls
/// to zero at the funnel's wall. While the criterion does not hold, the vehicle can stop at the commit line.
class Approach : public Behaviour {
 public:
  using Behaviour::Behaviour;

  Decision step(const Situation& situation, MissionState& mission) override;

 private:
  double forwardSpeed(const CommitCriterion& criterion, const RelativeState& relative) const;
  /// Lateral offset from the axis, to see whether the window is open [m].
  double asideM(const CommitCriterion& criterion, const Situation& situation) const;
  double patienceSec(const TargetEstimate& target) const;
  std::optional<Event> judge(const CommitCriterion& criterion, const RelativeState& relative,
                             const Situation& situation, std::string& reason);

  StepPacer pacer_{*params_};
  std::optional<double> outside_since_sec_;
  std::optional<double> waiting_since_sec_;
  bool looks_ = false;  ///< waits at the line to see whether the window is open
};

/// COMMIT: flies through the opening along its normal, by `MissionState::committed`, which is frozen in odom.
/// Sightings that agree with it refine it. Several in a row that disagree or forbid the approach turn the
/// vehicle back. Past the point of no return disagreeing sightings replace it, because then odometry is
/// wrong. COMMIT ends standing still behind the window. The vehicle turns back only while the nose can stop
/// in front of the plane. After the point of no return this needs twice the stopping distance: a vehicle that
/// has slowed halfway would drift where it can neither pass nor turn.
class Commit : public Behaviour {
 public:
  using Behaviour::Behaviour;

  Decision step(const Situation& situation, MissionState& mission) override;

  /// Whether COMMIT may resume after a loss of odometry: the vehicle is already through, or the criterion
  /// still holds for the committed window with the drift since. A vehicle that can still stop must also see
  /// the window at its place.
  static bool canResume(const Situation& situation, const MissionState& mission,
                        const NavigatorParams& params);

 private:
  void heedForbidden(const TargetEstimate& target);
  void refine(const Situation& situation, MissionState& mission);
  void turnBackIfUnsafe(const CommitCriterion& criterion, double blind_sec, Decision& decision) const;
  double forwardSpeed(const RelativeState& relative);
  double speedToExit(double room_m, const RelativeState& relative) const;

  std::optional<Eigen::Vector3d>
      entry_odom_m_;             ///< window's place at the commit: limits the sum of small updates
  int disagreements_ = 0;        ///< new sightings in a row that disagree with the place
  double disagreement_m_ = 0.0;  ///< of the last sighting
  int forbidden_ = 0;            ///< new sightings in a row that forbid the approach
  std::string why_forbidden_;
  bool is_bound_ = false;    ///< past the point of no return
  bool is_through_ = false;  ///< has reached the exit distance
};

/// BACK_OFF (P17): flies away from the window along its last trusted normal in odom, until the window can be
/// seen again. Within the reveal the vehicle neither turns nor moves sideways. Clear of the reveal it returns
/// to the normal and turns the camera towards the window.
class BackOff : public Behaviour {
 public:
  using Behaviour::Behaviour;

  Decision step(const Situation& situation, MissionState& mission) override;

 private:
  Decision withoutNormal(const MissionState& mission) const;
  std::optional<Event> judge(const Situation& situation, const MissionState& mission,
                             const RelativeState& relative, std::string& reason);

  int frames_ = 0;
};

/// HOLD: zero velocity. If only images are missing, the vehicle backs off after a while. Once the inputs have
/// been good for a while, the mission continues with the commit, the window, its remembered place or a new
/// search. HOLD gives up after a timeout.
class Hold : public Behaviour {
 public:
  /// \param from the state before HOLD
  Hold(const NavigatorParams& params, State from) : Behaviour(params), from_(from) {}

  Decision step(const Situation& situation, MissionState& mission) override;

 private:
  bool mayRetreat(const Situation& situation, const MissionState& mission) const;
  std::optional<Event> wayOn(const Situation& situation, const MissionState& mission,
                             std::string& reason) const;

  State from_;
  double held_sec_ = 0.0;
  double good_sec_ = 0.0;
};

/// The behaviour of a new state; null if the state has none. \param from the state before
std::unique_ptr<Behaviour> behaviourOf(State state, State from, double now_sec, bool may_climb,
                                       const NavigatorParams& params);

}  // namespace window_ingress::navigation
