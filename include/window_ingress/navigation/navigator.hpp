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
#include "window_ingress/text/text.hpp"

namespace window_ingress::navigation {

/// The latest value of each input, if there is one. The navigator checks age and validity itself.
struct NavigatorInput {
  std::optional<VehicleState> vehicle;
  std::optional<TargetEstimate> target;
  /// Remembered position of the target, in view or not.
  std::optional<Eigen::Vector3d> remembered_odom_m;
  /// Stamp of the last image that was searched, with or without a window in it.
  std::optional<double> image_stamp_sec;
  /// The camera from calibration and mounting, which overrides the vehicle's parameters.
  std::optional<CameraInBody> camera;
  /// Why no image can give a pose, e.g. that there is no calibration; empty if there is no reason.
  std::string camera_fault;
  /// Armed and in a mode that follows setpoints; true if unknown.
  bool engaged = true;
  /// Setpoints of the navigator reach the autopilot; true if unknown.
  bool passed_on = true;
};

/// Response of the vehicle, measured in flight.
struct MeasuredVehicle {
  bool is_measured = false;        ///< false: the values are assumed
  double response_sec = 0.0;       ///< from a setpoint until the velocity follows it
  double acceleration_mps2 = 0.0;  ///< fastest change of velocity; infinite if no limit was seen
  Eigen::Vector3d velocity_bias_base_mps =
      Eigen::Vector3d::Zero();  ///< horizontal bias of odometry's velocity, already subtracted
  bool ignores_setpoints = false;  ///< told to move, it stands by odometry
};

/// Figures for people and reports; zero where they do not apply to the state.
struct NavigatorReport {
  bool has_relative = false;       ///< the next three are set
  double lateral_m = 0.0;          ///< y of the vehicle in the window frame, left positive [m]
  double vertical_m = 0.0;         ///< z of the vehicle in the window frame, up positive [m]
  double distance_m = 0.0;         ///< to the window's plane, positive in front [m]
  double commit_distance_m = 0.0;  ///< where COMMIT would begin now [m]
  double predicted_miss_m = 0.0;   ///< at the commit: offset, 3 sigma and drift, on the worse axis [m]
  double blind_sec = 0.0;       ///< longest time in COMMIT without sight of the window, up to its plane [s]
  int retries = 0;              ///< back-offs so far
  std::uint32_t window_id = 0;  ///< number of the window flown at; 0: none, or not numbered
  std::vector<std::uint32_t> given_up;  ///< windows abandoned on this mission, in that order
  MeasuredVehicle vehicle;
  bool next_window = false;  ///< after an abandoned window the next best becomes the target
};

struct NavigatorOutput {
  State state = State::kIdle;
  Setpoint setpoint;     ///< always finite and within the limits
  bool enabled = false;  ///< the setpoint is to be streamed
  std::string reason;    ///< why the state is what it is, for people; e.g. "odometry 0.41 s old"
  NavigatorReport report;
};

/// Overrides of the parameters `commit/...` for one mission; empty: the parameter is used.
struct MissionPolicy {
  std::string unverified_opening;  ///< ask, allow or deny
  std::string glass;               ///< possible or excluded
};

/// State machine, guidance and limiter. No clock inside: the caller gives `now_sec`, in the time of the
/// stamps.
///
/// Guarantees for any input:
/// - the setpoint is finite and within the limits; so are its changes, except when velocity is taken away;
/// - without fresh, finite odometry the setpoint is zero in the same step;
/// - no velocity towards the window unless its estimate is fresh and trusted and the vehicle is within the
///   funnel; only COMMIT flies on without sight, for a bounded time, if the commit criterion held when it
///   began;
/// - no sideways velocity from an estimate whose sign is not trusted.
class Navigator {
 public:
  /// \throws std::invalid_argument that lists every parameter out of range
  explicit Navigator(const NavigatorParams& params);
  ~Navigator();

  /// Refused with all unmet conditions listed.
  Reply start(const NavigatorInput& input, double now_sec, const MissionPolicy& policy = {});
  /// From any state, any number of times; the setpoint is zero from the next step on.
  Reply abort(const std::string& why = "aborted by the operator");
  Reply reset();  ///< from any end state back to IDLE
  /// The operator says that the window flown at now is open; this is forgotten when the window is given up.
  /// Refused before the navigator has asked. A window that was shown to be closed is abandoned anyway.
  Reply confirmOpening();

  NavigatorOutput step(const NavigatorInput& input, double now_sec);
  /// The caller sent zero instead of the last setpoint; the velocity grows from zero again.
  void sentZero();
  State state() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace window_ingress::navigation
