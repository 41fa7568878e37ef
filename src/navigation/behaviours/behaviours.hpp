#pragma once

#include "navigation/behaviours/align.hpp"
#include "navigation/behaviours/approach.hpp"
#include "navigation/behaviours/back_off.hpp"
#include "navigation/behaviours/commit.hpp"
#include "navigation/behaviours/hold.hpp"
#include "navigation/behaviours/search.hpp"

namespace window_ingress::navigation {

/// One behaviour for each state that has one.
class Behaviours {
 public:
  explicit Behaviours(const NavigatorParams& params)
      : search_(params),
        align_(params),
        approach_(params),
        commit_(params),
        back_off_(params),
        hold_(params) {}
  explicit Behaviours(NavigatorParams&&) = delete;  ///< they are looked at in every step

  void startMission() { was_near_ = false; }
  /// \param state begins, \param from was left for it
  void enter(State state, State from, double now_sec);
  /// Nothing for a state that has no behaviour.
  std::optional<Decision> step(State state, const Situation& situation, MissionState& memory);

 private:
  Search search_;
  Align align_;
  Approach approach_;
  Commit commit_;
  BackOff back_off_;
  Hold hold_;
  bool was_near_ = false;  ///< of the window, on this mission
};

}  // namespace window_ingress::navigation
