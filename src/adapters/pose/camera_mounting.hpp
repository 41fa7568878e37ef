#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace window_ingress::adapters {

struct CameraMountingParams {
  /// x, y, z [m, at most 2], yaw, pitch, roll [rad, at most half a turn] of the camera in the body, x
  /// forward, y left, z up
  std::vector<double> pose;
  std::string camera_frame = "camera_optical_frame";  ///< frame of the images
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("pose", self.pose);
    field("camera_frame", self.camera_frame);
  }
};

/// \param pose x, y, z [m], yaw, pitch, roll [rad]: rotations about z, then y, then x. Zero angles look
/// ahead, a positive pitch looks down, a positive yaw to the left. \throws InputError unless these are six
/// plausible numbers for a small vehicle (not degrees or millimetres)
Eigen::Isometry3d T_base_cameraOf(const std::vector<double>& pose);

}  // namespace window_ingress::adapters
