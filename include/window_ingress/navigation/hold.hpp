#pragma once

#include "window_ingress/navigation/behaviour.hpp"

namespace window_ingress::navigation {

/// HOLD: zero velocity. Once the inputs are back for a while, goes on from where it can: the commit, the
/// window, its memory, or a new search. Gives up when they do not come back.
class Hold {
 public:
  explicit Hold(const NavigatorParams& params) : params_(params) {}

  /// \param from the state that was left for the hold
  void enter(State from, double now_sec);
  Decision step(const Situation& situation, const MissionMemory& memory);

 private:
  std::optional<Event> wayOn(const Situation& situation, const MissionMemory& memory, double held_sec,
                             std::string& reason) const;

  NavigatorParams params_;
  State from_ = State::kSearch;
  double since_sec_ = 0.0;
  std::optional<double> good_since_sec_;
};

}  // namespace window_ingress::navigation
