#pragma once

#include <geometry_msgs/PolygonStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <ros/node_handle.h>
#include <tf2_ros/transform_broadcaster.h>
#include <window_ingress/WindowPose.h>

#include <optional>
#include <string>
#include <vector>

#include "adapters/conversions/msg_conversion.hpp"
#include "adapters/markers/marker_sketch.hpp"
#include "adapters/markers/window_markers.hpp"
#include "window_ingress/estimation/window_filter.hpp"

namespace window_ingress::adapters {

/// Publishes the window's pose on all its topics, as markers and as transform.
class PosePublisher {
 public:
  /// \param window_frame empty: no transform is sent
  PosePublisher(ros::NodeHandle& nh, bool latched, const std::string& odom_frame,
                const std::string& window_frame)
      : odom_frame_(odom_frame), window_frame_(window_frame) {
    pose_ = nh.advertise<window_ingress::WindowPose>("window_pose", 1, latched);
    covariance_ = nh.advertise<geometry_msgs::PoseWithCovarianceStamped>("window_pose_cov", 1);
    polygon_ = nh.advertise<geometry_msgs::PolygonStamped>("window_polygon", 1);
    markers_ = nh.advertise<visualization_msgs::MarkerArray>("markers", 1);
  }

  /// \param filtered empty if the window's place is unknown
  void publish(const window_ingress::WindowPose& message,
               const std::optional<estimation::FilteredWindow>& filtered) {
    pose_.publish(message);
    if (message.image.reject == window_ingress::ImagePose::OK) publishImage(message);
    if (filtered) publishFiltered(message, *filtered);
  }

  /// Removes all markers.
  void clear(const ros::Time& stamp) { markers_.publish(allGone(stamp, odom_frame_)); }

  ros::Publisher& markers() { return markers_; }
  std::vector<ros::Publisher> topics() const { return {pose_, covariance_, polygon_, markers_}; }

 private:
  void publishImage(const window_ingress::WindowPose& message) {
    geometry_msgs::PoseWithCovarianceStamped stamped;
    stamped.header = message.header;
    stamped.pose = message.image.pose;
    covariance_.publish(stamped);
    if (const auto T_camera_window = fromMsg(message.image.pose.pose))
      polygon_.publish(openingPolygon(*T_camera_window.value, {message.size.width, message.size.height},
                                      message.header.stamp, message.header.frame_id));
  }

  void publishFiltered(const window_ingress::WindowPose& message, const estimation::FilteredWindow& window) {
    if (markers_.getNumSubscribers() > 0)
      markers_.publish(windowMarkers(window, windowLabel(message), message.header.stamp, odom_frame_));
    if (window_frame_.empty()) return;
    transforms_.sendTransform(toTransformStampedMsg(
        window.T_odom_window, headerOf(message.header.stamp, odom_frame_), window_frame_));
  }

  std::string odom_frame_, window_frame_;
  ros::Publisher pose_, covariance_, polygon_, markers_;
  tf2_ros::TransformBroadcaster transforms_;
};

}  // namespace window_ingress::adapters
