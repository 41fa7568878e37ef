/// What a state does in one step: a wished setpoint, an optional event, and the reason.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "navigation/mission/mission_state.hpp"
#include "navigation/motion/input_monitor.hpp"
#include "window_ingress/navigation/commit_criterion.hpp"
#include "window_ingress/navigation/transition_table.hpp"

namespace window_ingress::navigation {

constexpr int kFoundImages = 3;  ///< distinct images that must show a window before the vehicle flies at it

struct Decision {
  Setpoint wish;
  bool keeps_place = false;  ///< the vehicle keeps its place on every axis without a wished velocity
  std::optional<Event> event;
  std::string reason;
};

/// What the vehicle does in one state, from entering to leaving that state.
class Behaviour {
 public:
  explicit Behaviour(const NavigatorParams& params) : params_(&params) {}
  explicit Behaviour(NavigatorParams&&) = delete;  ///< the parameters must outlive this
  virtual ~Behaviour() = default;

  virtual Decision step(const Situation& situation, MissionState& mission) = 0;

 protected:
  const NavigatorParams* params_;
};

/// The behaviour of a new state; null if the state has none. \param from the state before \param may_climb
/// see `Search`
std::unique_ptr<Behaviour> behaviourOf(State state, State from, double now_sec, bool may_climb,
                                       const NavigatorParams& params);

/// How long the condition has held [s]; negative if it does not hold. Updates the time at which it began.
double heldSec(bool condition, double now_sec, std::optional<double>& since_sec);

/// The commit criterion for this window, now. \param unseen_sec time since the last information about it
CommitCriterion criterionWith(const TargetEstimate& target, const Situation& situation,
                              const MissionState& mission, const NavigatorParams& params,
                              double unseen_sec = 0.0);

}  // namespace window_ingress::navigation
