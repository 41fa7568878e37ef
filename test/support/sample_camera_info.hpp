#pragma once

#include <sensor_msgs/CameraInfo.h>

namespace window_ingress::test {

/// A calibrated camera. K and P differ, so that tests notice if they are confused.
inline sensor_msgs::CameraInfo sampleCameraInfo() {
  sensor_msgs::CameraInfo info;
  info.width = 640;
  info.height = 480;
  info.distortion_model = "plumb_bob";
  info.D = {-0.2, 0.05, 0.001, -0.002, 0.0};
  info.K = {554.0, 0.0, 319.5, 0.0, 553.0, 239.5, 0.0, 0.0, 1.0};
  info.R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  info.P = {500.0, 0.0, 320.0, 0.0, 0.0, 501.0, 240.0, 0.0, 0.0, 0.0, 1.0, 0.0};
  return info;
}

}  // namespace window_ingress::test
