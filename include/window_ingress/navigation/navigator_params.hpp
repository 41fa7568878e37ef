/// Every number that the navigator flies by. Section `navigator` of config/navigator.yaml.
#pragma once

#include <string>

#include "window_ingress/navigation/vehicle_params.hpp"

namespace window_ingress::navigation {

/// When an input is believed. Ages count from the stamp of the measurement, i.e. for the window from the
/// exposure.
struct InputParams {
  double max_vehicle_age_sec = 0.25;  ///< odometry older than this: stop [s]
  double max_target_age_sec = 0.3;    ///< window not seen for longer than this: stop [s]
  double max_image_age_sec = 1.0;     ///< no image processed for longer than this: stop searching [s]
  double max_future_sec = 0.2;      ///< stamps this far ahead of now are believed (clock synchronisation) [s]
  double max_turned_rad = 0.7;      ///< the vehicle going so far beside what it is told: give up [rad]
  double max_target_jump_m = 0.4;   ///< window moving this far in odom between two estimates is a jump [m]
  double max_window_shift_m = 0.8;  ///< a window this far from the one flown at is another one [m]
  double target_jump_persist_sec = 0.5;  ///< a window that stays at its new place this long is believed [s]
  double max_target_tilt_rad = 0.26;     ///< a window leaning more than this is no window [rad]

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("max_vehicle_age_sec", self.max_vehicle_age_sec, 0.02, 1.0);
    field("max_target_age_sec", self.max_target_age_sec, 0.05, 1.0);
    field("max_image_age_sec", self.max_image_age_sec, 0.1, 5.0);
    field("max_future_sec", self.max_future_sec, 0.0, 0.5);
    field("max_turned_rad", self.max_turned_rad, 0.1, 3.2);
    field("max_target_jump_m", self.max_target_jump_m, 0.05, 5.0);
    field("max_window_shift_m", self.max_window_shift_m, 0.1, 10.0);
    field("target_jump_persist_sec", self.target_jump_persist_sec, 0.0, 5.0);
    field("max_target_tilt_rad", self.max_target_tilt_rad, 0.01, 1.0);
  }
};

/// SEARCH: turning on the spot, climbing to a height from which to look.
struct SearchParams {
  double yaw_rate_radps = 0.5;       ///< at most; slower where blur or few images ask for it [rad/s]
  double max_blur_px = 2.0;          ///< that turning may bring into an image [px]
  double max_turn_per_image = 0.25;  ///< of the field of view, from image to image
  double height_m = 1.0;             ///< climb to this height of odom first; never down [m]
  double height_step_m = 0.6;        ///< climb by this much after each turn without success [m]
  double climb_speed_mps = 0.3;      ///< [m/s]
  int turns = 3;                     ///< full turns before giving up
  int found_frames = 3;              ///< different images that must show the window
  bool next_window = false;  ///< after one that is closed or was tried in vain, the next best is flown at

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("yaw_rate_radps", self.yaw_rate_radps, 0.05, 3.0);
    field("max_blur_px", self.max_blur_px, 0.1, 50.0);
    field("max_turn_per_image", self.max_turn_per_image, 0.01, 1.0);
    field("height_m", self.height_m, -1000.0, 1000.0);
    field("height_step_m", self.height_step_m, 0.0, 5.0);
    field("climb_speed_mps", self.climb_speed_mps, 0.05, 2.0);
    field("turns", self.turns, 1, 100);
    field("found_frames", self.found_frames, 1, 100);
    field("next_window", self.next_window);
  }
};

