#pragma once

#include <memory>
#include <optional>
#include <string>

#include "window_ingress/navigation/navigation_types.hpp"
#include "window_ingress/navigation/navigator_params.hpp"
#include "window_ingress/navigation/transition_table.hpp"

namespace window_ingress::navigation {

/// The latest of everything, or nothing. The navigator itself judges age and sanity.
struct NavigatorInput {
  std::optional<VehicleState> vehicle;
  std::optional<TargetEstimate> target;
};

struct NavigatorOutput {
  State state = State::kIdle;
  Setpoint setpoint;   ///< always finite and within the limits
  bool enabled = false;  ///< the setpoint is to be streamed
  std::string reason;  ///< why the state is what it is, for people; e.g. "odometry 0.41 s old"
};

/// Answer to a request: never silent.
struct Reply {
  bool success = false;
  std::string message;
};

/// State machine, guidance and limiter. No clock inside: `now_sec` must come from the caller, in the time of the stamps.
class Navigator {
 public:
  /// \throws std::invalid_argument that lists every parameter out of range
  explicit Navigator(const NavigatorParams& params);
  ~Navigator();

  Reply start(const NavigatorInput& input, double now_sec);  ///< refused with all unmet conditions listed
  Reply abort();
  Reply reset();  ///< from any end state back to IDLE

  NavigatorOutput step(const NavigatorInput& input, double now_sec);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace window_ingress::navigation
