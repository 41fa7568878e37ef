#pragma once

#include "navigation/behaviours/behaviour.hpp"

namespace window_ingress::navigation {

/// HOLD: zero velocity. Where images alone are missing, back from the window after a while. Once the inputs
/// are back for a while, goes on from where it can: the commit, the window, its memory, or a new search.
/// Gives up when they do not come back.
class Hold {
 public:
  explicit Hold(const NavigatorParams& params) : params_(&params) {}
  explicit Hold(NavigatorParams&&) = delete;  ///< they are looked at in every step

  /// \param from the state that was left for the hold
  void enter(State from);
  Decision step(const Situation& situation, const MissionState& memory);

 private:
  bool mayRetreat(const Situation& situation, const MissionState& memory) const;
  std::optional<Event> wayOn(const Situation& situation, const MissionState& memory,
                             std::string& reason) const;

  const NavigatorParams* params_;
  State from_ = State::kSearch;
  double held_sec_ = 0.0;
  double good_sec_ = 0.0;
};

}  // namespace window_ingress::navigation