/// ALIGN: onto the window's normal, the camera kept on the window; and the gains that APPROACH and COMMIT
/// share.
struct AlignParams {
  double lateral_gain_hz = 1.75;    ///< sideways and upward velocity per offset [1/s]
  double lateral_speed_mps = 0.75;  ///< most sideways [m/s]
  double vertical_speed_mps = 0.5;  ///< most upward and downward [m/s]
  double yaw_gain_hz = 3.0;         ///< yaw rate per bearing; keep above the lateral gain [1/s]
  double min_distance_m = 2.0;      ///< to the window's plane while aligning; closer, it moves away [m]
  double dwell_sec = 0.2;           ///< within the funnel this long before going on [s]
  double settle_sec = 1.2;          ///< ambiguous for this long: probe [s]
  double probe_amplitude_m = 0.5;   ///< height of the probe, first up, then down, each back to the start [m]
  double probe_speed_mps = 0.4;     ///< [m/s]
  int max_probes = 4;               ///< then give up
  double step_m = 0.25;             ///< length of a step where the scheme is stepped [m]
  double step_pause_sec = 0.5;      ///< look after such a step [s]

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("lateral_gain_hz", self.lateral_gain_hz, 0.05, 5.0);
    field("lateral_speed_mps", self.lateral_speed_mps, 0.05, 5.0);
    field("vertical_speed_mps", self.vertical_speed_mps, 0.05, 5.0);
    field("yaw_gain_hz", self.yaw_gain_hz, 0.1, 10.0);
    field("min_distance_m", self.min_distance_m, 0.5, 20.0);
    field("dwell_sec", self.dwell_sec, 0.0, 5.0);
    field("settle_sec", self.settle_sec, 0.0, 20.0);
    field("probe_amplitude_m", self.probe_amplitude_m, 0.05, 2.0);
    field("probe_speed_mps", self.probe_speed_mps, 0.05, 2.0);
    field("max_probes", self.max_probes, 0, 20);
    field("step_m", self.step_m, 0.05, 2.0);
    field("step_pause_sec", self.step_pause_sec, 0.0, 10.0);
  }
};

/// APPROACH: forward as far as the funnel allows.
struct ApproachParams {
  double speed_mps = 1.0;     ///< forward [m/s]
  double funnel_slope = 1.2;  ///< the funnel widens by this much a metre from the commit line on [m/m]
  double sigma_factor = 3.0;  ///< standard deviations that must lie within the funnel and the clearance
  double margin_m = 0.05;     ///< kept between body and border beyond all errors [m]
  double leave_factor = 1.3;  ///< out of the funnel by this factor: align again
  double leave_sec = 0.5;     ///< for this long [s]
  double patience_sec = 2.0;  ///< at the commit line with the commit criterion unmet: back off [s]

  double wind_sec = 0.6;          ///< smoothing of the velocity that wind adds [s]
  double max_wind_mps = 0.6;      ///< most that is taken off the command for it; 0: nothing [m/s]
  double gust_memory_sec = 15.0;  ///< over which the strength of gusts is measured [s]
  double gust_carry_sec = 0.75;   ///< a gust carries the vehicle off by its velocity times this [s]

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("wind_sec", self.wind_sec, 0.1, 20.0);
    field("max_wind_mps", self.max_wind_mps, 0.0, 2.0);
    field("gust_memory_sec", self.gust_memory_sec, 0.1, 60.0);
    field("gust_carry_sec", self.gust_carry_sec, 0.0, 10.0);
    field("speed_mps", self.speed_mps, 0.05, 5.0);
    field("funnel_slope", self.funnel_slope, 0.05, 2.0);
    field("sigma_factor", self.sigma_factor, 1.0, 10.0);
    field("margin_m", self.margin_m, 0.0, 1.0);
    field("leave_factor", self.leave_factor, 1.0, 10.0);
    field("leave_sec", self.leave_sec, 0.0, 10.0);
    field("patience_sec", self.patience_sec, 0.1, 30.0);
  }
};

