#pragma once

#include "navigation/behaviours/behaviour.hpp"

namespace window_ingress::navigation {

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

}  // namespace window_ingress::navigation
