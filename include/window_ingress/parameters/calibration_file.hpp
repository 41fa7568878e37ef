#pragma once

#include <string>

#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::parameters {

/// Reads a calibration file in the format of camera_info_manager (yaml: image_width, image_height,
/// camera_matrix, distortion_model, distortion_coefficients).
/// \throws InputError, one line "file: what is wrong; what to do": missing, not yaml, incomplete,
/// uncalibrated (K all zero), or of a lens model other than plumb_bob and equidistant
geometry::PinholeCamera readCalibrationFile(const std::string& file);

}  // namespace window_ingress::parameters
