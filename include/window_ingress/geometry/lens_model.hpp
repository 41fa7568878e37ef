#pragma once

#include <string>
#include <vector>

#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::geometry {

/// Sets a camera's lens from a model's name and coefficients, as calibration files and sensor_msgs/CameraInfo
/// give them: plumb_bob with 4 or 5 numbers, equidistant (or fisheye) with 4, rational_polynomial with 8 of
/// which the last three are 0. Without numbers, or with zeros alone, plumb_bob, rational_polynomial and a
/// model without a name are a lens without distortion. \return why the lens cannot be used, empty if it can
std::string setLens(const std::string& model, const std::vector<double>& coefficients, PinholeCamera& camera);

}  // namespace window_ingress::geometry
