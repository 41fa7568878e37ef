/// Parameters of camera, odometry and IMU, and of faults; see `Scenario`. doc/scenarios.md has the table of
/// the effect of each kind of fault on each unit.
#pragma once

#include <Eigen/Geometry>
#include <string>

#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::simulation {

/// The camera and its mounting.
struct CameraParams {
  int width_px = 640;                 ///< width of the image [px]
  int height_px = 480;                ///< height of the image [px]
  std::string lens = "plumb_bob";     ///< model of the lens's distortion; equidistant: a fisheye
  double horizontal_fov_rad = 1.20;   ///< field of view without distortion; at most 2.4 for plumb_bob [rad]
  double k1 = 0.0;                    ///< radial distortion of the lens's model
  double k2 = 0.0;                    ///< radial distortion
  double p1 = 0.0;                    ///< tangential distortion, plumb_bob only
  double p2 = 0.0;                    ///< tangential distortion, plumb_bob only
  double k3 = 0.0;                    ///< radial distortion
  double k4 = 0.0;                    ///< radial distortion, equidistant only
  std::string calibration_file = "";  ///< yaml file that replaces size, lens, field of view and distortion
  double x_m = 0.10;                  ///< position of the camera, forward of the vehicle's centre [m]
  double y_m = 0.0;                   ///< position of the camera, to the left [m]
  double z_m = 0.02;                  ///< position of the camera, up [m]
  double pitch_rad = 0.0;             ///< pitch of the camera; positive: looks down [rad]
  double yaw_rad = 0.0;               ///< yaw of the camera; positive: looks left [rad]
  double told_pitch_error_rad = 0.0;  ///< error of the mounting's pitch as told to the vehicle [rad]
  double told_yaw_error_rad = 0.0;    ///< error of the mounting's yaw as told to the vehicle [rad]
  double rate_hz = 30.0;              ///< images per second [1/s]
  double latency_sec = 0.03;          ///< from exposure to delivery [s]
  double latency_jitter_sec = 0.0;    ///< largest additional delay of an image, evenly distributed [s]
  double drop_probability = 0.0;      ///< probability that an image is lost
  double exposure_sec = 0.004;        ///< exposure time, centred on the image's stamp [s]
  double readout_sec = 0.0;  ///< delay of the last row's exposure after the first row's; 0: all at once [s]
  double noise_grey = 2.0;   ///< noise of a black pixel, standard deviation per channel [grey levels]
  double shot_noise_grey = 0.0;    ///< noise of white, added in squares times grey / 255 [grey levels]
  double blur_px = 0.6;            ///< standard deviation of the lens's blur [px]
  double gain = 1.0;               ///< factor on all brightness; with auto exposure only for the first image
  bool auto_exposure = false;      ///< brings the image's mean to `target_grey`
  double target_grey = 110.0;      ///< target of the auto exposure [grey levels]
  double auto_exposure_sec = 0.3;  ///< time constant of auto exposure and white balance [s]
  double least_gain = 0.25;        ///< smallest gain of the auto exposure
  double greatest_gain = 4.0;      ///< largest gain of the auto exposure
  double colour_temperature_k = 6500.0;  ///< colour temperature; 6500: neutral, less: reddish [K]
  bool auto_white_balance = false;       ///< brings the means of red and blue to the mean of green
  std::string antialiasing = "edges";  ///< edges: exact areas, fast; multisampling: 4 samples, the reference
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("width_px", self.width_px, 64, 1920);
    field("height_px", self.height_px, 48, 1440);
    field.choice("lens", self.lens, {"plumb_bob", "equidistant"});
    field("horizontal_fov_rad", self.horizontal_fov_rad, 0.2, 2.8);
    field("k1", self.k1, -1.0, 1.0);
    field("k2", self.k2, -1.0, 1.0);
    field("p1", self.p1, -0.1, 0.1);
    field("p2", self.p2, -0.1, 0.1);
    field("k3", self.k3, -1.0, 1.0);
    field("k4", self.k4, -1.0, 1.0);
    field("calibration_file", self.calibration_file);
    field("x_m", self.x_m, -1.0, 1.0);
    field("y_m", self.y_m, -1.0, 1.0);
    field("z_m", self.z_m, -1.0, 1.0);
    field("pitch_rad", self.pitch_rad, -1.5, 1.5);
    field("yaw_rad", self.yaw_rad, -3.15, 3.15);
    field("told_pitch_error_rad", self.told_pitch_error_rad, -0.5, 0.5);
    field("told_yaw_error_rad", self.told_yaw_error_rad, -0.5, 0.5);
    field("rate_hz", self.rate_hz, 1.0, 120.0);
    field("latency_sec", self.latency_sec, 0.0, 1.0);
    field("latency_jitter_sec", self.latency_jitter_sec, 0.0, 1.0);
    field("drop_probability", self.drop_probability, 0.0, 1.0);
    field("exposure_sec", self.exposure_sec, 0.0, 0.1);
    field("readout_sec", self.readout_sec, 0.0, 0.1);
    field("noise_grey", self.noise_grey, 0.0, 40.0);
    field("shot_noise_grey", self.shot_noise_grey, 0.0, 40.0);
    field("blur_px", self.blur_px, 0.0, 5.0);
    field("gain", self.gain, 0.1, 4.0);
    field("auto_exposure", self.auto_exposure);
    field("target_grey", self.target_grey, 1.0, 254.0);
    field("auto_exposure_sec", self.auto_exposure_sec, 0.01, 60.0);
    field("least_gain", self.least_gain, 0.01, 100.0);
    field("greatest_gain", self.greatest_gain, 0.01, 100.0);
    field("colour_temperature_k", self.colour_temperature_k, 2000.0, 20000.0);
    field("auto_white_balance", self.auto_white_balance);
    field.choice("antialiasing", self.antialiasing, {"edges", "multisampling"});
  }
  /// \throws InputError as `parameters::readCalibrationFile` for a bad `calibration_file`
  geometry::PinholeCamera model() const;
  Eigen::Isometry3d T_base_camera() const;
  /// The mounting as told to the vehicle, errors included.
  Eigen::Isometry3d toldT_base_camera() const;
};

