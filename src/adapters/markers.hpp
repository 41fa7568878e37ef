/// What rviz shows of the window and of the flight.
#pragma once

#include <geometry_msgs/PolygonStamped.h>
#include <ros/time.h>
#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Geometry>
#include <string>

#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/navigation/navigator.hpp"
#include "window_ingress/pose/window_filter.hpp"

namespace window_ingress::adapters {

/// The opening's border in frame `frame_id`, in which `T_frame_window` stands.
geometry_msgs::PolygonStamped openingPolygon(const Eigen::Isometry3d& T_frame_window,
                                             const geometry::OpeningSize& opening, const ros::Time& stamp,
                                             const std::string& frame_id);

/// Border and direction of flight, green while the normal is trusted, else amber; the other planar solution
/// in grey while it lives; and above the window, `text`.
visualization_msgs::MarkerArray windowMarkers(const pose::FilteredWindow& window, const std::string& text,
                                              const ros::Time& stamp, const std::string& frame_id);

/// The velocity wished for, as an arrow at the vehicle, and the state in words.
visualization_msgs::MarkerArray flightMarkers(const navigation::NavigatorOutput& output,
                                              const navigation::VehicleState& vehicle, const ros::Time& stamp,
                                              const std::string& odom_frame);

}  // namespace window_ingress::adapters
