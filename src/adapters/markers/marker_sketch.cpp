#include "adapters/markers/marker_sketch.hpp"

#include <tf2_eigen/tf2_eigen.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <sstream>

#include "adapters/conversions/msg_conversion.hpp"
#include "adapters/markers/marker_colours.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::adapters {
namespace {

using visualization_msgs::Marker;

constexpr double kLineWidthM = 0.025, kTextHeightM = 0.14;
constexpr double kShaftM = 0.035, kHeadM = 0.08, kHeadLengthM = 0.14;
constexpr double kThinnestM = 1e-3;  // rviz refuses a scale of zero

}  // namespace

MarkerSketch::MarkerSketch(const ros::Time& stamp, const std::string& frame_id)
    : header_(headerOf(stamp, frame_id)) {}

Marker& MarkerSketch::add(const std::string& name, int type) {
  Marker& marker = markers_.markers.emplace_back();
  marker.header = header_;
  marker.ns = name;
  marker.type = type;
  marker.action = Marker::ADD;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = kLineWidthM;
  marker.lifetime = ros::Duration(kLifetimeSec);
  return marker;
}

Marker* MarkerSketch::shape(const std::string& name, int type, const Points& points, std::size_t at_least,
                            const std_msgs::ColorRGBA& colour) {
  const bool finite = std::all_of(points.begin(), points.end(), [](const auto& p) { return p.allFinite(); });
  if (!finite || points.size() < at_least) {
    gone(name);
    return nullptr;
  }
  Marker& marker = add(name, type);
  for (const Eigen::Vector3d& point : points) marker.points.push_back(tf2::toMsg(point));
  marker.color = colour;
  return &marker;
}

void MarkerSketch::line(const std::string& name, const Points& points, const std_msgs::ColorRGBA& colour) {
  shape(name, Marker::LINE_STRIP, points, 2, colour);
}

void MarkerSketch::line(const std::string& name, const Points& points,
                        std::vector<std_msgs::ColorRGBA> colours) {
  if (colours.size() != points.size() || colours.empty()) return gone(name);
  if (Marker* marker = shape(name, Marker::LINE_STRIP, points, 2, colours.back()))
    marker->colors = std::move(colours);
}

void MarkerSketch::strokes(const std::string& name, const Points& ends, const std_msgs::ColorRGBA& colour) {
  shape(name, Marker::LINE_LIST, ends, 2, colour);
}

void MarkerSketch::surface(const std::string& name, const Points& corners,
                           const std_msgs::ColorRGBA& colour) {
  if (Marker* marker = shape(name, Marker::TRIANGLE_LIST, corners, 3, colour))
    marker->scale = toVectorMsg(Eigen::Vector3d::Ones());
}

void MarkerSketch::arrow(const std::string& name, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                         const std_msgs::ColorRGBA& colour) {
  constexpr double kShortestM = 0.02;
  const double length_m = (to - from).norm();
  if (length_m < kShortestM) return gone(name);
  if (Marker* marker = shape(name, Marker::ARROW, {from, to}, 2, colour))
    marker->scale = toVectorMsg({kShaftM, kHeadM, std::min(kHeadLengthM, 0.5 * length_m)});
}

void MarkerSketch::solid(const std::string& name, int type, const Eigen::Isometry3d& T_frame_solid,
                         const Eigen::Vector3d& half_extents_m, const std_msgs::ColorRGBA& colour) {
  if (!T_frame_solid.matrix().allFinite() || !half_extents_m.allFinite()) return gone(name);
  Marker& marker = add(name, type);
  marker.pose = toPoseMsg(T_frame_solid);
  marker.scale = toVectorMsg((2.0 * half_extents_m).cwiseMax(kThinnestM));
  marker.color = colour;
}

void MarkerSketch::box(const std::string& name, const Eigen::Isometry3d& T_frame_box,
                       const Eigen::Vector3d& half_extents_m, const std_msgs::ColorRGBA& colour) {
  solid(name, Marker::CUBE, T_frame_box, half_extents_m, colour);
}

void MarkerSketch::ellipsoid(const std::string& name, const Eigen::Vector3d& centre,
                             const Eigen::Matrix3d& covariance, double sigmas,
                             const std_msgs::ColorRGBA& colour) {
  if (!covariance.allFinite() || !centre.allFinite()) return gone(name);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  Eigen::Matrix3d axes = solver.eigenvectors();
  if (axes.determinant() < 0.0) axes.col(0) = -axes.col(0);
  solid(name, Marker::SPHERE, geometry::makePose(axes, centre),
        sigmas * solver.eigenvalues().cwiseMax(0.0).cwiseSqrt(), colour);
}

void MarkerSketch::text(const std::string& name, const Eigen::Vector3d& centre, const std::string& text) {
  if (text.empty() || !centre.allFinite()) return gone(name);
  Marker& marker = add(name, Marker::TEXT_VIEW_FACING);
  marker.pose.position = tf2::toMsg(centre);
  marker.text = text;
  marker.scale.z = kTextHeightM;
  marker.color = colourOf(kTextRgb);
}

void MarkerSketch::gone(const std::string& name) { add(name, Marker::CUBE).action = Marker::DELETE; }

visualization_msgs::MarkerArray allGone(const ros::Time& stamp, const std::string& frame_id) {
  visualization_msgs::MarkerArray markers;
  Marker& marker = markers.markers.emplace_back();
  marker.header = headerOf(stamp, frame_id);
  marker.action = Marker::DELETEALL;
  return markers;
}

void appendFace(Points& triangles, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                const Eigen::Vector3d& c, const Eigen::Vector3d& d) {
  for (const Eigen::Vector3d& corner : {a, b, c, a, c, d}) triangles.push_back(corner);
}

std::string wrapped(const std::string& text, std::size_t most) {
  std::istringstream words(text);
  std::string word, line, all;
  while (words >> word) {
    const bool fits = line.empty() || line.size() + 1 + word.size() <= most;
    if (!fits) all += line + "\n";
    line = fits && !line.empty() ? line + " " + word : word;
  }
  return all + line;
}

}  // namespace window_ingress::adapters