/// Errors of the vehicle's odometry.
struct OdometryParams {
  double rate_hz = 50.0;             ///< samples per second [1/s]
  double latency_sec = 0.03;         ///< from measurement to delivery [s]
  double jitter_sec = 0.0;           ///< largest additional delay of a sample, evenly distributed [s]
  double burst_period_sec = 0.0;     ///< samples are delivered together at multiples of this; 0: at once [s]
  double stamp_offset_sec = 0.0;     ///< error of the stamp; positive: after the time of measurement [s]
  double estimate_delay_sec = 0.01;  ///< age of the velocity in the vehicle's own velocity loop [s]
  double position_noise_m = 0.004;   ///< white noise of the position, standard deviation per axis [m]
  double velocity_noise_mps = 0.02;  ///< white noise of the velocity, standard deviation per axis [m/s]
  double velocity_bias_mps = 0.0;    ///< steady horizontal velocity error in the body, random direction [m/s]
  double velocity_bias_spread_mps = 0.0;  ///< half range of the random size of velocity_bias_mps [m/s]
  double velocity_wander_mps = 0.0;  ///< slow velocity error, standard deviation per horizontal axis [m/s]
  double velocity_wander_correlation_sec = 3.5;  ///< correlation time of velocity_wander_mps [s]
  double own_bias_part = 0.0;         ///< share of the velocity errors in the vehicle's own velocity loop
  double attitude_noise_rad = 0.004;  ///< white noise of the attitude, standard deviation per axis [rad]
  double heading_error_rad = 0.0;     ///< steady heading error that positions do not show: drawn up to this,
                                      ///< either way [rad]
  double scale_error = 0.0;           ///< relative error of reported horizontal motion; positive: too long
  double wander_m = 0.0;  ///< slowly varying position error, standard deviation per horizontal axis [m]
  double wander_correlation_sec = 5.0;  ///< correlation time of wander_m [s]
  double drift_m_per_sqrt_sec = 0.01;   ///< random walk of the position per horizontal axis [m/sqrt(s)]
  double height_drift_m_per_sqrt_sec = 0.004;  ///< random walk of the height [m/sqrt(s)]
  double yaw_drift_rad_per_sqrt_sec = 0.0015;  ///< random walk of the heading [rad/sqrt(s)]
  double height_factor_per_m = 0.0;  ///< growth of horizontal noise and drift per metre above ground [1/m]
  double texture_quality = 1.0;  ///< ground texture; divides horizontal noise and drift; at least 0.05 counts
  std::string twist_frame = "body";  ///< axes of the reported velocity; world: those of odom
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("rate_hz", self.rate_hz, 5.0, 400.0);
    field("latency_sec", self.latency_sec, 0.0, 1.0);
    field("jitter_sec", self.jitter_sec, 0.0, 1.0);
    field("burst_period_sec", self.burst_period_sec, 0.0, 1.0);
    field("stamp_offset_sec", self.stamp_offset_sec, -1.0, 1.0);
    field("estimate_delay_sec", self.estimate_delay_sec, 0.0, 0.3);
    field("position_noise_m", self.position_noise_m, 0.0, 1.0);
    field("velocity_noise_mps", self.velocity_noise_mps, 0.0, 1.0);
    field("velocity_bias_mps", self.velocity_bias_mps, 0.0, 1.0);
    field("velocity_bias_spread_mps", self.velocity_bias_spread_mps, 0.0, 1.0);
    field("velocity_wander_mps", self.velocity_wander_mps, 0.0, 1.0);
    field("velocity_wander_correlation_sec", self.velocity_wander_correlation_sec, 0.1, 300.0);
    field("own_bias_part", self.own_bias_part, 0.0, 1.0);
    field("attitude_noise_rad", self.attitude_noise_rad, 0.0, 0.3);
    field("heading_error_rad", self.heading_error_rad, 0.0, 0.5);
    field("scale_error", self.scale_error, -0.5, 0.5);
    field("wander_m", self.wander_m, 0.0, 2.0);
    field("wander_correlation_sec", self.wander_correlation_sec, 0.1, 300.0);
    field("drift_m_per_sqrt_sec", self.drift_m_per_sqrt_sec, 0.0, 1.0);
    field("height_drift_m_per_sqrt_sec", self.height_drift_m_per_sqrt_sec, 0.0, 1.0);
    field("yaw_drift_rad_per_sqrt_sec", self.yaw_drift_rad_per_sqrt_sec, 0.0, 0.2);
    field("height_factor_per_m", self.height_factor_per_m, 0.0, 5.0);
    field("texture_quality", self.texture_quality, 0.0, 1.0);
    field.choice("twist_frame", self.twist_frame, {"body", "world"});
  }
};

