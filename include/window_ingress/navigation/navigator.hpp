#pragma once

#include <memory>
#include <string>

#include "window_ingress/navigation/input_monitor.hpp"
#include "window_ingress/navigation/mission_report.hpp"
#include "window_ingress/navigation/navigation_types.hpp"
#include "window_ingress/navigation/navigator_params.hpp"
#include "window_ingress/navigation/transition_table.hpp"

namespace window_ingress::navigation {

struct NavigatorOutput {
  State state = State::kIdle;
  Setpoint setpoint;     ///< always finite and within the limits
  bool enabled = false;  ///< the setpoint is to be streamed
  std::string reason;    ///< why the state is what it is, for people; e.g. "odometry 0.41 s old"
  NavigatorReport report;
};

/// Answer to a request: never silent.
struct Reply {
  bool success = false;
  std::string message;
};

/// What holds for one mission in place of the parameters `commit/...`; empty: as these are set.
struct MissionPolicy {
  std::string unverified_opening;  ///< ask, allow or deny
  std::string glass;               ///< possible or excluded
};

/// State machine, guidance and limiter. No clock inside: `now_sec` must come from the caller, in the time of
/// the stamps.
///
/// Holds whatever comes in:
/// - the setpoint is finite and within the limits; its changes too, except that velocity may be taken away at
/// once;
/// - without fresh, finite odometry the setpoint is zero in the same step;
/// - no velocity towards the window unless its estimate is fresh and trusted and the vehicle within the
/// funnel; COMMIT
///   alone flies on without sight, for a bounded time, by a contract that held when it began;
/// - no sideways velocity by an estimate whose sign is not trusted.
class Navigator {
 public:
  /// \throws std::invalid_argument that lists every parameter out of range
  explicit Navigator(const NavigatorParams& params);
  ~Navigator();

  /// Refused with all unmet conditions listed.
  Reply start(const NavigatorInput& input, double now_sec, const MissionPolicy& policy = {});
  Reply abort();  ///< from everywhere, any number of times; zero from the next step on
  Reply reset();  ///< from any end state back to IDLE
  /// The operator says that the window flown at now is open; forgotten when it is given up. Refused where
  /// none is. What was seen to be closed is left all the same.
  Reply confirmOpening();

  NavigatorOutput step(const NavigatorInput& input, double now_sec);
  /// The caller has sent zero in place of what the last step said: from there the velocity grows anew.
  void sentZero();
  State state() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace window_ingress::navigation
