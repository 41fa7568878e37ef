#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <vector>

#include "simulation/rendering/gl_context.hpp"
#include "simulation/scene/scene.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::simulation {

/// Reflectance of a pane of window glass, both faces together: Fresnel's law for unpolarised light, with all
/// multiple reflections between the faces.
double paneReflectance(double cos_incidence);

/// Swaps the sides in front of and behind the plane.
Eigen::Isometry3d mirrorAt(double x_m);

/// The panes of a scene, all in one plane. Their reflection is a separate image, taken by the mirrored camera
/// with the same pixels. It is blended over the view through the panes, with the reflectance at each point.
class Glazing {
 public:
  /// \throws std::runtime_error if OpenGL refuses
  void create(const GlFunctions& gl, const geometry::PinholeCamera& camera, const std::vector<Pane>& panes);

  /// Part of the image in which panes may be visible; from inside the room they are invisible.
  cv::Rect partIn(const Eigen::Isometry3d& T_camera_window) const;

  /// Draws between these two calls go to the reflection, which contains only objects in front of the panes.
  /// \return the mirrored scene's pose in the camera
  Eigen::Isometry3d beginMirror(const GlFunctions& gl, const Eigen::Isometry3d& T_camera_window) const;
  void endMirror(const GlFunctions& gl) const;
  /// Draws the panes over the image. Keeps the alpha channel, but changes OpenGL's array pointers.
  void draw(const GlFunctions& gl, const Eigen::Matrix4d& projection,
            const Eigen::Isometry3d& T_camera_window);

 private:
  struct Point {
    Eigen::Vector3f position;  // window frame [m]
    Eigen::Vector4f mirrored;  // texture coordinates, homogeneous
    Eigen::Vector4f colour;    // white; alpha: reflectance
  };
  void addPane(const Pane& pane, const Eigen::Matrix4d& texture_from_window, const Eigen::Vector3d& eye);

  geometry::PinholeCamera camera_;
  std::vector<Pane> panes_;
  GLuint mirror_ = 0, texture_ = 0;
  std::vector<Point> points_;
  std::vector<GLuint> corners_;
};

/// The smallest part of the image that contains all these points; the whole image if a point is not in front
/// of the camera.
cv::Rect partAround(const geometry::PinholeCamera& camera, const std::vector<Eigen::Vector3d>& points_camera);

}  // namespace window_ingress::simulation
