/// Shapes for rviz.
#pragma once

#include <ros/time.h>
#include <std_msgs/ColorRGBA.h>
#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace window_ingress::adapters {

using Points = std::vector<Eigen::Vector3d>;

/// Collects shapes in one frame at one time. A shape replaces the previous one of the same name, and vanishes
/// after `kLifetimeSec` without a new one. A shape that cannot be drawn (not finite, empty) is removed.
class MarkerSketch {
 public:
  static constexpr double kLifetimeSec = 1.0;

  MarkerSketch(const ros::Time& stamp, const std::string& frame_id);

  void line(const std::string& name, const Points& points, const std_msgs::ColorRGBA& colour);
  /// \param colours one per point
  void line(const std::string& name, const Points& points, std::vector<std_msgs::ColorRGBA> colours);
  /// \param ends two points per stroke
  void strokes(const std::string& name, const Points& ends, const std_msgs::ColorRGBA& colour);
  /// \param corners three points per triangle; visible from both sides
  void surface(const std::string& name, const Points& corners, const std_msgs::ColorRGBA& colour);
  void arrow(const std::string& name, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
             const std_msgs::ColorRGBA& colour);
  void box(const std::string& name, const Eigen::Isometry3d& T_frame_box,
           const Eigen::Vector3d& half_extents_m, const std_msgs::ColorRGBA& colour);
  /// Surface at this number of standard deviations.
  void ellipsoid(const std::string& name, const Eigen::Vector3d& centre, const Eigen::Matrix3d& covariance,
                 double sigmas, const std_msgs::ColorRGBA& colour);
  /// Always upright and facing the observer, centred at `centre`.
  void text(const std::string& name, const Eigen::Vector3d& centre, const std::string& text);
  void gone(const std::string& name);

  const visualization_msgs::MarkerArray& markers() const { return markers_; }

 private:
  visualization_msgs::Marker& add(const std::string& name, int type);
  // Null and gone if the points are too few or not finite.
  visualization_msgs::Marker* shape(const std::string& name, int type, const Points& points,
                                    std::size_t at_least, const std_msgs::ColorRGBA& colour);
  void solid(const std::string& name, int type, const Eigen::Isometry3d& T_frame_solid,
             const Eigen::Vector3d& half_extents_m, const std_msgs::ColorRGBA& colour);

  std_msgs::Header header_;
  visualization_msgs::MarkerArray markers_;
};

/// Removes everything ever drawn on this topic.
visualization_msgs::MarkerArray allGone(const ros::Time& stamp, const std::string& frame_id);

/// Appends a plane face with four corners as two triangles.
void appendFace(Points& triangles, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                const Eigen::Vector3d& c, const Eigen::Vector3d& d);

/// Breaks the text between words into lines of at most `most` characters.
std::string wrapped(const std::string& text, std::size_t most);

}  // namespace window_ingress::adapters