/// COMMIT: through the opening on the last good estimate.
struct CommitParams {
  double speed_mps = 0.95;             ///< through the opening [m/s]
  double exit_distance_m = 1.0;        ///< behind the plane, where it stops [m]
  double standing_mps = 0.15;          ///< slower than this is standing still [m/s]
  double view_margin_m = 0.2;          ///< commit this much before the window leaves the view [m]
  double drift_m_per_sqrt_sec = 0.01;  ///< of the odometry, while nothing is seen [m/sqrt(s)]
  double max_heading_error_rad = 0.2;  ///< against the window's normal [rad]
  double max_lateral_speed_mps = 0.3;  ///< across the window's normal at the commit line [m/s]
  double max_blind_sec = 6.0;          ///< in front of the plane without seeing the window: turn back [s]
  double max_update_jump_m = 0.15;     ///< updates on the way that differ more are ignored [m]
  std::string glass = "possible";      ///< excluded: somebody has made sure that there is none in the window;
                                       ///< possible: ~confirm_opening is asked for before each COMMIT
  std::string unverified_opening = "ask";  ///< flying into what is not seen to be open; what is seen to be
                                           ///< closed is never flown at
  double ask_sec = 30.0;                   ///< at the commit line, for the operator's answer [s]
  double look_sec = 8.0;                   ///< at the commit line, for what is to be seen of the opening [s]
  double look_aside_m = 0.25;              ///< meanwhile, so far to either side; within the clearance [m]

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("speed_mps", self.speed_mps, 0.05, 5.0);
    field("exit_distance_m", self.exit_distance_m, 0.1, 10.0);
    field("standing_mps", self.standing_mps, 0.01, 1.0);
    field("view_margin_m", self.view_margin_m, 0.0, 2.0);
    field("drift_m_per_sqrt_sec", self.drift_m_per_sqrt_sec, 0.0, 1.0);
    field("max_heading_error_rad", self.max_heading_error_rad, 0.01, 1.0);
    field("max_lateral_speed_mps", self.max_lateral_speed_mps, 0.01, 2.0);
    field("max_blind_sec", self.max_blind_sec, 0.5, 30.0);
    field("max_update_jump_m", self.max_update_jump_m, 0.0, 1.0);
    field.choice("glass", self.glass, {"excluded", "possible"});
    field.choice("unverified_opening", self.unverified_opening, {"allow", "ask", "deny"});
    field("ask_sec", self.ask_sec, 0.1, 600.0);
    field("look_sec", self.look_sec, 0.1, 60.0);
    field("look_aside_m", self.look_aside_m, 0.0, 1.0);
  }
};

/// BACK_OFF: away along the last trusted normal.
struct BackOffParams {
  double speed_mps = 0.5;   ///< [m/s]
  double distance_m = 2.5;  ///< to the window's plane, from where it can be seen again [m]
  int max_retries = 5;      ///< back-offs before giving up

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("speed_mps", self.speed_mps, 0.05, 5.0);
    field("distance_m", self.distance_m, 0.5, 20.0);
    field("max_retries", self.max_retries, 0, 100);
  }
};

/// HOLD: zero velocity, then keeping the place, until the inputs are back. Wherever else the vehicle is to
/// stay it keeps its place likewise.
struct HoldParams {
  double speed_mps = 0.6;     ///< back to its place, at most; 0: never [m/s]
  double standing_mps = 0.2;  ///< its place is where it first is slower than this [m/s]
  double settle_sec = 0.8;    ///< or where it is after this time [s]
  double leash_m = 2.0;       ///< further from its place than this, somebody has moved it: another place [m]
  double dwell_sec = 0.2;     ///< inputs good for this long before moving on [s]
  double patience_sec = 1.0;  ///< wait this long for the window before backing off [s]
  double timeout_sec = 8.0;   ///< then give up [s]

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("speed_mps", self.speed_mps, 0.0, 1.0);
    field("standing_mps", self.standing_mps, 0.01, 1.0);
    field("settle_sec", self.settle_sec, 0.0, 10.0);
    field("leash_m", self.leash_m, 0.1, 100.0);
    field("dwell_sec", self.dwell_sec, 0.0, 5.0);
    field("patience_sec", self.patience_sec, 0.0, 30.0);
    field("timeout_sec", self.timeout_sec, 0.2, 60.0);
  }
};

/// How long each state may last before the mission is given up.
struct TimeoutParams {
  double search_sec = 90.0;    ///< [s]
  double align_sec = 40.0;     ///< [s]
  double approach_sec = 40.0;  ///< [s]
  double commit_sec = 15.0;    ///< [s]
  double back_off_sec = 20.0;  ///< [s]
  double total_sec = 180.0;    ///< of the mission [s]
  double stream_sec =
      3.0;  ///< zero setpoints after an abort, then none: the autopilot's own failsafe acts [s]

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
  std::string scheme = "continuous";  ///< continuous, or stepped: the paper's small steps, as a yardstick
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