/// Errors of the attitude estimator and the inertial sensors.
struct ImuParams {
  double rate_hz = 100.0;                 ///< samples per second [1/s]
  double latency_sec = 0.0;               ///< from measurement to delivery [s]
  double stamp_offset_sec = 0.0;          ///< error of the stamp; positive: after the time of measurement [s]
  double roll_bias_rad = 0.0;             ///< constant error of roll [rad]
  double pitch_bias_rad = 0.0;            ///< constant error of pitch [rad]
  double attitude_noise_rad = 0.006;      ///< error of roll and pitch, standard deviation [rad]
  double attitude_correlation_sec = 0.5;  ///< correlation time of attitude_noise_rad; 0: white noise [s]
  double gyro_bias_radps = 0.0;     ///< constant gyroscope error, drawn; standard deviation per axis [rad/s]
  double gyro_noise_radps = 0.004;  ///< white noise of the gyroscope, each axis [rad/s]
  double accelerometer_noise_mps2 = 0.08;  ///< white noise of the accelerometer, each axis [m/s^2]
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("rate_hz", self.rate_hz, 5.0, 400.0);
    field("latency_sec", self.latency_sec, 0.0, 1.0);
    field("stamp_offset_sec", self.stamp_offset_sec, -1.0, 1.0);
    field("roll_bias_rad", self.roll_bias_rad, -0.3, 0.3);
    field("pitch_bias_rad", self.pitch_bias_rad, -0.3, 0.3);
    field("attitude_noise_rad", self.attitude_noise_rad, 0.0, 0.3);
    field("attitude_correlation_sec", self.attitude_correlation_sec, 0.0, 60.0);
    field("gyro_bias_radps", self.gyro_bias_radps, 0.0, 0.5);
    field("gyro_noise_radps", self.gyro_noise_radps, 0.0, 1.0);
    field("accelerometer_noise_mps2", self.accelerometer_noise_mps2, 0.0, 10.0);
  }
};

