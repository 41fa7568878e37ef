#pragma once

#include <Eigen/Geometry>
#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "simulation/rendering/gl_functions.hpp"
#include "simulation/scene/scene.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::simulation {

/// Part of the light that a pane of window glass mirrors, both faces together: Fresnel's law for light
/// without polarisation, and all that goes to and fro between the faces.
double paneReflectance(double cos_incidence);

/// In front of the plane and behind it change places.
Eigen::Isometry3d mirrorAt(double x_m);

/// The panes of a scene, all in one plane. What they mirror is an image of its own, taken by the mirrored
/// camera with the same pixels; laid over what is seen through them, each point by its own part.
class Glazing {
 public:
  /// \throws std::runtime_error if OpenGL refuses
  void create(const GlFunctions& gl, const geometry::PinholeCamera& camera, const std::vector<Pane>& panes);

  /// Part of the image in which panes may be seen; nothing of them is seen from the room.
  cv::Rect partIn(const Eigen::Isometry3d& T_camera_window) const;
  Eigen::Isometry3d mirrored(const Eigen::Isometry3d& T_camera_window) const;

  /// What is drawn between these two is what the panes mirror: only what lies before them.
  void beginMirror(const GlFunctions& gl, const Eigen::Isometry3d& T_camera_mirrored) const;
  void endMirror(const GlFunctions& gl) const;
  /// Over the image as drawn; leaves its alpha channel as it is, and OpenGL's arrays pointing elsewhere.
  void draw(const GlFunctions& gl, const Eigen::Matrix4d& projection,
            const Eigen::Isometry3d& T_camera_window);

 private:
  struct Point {
    std::array<float, 3> position;  // window frame [m]
    std::array<float, 4> mirrored;  // texture coordinates, homogeneous
    std::array<float, 4> colour;    // white; its alpha is the part that is mirrored
  };
  void addPane(const Pane& pane, const Eigen::Matrix4d& texture_from_window, const Eigen::Vector3d& eye);

  geometry::PinholeCamera camera_;
  std::vector<Pane> panes_;
  GLuint mirror_ = 0, texture_ = 0;
  std::vector<Point> points_;
  std::vector<GLuint> corners_;
};

/// The smallest part of the image that holds all these points; all of it if one of them is not in front of
/// the camera.
cv::Rect partAround(const geometry::PinholeCamera& camera, const std::vector<Eigen::Vector3d>& points_camera);

}  // namespace window_ingress::simulation
