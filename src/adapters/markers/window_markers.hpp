/// Markers of the windows for rviz.
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

/// The opening's border in the frame `frame_id` of `T_frame_window`.
geometry_msgs::PolygonStamped openingPolygon(const Eigen::Isometry3d& T_frame_window,
                                             const geometry::OpeningSize& opening, const ros::Time& stamp,
                                             const std::string& frame_id);

/// Text beside the window.
std::string windowLabel(const window_ingress::WindowPose& message);

/// The filtered window: its border; an arrow through it, with a fan of three standard deviations of its
/// heading; an ellipsoid of three standard deviations of its centre; `text` beside it. With a trusted normal
/// also the plane of the wall, otherwise the other hypothesis, whose opacity shows its likelihood.
visualization_msgs::MarkerArray windowMarkers(const estimation::FilteredWindow& window,
                                              const std::string& text, const ros::Time& stamp,
                                              const std::string& frame_id);

/// The known windows that may be flown through: borders coloured by openness, number and verdict above, and
/// inside a faint, clickable face.
visualization_msgs::MarkerArray facadeMarkers(const window_ingress::Facade& facade);

}  // namespace window_ingress::adapters
