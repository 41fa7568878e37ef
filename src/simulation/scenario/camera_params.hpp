/// Parameters of the camera; see `Scenario`.
#pragma once

#include <Eigen/Geometry>
#include <string>

#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::simulation {

/// The camera and how it is mounted.
struct CameraParams {
  int width_px = 640;                 ///< of the image [px]
  int height_px = 480;                ///< of the image [px]
  std::string lens = "plumb_bob";     ///< model of its distortion; equidistant: a fisheye
  double horizontal_fov_rad = 1.20;   ///< of the lens without its distortion; plumb_bob: 2.4 at most [rad]
  double k1 = 0.0;                    ///< radial distortion of the lens's model
  double k2 = 0.0;                    ///< radial distortion
  double p1 = 0.0;                    ///< tangential distortion, of plumb_bob only
  double p2 = 0.0;                    ///< tangential distortion, of plumb_bob only
  double k3 = 0.0;                    ///< radial distortion
  double k4 = 0.0;                    ///< radial distortion, of equidistant only
  std::string calibration_file = "";  ///< yaml file in place of size, lens, field of view and distortion
  double x_m = 0.10;                  ///< of the camera, forward of the vehicle's centre [m]
  double y_m = 0.0;                   ///< of the camera, to the left [m]
  double z_m = 0.02;                  ///< of the camera, up [m]
  double pitch_rad = 0.0;             ///< of the camera: looking down is positive [rad]
  double yaw_rad = 0.0;               ///< of the camera: looking left is positive [rad]
  double told_pitch_error_rad =
      0.0;                          ///< of what the vehicle is told of its mounting, beside `pitch_rad` [rad]
  double told_yaw_error_rad = 0.0;  ///< likewise, beside `yaw_rad` [rad]
  double rate_hz = 30.0;            ///< images a second [1/s]
  double latency_sec = 0.03;        ///< from exposure to delivery [s]
  double latency_jitter_sec = 0.0;  ///< an image takes up to so much longer, evenly distributed [s]
  double drop_probability = 0.0;    ///< that an image is lost
  double exposure_sec = 0.004;      ///< the shutter is open so long, around the image's stamp [s]
  double readout_sec = 0.0;      ///< the last row is exposed so much later than the first; 0: all at once [s]
  double noise_grey = 2.0;       ///< of a black pixel, standard deviation of each channel [grey levels]
  double shot_noise_grey = 0.0;  ///< added in squares, times grey / 255: that of white [grey levels]
  double blur_px = 0.6;          ///< standard deviation of the lens's blur [px]
  double gain = 1.0;             ///< all brightness times this; with auto exposure: of the first image
  bool auto_exposure = false;    ///< brings the image's mean to `target_grey`
  double target_grey = 110.0;    ///< of the auto exposure [grey levels]
  double auto_exposure_sec = 0.3;        ///< time constant of auto exposure and auto white balance [s]
  double least_gain = 0.25;              ///< of the auto exposure
  double greatest_gain = 4.0;            ///< of the auto exposure
  double colour_temperature_k = 6500.0;  ///< of the light; 6500: neutral, less: reddish [K]
  bool auto_white_balance = false;       ///< brings the means of red and blue to that of green
  std::string antialiasing =
      "edges";  ///< edges: by exact area, fast; multisampling: 4 samples, the reference
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
  /// The mounting as the vehicle is told of it.
  Eigen::Isometry3d toldT_base_camera() const;
};

}  // namespace window_ingress::simulation
