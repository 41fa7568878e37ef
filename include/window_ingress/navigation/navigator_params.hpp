/// Parameters of the navigator: section `navigator` of config/navigator.yaml.
#pragma once

#include <string>

#include "window_ingress/navigation/vehicle_params.hpp"

namespace window_ingress::navigation {

/// Limits of every setpoint, whatever a behaviour asks for.
struct LimitParams {
  double speed_mps = 1.0;                ///< largest velocity of a setpoint [m/s]
  double acceleration_mps2 = 2.0;        ///< fastest change of velocity from setpoint to setpoint [m/s^2]
  double jerk_mps3 = 30.0;               ///< fastest change of acceleration from setpoint to setpoint [m/s^3]
  double yaw_rate_radps = 0.5;           ///< largest yaw rate of a setpoint [rad/s]
  double yaw_acceleration_radps2 = 2.0;  ///< fastest change of yaw rate from setpoint to setpoint [rad/s^2]
  double min_height_m = 0.3;             ///< below this height in odom no setpoint descends [m]
  double max_height_m = 10.0;            ///< above this height in odom no setpoint climbs [m]
  double fence_radius_m = 25.0;          ///< no setpoint leads further than this from the start position [m]
  double wall_distance_m = 0.9;  ///< closer to the window's plane than this and outside the funnel, setpoints
                                 ///< lead only away from it [m]

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("speed_mps", self.speed_mps, 0.05, 5.0);
    field("acceleration_mps2", self.acceleration_mps2, 0.1, 10.0);
    field("jerk_mps3", self.jerk_mps3, 0.5, 1000.0);
    field("yaw_rate_radps", self.yaw_rate_radps, 0.05, 3.0);
    field("yaw_acceleration_radps2", self.yaw_acceleration_radps2, 0.1, 20.0);
    field("min_height_m", self.min_height_m, -1000.0, 1000.0);
    field("max_height_m", self.max_height_m, -1000.0, 1000.0);
    field("fence_radius_m", self.fence_radius_m, 1.0, 10000.0);
    field("wall_distance_m", self.wall_distance_m, 0.0, 20.0);
  }
};

/// When an input is accepted. Ages count from the stamp of the measurement; the window's from the exposure.
struct InputParams {
  double max_vehicle_age_sec = 0.35;  ///< older odometry stops the vehicle; so does a gap of 0.2 s [s]
  double max_target_age_sec = 0.3;    ///< a window estimate older than this stops the vehicle [s]
  double max_image_age_sec = 1.0;     ///< the search stops if no image was processed for longer than this [s]
  double max_turned_rad = 0.7;        ///< angle between commanded and flown direction that ends the mission,
                                      ///< because setpoints and odometry then differ in axes [rad]
  double max_target_jump_m = 0.4;  ///< a window that moves further than this in odom between two estimates is
                                   ///< accepted only after half a second at its new place [m]
  double max_future_sec = 0.2;     // not in `visit`: `VehicleParams::stamps` says it

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("max_vehicle_age_sec", self.max_vehicle_age_sec, 0.02, 1.0);
    field("max_target_age_sec", self.max_target_age_sec, 0.05, 1.0);
    field("max_image_age_sec", self.max_image_age_sec, 0.1, 5.0);
    field("max_turned_rad", self.max_turned_rad, 0.1, 3.2);
    field("max_target_jump_m", self.max_target_jump_m, 0.05, 5.0);
  }
};

/// SEARCH: turns on the spot and climbs to look from other heights.
struct SearchParams {
  double yaw_rate_radps = 0.5;  ///< maximum yaw rate; lower if blur or the image rate requires it [rad/s]
  double max_blur_px = 2.0;     ///< motion blur that turning may cause in an image [px]
  double height_m = 1.0;        ///< height in odom to climb to first; a vehicle above it keeps its height [m]
  double height_step_m = 0.6;   ///< climb after each full turn without success [m]
  double climb_speed_mps = 0.3;  ///< maximum climb speed [m/s]
  int turns = 3;                 ///< full turns without success before the mission is given up
  bool next_window = false;      ///< try the next best window when one is closed or all attempts at it failed

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("yaw_rate_radps", self.yaw_rate_radps, 0.05, 3.0);
    field("max_blur_px", self.max_blur_px, 0.1, 50.0);
    field("height_m", self.height_m, -1000.0, 1000.0);
    field("height_step_m", self.height_step_m, 0.0, 5.0);
    field("climb_speed_mps", self.climb_speed_mps, 0.05, 2.0);
    field("turns", self.turns, 1, 100);
    field("next_window", self.next_window);
  }
};

