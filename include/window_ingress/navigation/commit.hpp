#pragma once

#include "window_ingress/navigation/behaviour.hpp"

namespace window_ingress::navigation {

/// COMMIT: through the opening on `MissionMemory::committed`, which is frozen in odom; sightings on the way
/// that agree with it refine it, others are ignored. Heading along the normal. Ends standing still behind the
/// window; turns back only while the nose can still be stopped in front of the plane.
class Commit {
 public:
  explicit Commit(const NavigatorParams& params) : params_(params) {}

  void enter();
  Decision step(const Situation& situation, MissionMemory& memory);

  /// True if the contract with the committed window still holds for the rest of the way, grown by the drift
  /// since.
  static bool canResume(const Situation& situation, const MissionMemory& memory,
                        const NavigatorParams& params);

 private:
  void refine(const Situation& situation, MissionMemory& memory);
  void turnBackIfUnsafe(const Contract& contract, double blind_sec, Decision& decision) const;
  double forwardSpeed(const Contract& contract, const RelativeState& relative);

  NavigatorParams params_;
  std::optional<Eigen::Vector3d>
      entry_odom_m_;         ///< the window at the commit: no series of updates leads far from it
  bool is_through_ = false;  ///< has reached the exit distance once
};

}  // namespace window_ingress::navigation