/// One temporary fault of the world.
struct FaultParams {
  std::string unit = "image";   ///< part of the world with the fault
  std::string kind = "off";     ///< what the fault does to the unit
  double at_sec = 5.0;          ///< start of the fault, in the world's time [s]
  double duration_sec = 2.0;    ///< duration of the fault [s]
  double rate_hz = 1.0;         ///< slow: remaining samples per second [1/s]
  double delay_sec = 1.0;       ///< delayed: additional delay of every sample [s]
  double off_sec = 0.5;         ///< intermittent: length of each gap; a gap comes first [s]
  double on_sec = 0.5;          ///< intermittent: length of normal operation after each gap [s]
  double jump_m = 4.0;          ///< wrong odom, tf: error of the position along the frame's x [m]
  double slide_mps = 0.5;       ///< slide: drift of the position that the velocity does not show [m/s]
  double direction_rad = 0.0;   ///< slide: direction of the drift, from the frame's x towards its y [rad]
  double turn_rad = 1.5707963;  ///< wrong odom, tf: error of the heading [rad]
  double tilt_rad = 0.5;        ///< wrong imu: error of the attitude, in roll [rad]
  double zoom = 1.3;            ///< wrong camera_info: factor on the focal lengths
  double back_sec = 5.0;        ///< wrong clock: delay of the clock [s]
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field.choice("unit", self.unit,
                 {"image", "camera_info", "odom", "imu", "tf", "clock", "cmd_vel", "guard"});
    field.choice("kind", self.kind,
                 {"off", "stuck", "garbage", "wrong", "slow", "delayed", "intermittent", "slide"});
    field("at_sec", self.at_sec, 0.0, 3600.0);
    field("duration_sec", self.duration_sec, 0.01, 3600.0);
    field("rate_hz", self.rate_hz, 0.1, 100.0);
    field("delay_sec", self.delay_sec, 0.01, 10.0);
    field("off_sec", self.off_sec, 0.01, 60.0);
    field("on_sec", self.on_sec, 0.01, 60.0);
    field("jump_m", self.jump_m, -100.0, 100.0);
    field("slide_mps", self.slide_mps, 0.0, 50.0);
    field("direction_rad", self.direction_rad, -3.15, 3.15);
    field("turn_rad", self.turn_rad, -3.15, 3.15);
    field("tilt_rad", self.tilt_rad, -3.15, 3.15);
    field("zoom", self.zoom, 0.1, 10.0);
    field("back_sec", self.back_sec, 0.01, 100.0);
  }
};

/// Why this fault is impossible: the kind has no useful effect on the unit. Empty if it is possible.
std::string whyNoSuchFault(const FaultParams& fault);
/// As above, for an external vehicle, whose data does not come from this world.
std::string whyNotBesideExternalVehicle(const FaultParams& fault);

}  // namespace window_ingress::simulation