/// ALIGN: moves onto the window's normal while the camera points at the window. APPROACH and COMMIT use the
/// same gains.
struct AlignParams {
  double lateral_gain_hz = 1.75;    ///< sideways and upward velocity per metre of offset [1/s]
  double lateral_speed_mps = 0.75;  ///< maximum sideways speed [m/s]
  double vertical_speed_mps = 0.5;  ///< maximum upward and downward speed [m/s]
  double yaw_gain_hz = 3.0;         ///< yaw rate per radian of bearing; keep it above the lateral gain [1/s]
  double min_distance_m = 2.0;  ///< closer to the window's plane than this, the vehicle moves away first [m]
  double probe_amplitude_m = 0.5;  ///< height of a probe (up, back, down, back) that finds the sign of the
                                   ///< window's yaw [m]
  int max_probes = 4;              ///< height probes before the mission is given up
  double step_m = 0.25;            ///< length of a step of the stepped scheme [m]
  double step_pause_sec = 0.5;     ///< pause after a step of the stepped scheme [s]

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("lateral_gain_hz", self.lateral_gain_hz, 0.05, 5.0);
    field("lateral_speed_mps", self.lateral_speed_mps, 0.05, 5.0);
    field("vertical_speed_mps", self.vertical_speed_mps, 0.05, 5.0);
    field("yaw_gain_hz", self.yaw_gain_hz, 0.1, 10.0);
    field("min_distance_m", self.min_distance_m, 0.5, 20.0);
    field("probe_amplitude_m", self.probe_amplitude_m, 0.1, 2.0);
    field("max_probes", self.max_probes, 0, 20);
    field("step_m", self.step_m, 0.05, 2.0);
    field("step_pause_sec", self.step_pause_sec, 0.0, 10.0);
  }
};

/// APPROACH: flies forward as far as the funnel allows.
struct ApproachParams {
  double speed_mps = 1.0;     ///< maximum forward speed [m/s]
  double max_wind_mps = 0.6;  ///< largest wind that setpoints compensate; 0: none [m/s]
  double funnel_slope = 1.2;  ///< widening of the funnel for each metre in front of the commit line [m/m]
  double sigma_factor = 3.0;  ///< standard deviations that must lie within the funnel and the clearance
  double patience_sec = 2.0;  ///< wait at the commit line for the commit criterion before backing off [s]

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("speed_mps", self.speed_mps, 0.05, 5.0);
    field("max_wind_mps", self.max_wind_mps, 0.0, 2.0);
    field("funnel_slope", self.funnel_slope, 0.05, 2.0);
    field("sigma_factor", self.sigma_factor, 1.0, 10.0);
    field("patience_sec", self.patience_sec, 0.1, 30.0);
  }
};

/// COMMIT: flies through the opening on the last good estimate.
struct CommitParams {
  double speed_mps = 0.95;       ///< maximum speed through the opening [m/s]
  double exit_distance_m = 1.2;  ///< distance behind the window's plane at which the vehicle stops [m]
  double view_margin_m = 0.2;    ///< distance of the commit line in front of where the window leaves the view
                                 ///< [m]
  double max_blind_sec = 6.0;    ///< longest time without an image of the window in front of its plane; then
                                 ///< the vehicle turns back [s]
  std::string glass = "possible";  ///< excluded: the operator has made sure that the window has no glass;
                                   ///< possible: each COMMIT requires ~confirm_opening
  std::string unverified_opening = "ask";  ///< policy for an opening not shown to be open; a closed one is
                                           ///< never flown at
  double ask_sec = 30.0;                   ///< longest wait at the commit line for the operator's answer [s]
  double look_sec = 8.0;       ///< longest wait at the commit line for the opening to be verified [s]
  double look_aside_m = 0.25;  ///< sideways motion for parallax to verify the opening; at most the clearance
                               ///< [m]

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("speed_mps", self.speed_mps, 0.05, 5.0);
    field("exit_distance_m", self.exit_distance_m, 0.1, 10.0);
    field("view_margin_m", self.view_margin_m, 0.0, 2.0);
    field("max_blind_sec", self.max_blind_sec, 0.5, 30.0);
    field.choice("glass", self.glass, {"excluded", "possible"});
    field.choice("unverified_opening", self.unverified_opening, {"allow", "ask", "deny"});
    field("ask_sec", self.ask_sec, 0.1, 600.0);
    field("look_sec", self.look_sec, 0.1, 60.0);
    field("look_aside_m", self.look_aside_m, 0.0, 1.0);
  }
};

