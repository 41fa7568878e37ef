/// What rviz shows of the window.
#pragma once

#include <geometry_msgs/PolygonStamped.h>
#include <ros/time.h>
#include <visualization_msgs/MarkerArray.h>
#include <window_ingress/Facade.h>
#include <window_ingress/WindowPose.h>

#include <Eigen/Geometry>
#include <string>

#include "window_ingress/estimation/window_filter.hpp"
#include "window_ingress/geometry/opening.hpp"

namespace window_ingress::adapters {

/// The opening's border in frame `frame_id`, in which `T_frame_window` stands.
geometry_msgs::PolygonStamped openingPolygon(const Eigen::Isometry3d& T_frame_window,
                                             const geometry::OpeningSize& opening, const ros::Time& stamp,
                                             const std::string& frame_id);

/// What people want to read at the window.
std::string windowLabel(const window_ingress::WindowPose& message);

/// The filtered window: its border; the way through it as an arrow, with a fan of three standard deviations
/// of its heading; the ellipsoid of three standard deviations of its centre; `text` beside it. Once the
/// normal is trusted the plane of the wall; until then the other hypothesis, the fainter the less likely it
/// is.
visualization_msgs::MarkerArray windowMarkers(const estimation::FilteredWindow& window,
                                              const std::string& text, const ros::Time& stamp,
                                              const std::string& frame_id);

/// The windows known that somebody would fly at: borders coloured by whether they are open, above each its
/// number and verdict, and within a faint face, which a click meets.
visualization_msgs::MarkerArray facadeMarkers(const window_ingress::Facade& facade);

}  // namespace window_ingress::adapters
