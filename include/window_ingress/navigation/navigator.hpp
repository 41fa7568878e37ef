#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "window_ingress/navigation/camera_in_body.hpp"
#include "window_ingress/navigation/navigation_types.hpp"
#include "window_ingress/navigation/navigator_params.hpp"
#include "window_ingress/navigation/transition_table.hpp"

namespace window_ingress::navigation {

/// The latest of everything, or nothing. The navigator itself judges age and sanity.
struct NavigatorInput {
  std::optional<VehicleState> vehicle;
  std::optional<TargetEstimate> target;
  /// Where the target is by the memory of all windows, in view or not.
  std::optional<Eigen::Vector3d> remembered_odom_m;
  /// Stamp of the last image that was searched, with or without a window in it.
  std::optional<double> image_stamp_sec;
  /// The camera by calibration and mounting, in place of what the vehicle's parameters say of it; empty:
  /// these count.
  std::optional<CameraInBody> camera;
  /// Why no image can give a pose, e.g. that there is no calibration; empty if there is no reason.
  std::string camera_fault;
  /// Armed and in a mode that follows setpoints; true where that is not known.
  bool engaged = true;
  /// What the navigator says reaches the autopilot; true where that is not known.
  bool passed_on = true;
};

/// How the vehicle answers, as measured in flight.
struct MeasuredVehicle {
  bool is_measured = false;        ///< else as assumed
  double response_sec = 0.0;       ///< from a setpoint to the velocity following it
  double acceleration_mps2 = 0.0;  ///< it changes its velocity no faster; infinite where no limit has shown
  Eigen::Vector3d velocity_bias_base_mps =
      Eigen::Vector3d::Zero();  ///< of odometry's velocity, taken off; level
};

/// Figures for people and reports; zero where the state has nothing to say.
struct NavigatorReport {
  bool has_relative = false;       ///< the next three are set
  double lateral_m = 0.0;          ///< of the vehicle in the window frame: y, left positive [m]
  double vertical_m = 0.0;         ///< z, up positive [m]
  double distance_m = 0.0;         ///< to the window's plane, positive in front [m]
  double commit_distance_m = 0.0;  ///< where COMMIT would begin now [m]
  double predicted_miss_m = 0.0;   ///< at the commit: offset, 3 sigma and drift, of the worse axis [m]
  double blind_sec = 0.0;       ///< longest time in COMMIT without sight of the window, up to its plane [s]
  int retries = 0;              ///< back-offs so far
  std::uint32_t window_id = 0;  ///< of the window flown at; 0: none, or it has no number
  std::vector<std::uint32_t> given_up;  ///< windows left for good on this mission, in that order
  MeasuredVehicle vehicle;
  bool next_window = false;  ///< after one of these the next best is to be the target
};

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
/// - the setpoint is finite and within the limits; so are its changes, but for velocity that is taken away;
/// - without fresh, finite odometry the setpoint is zero in the same step;
/// - no velocity towards the window unless its estimate is fresh and trusted and the vehicle within the
///   funnel; COMMIT alone flies on without sight, for a bounded time, by the commit criterion that held when
///   it began;
/// - no sideways velocity by an estimate whose sign is not trusted.
class Navigator {
 public:
  /// \throws std::invalid_argument that lists every parameter out of range
  explicit Navigator(const NavigatorParams& params);
  ~Navigator();

  /// Refused with all unmet conditions listed.
  Reply start(const NavigatorInput& input, double now_sec, const MissionPolicy& policy = {});
  /// From everywhere, any number of times; zero from the next step on.
  Reply abort(const std::string& why = "aborted by the operator");
  Reply reset();  ///< from any end state back to IDLE
  /// The operator says that the window flown at now is open; forgotten when it is given up. Refused where
  /// nobody has asked: before a pane could be seen. What was seen to be closed is left all the same.
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
