#pragma once

#include "navigation/behaviours/behaviour.hpp"

namespace window_ingress::navigation {

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

}  // namespace window_ingress::navigation