/// BACK_OFF: flies away along the last trusted normal.
struct BackOffParams {
  double speed_mps = 0.5;   ///< maximum speed away from the window [m/s]
  double distance_m = 2.5;  ///< distance to the window's plane from which the window can be seen again [m]
  int max_retries = 5;      ///< number of back-offs before the mission is given up

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("speed_mps", self.speed_mps, 0.05, 5.0);
    field("distance_m", self.distance_m, 0.5, 20.0);
    field("max_retries", self.max_retries, 0, 100);
  }
};

/// HOLD and every other stop: zero velocity, then position hold.
struct HoldParams {
  double speed_mps = 0.6;  ///< maximum speed back to the held position; 0: the vehicle does not return [m/s]
  double leash_m = 2.0;    ///< displaced further than this, the vehicle holds its new position [m]
  double patience_sec = 1.0;  ///< longest wait for the window in HOLD before backing off [s]
  double timeout_sec = 8.0;   ///< longest HOLD before the mission is given up [s]

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("speed_mps", self.speed_mps, 0.0, 1.0);
    field("leash_m", self.leash_m, 0.1, 100.0);
    field("patience_sec", self.patience_sec, 0.0, 30.0);
    field("timeout_sec", self.timeout_sec, 0.2, 60.0);
  }
};

/// How long each state may last before the mission is given up.
struct TimeoutParams {
  double search_sec = 90.0;    ///< longest SEARCH [s]
  double align_sec = 40.0;     ///< longest ALIGN [s]
  double approach_sec = 40.0;  ///< longest APPROACH; `commit/ask_sec` more once the operator is asked [s]
  double commit_sec = 15.0;    ///< longest COMMIT [s]
  double back_off_sec = 20.0;  ///< longest BACK_OFF [s]
  double total_sec = 180.0;    ///< longest mission [s]
  double stream_sec = 3.0;  ///< zero setpoints are sent for this long after an abort, then none, so that the
                            ///< autopilot's failsafe acts [s]

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("search_sec", self.search_sec, 1.0, 3600.0);
    field("align_sec", self.align_sec, 1.0, 3600.0);
    field("approach_sec", self.approach_sec, 1.0, 3600.0);
    field("commit_sec", self.commit_sec, 1.0, 3600.0);
    field("back_off_sec", self.back_off_sec, 1.0, 3600.0);
    field("total_sec", self.total_sec, 1.0, 36000.0);
    field("stream_sec", self.stream_sec, 0.0, 60.0);
  }
};

struct NavigatorParams {
  std::string scheme = "continuous";  ///< stepped: the paper's small steps with pauses, for comparison
  InputParams input;
  VehicleParams vehicle;  // not in `visit`: it has a file of its own, config/vehicle.yaml
  LimitParams limits;
  SearchParams search;
  AlignParams align;
  ApproachParams approach;
  CommitParams commit;
  BackOffParams back_off;
  HoldParams hold;
  TimeoutParams timeouts;

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field.choice("scheme", self.scheme, {"continuous", "stepped"});
    field.group("input", self.input);
    field.group("limits", self.limits);
    field.group("search", self.search);
    field.group("align", self.align);
    field.group("approach", self.approach);
    field.group("commit", self.commit);
    field.group("back_off", self.back_off);
    field.group("hold", self.hold);
    field.group("timeouts", self.timeouts);
  }
};

}  // namespace window_ingress::navigation
