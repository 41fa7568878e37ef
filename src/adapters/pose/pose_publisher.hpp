#pragma once

#include <ros/node_handle.h>
#include <tf2_ros/transform_broadcaster.h>
#include <window_ingress/WindowPose.h>

#include <optional>
#include <string>
#include <vector>

#include "window_ingress/estimation/window_filter.hpp"

namespace window_ingress::adapters {

/// The window's pose on all topics that carry it, as markers, and as transform.
class PosePublisher {
 public:
  /// \param window_frame empty: no transform is sent
  PosePublisher(ros::NodeHandle& nh, bool latched, const std::string& odom_frame,
                const std::string& window_frame);

  /// \param filtered if the window's place is known
  void publish(const window_ingress::WindowPose& message,
               const std::optional<estimation::FilteredWindow>& filtered);
  void clear(const ros::Time& stamp);  ///< all markers are gone

  ros::Publisher& markers() { return markers_; }
  std::vector<ros::Publisher> topics() const { return {pose_, covariance_, polygon_, markers_}; }

 private:
  void publishImage(const window_ingress::WindowPose& message);
  void publishFiltered(const window_ingress::WindowPose& message, const estimation::FilteredWindow& window);

  std::string odom_frame_, window_frame_;
  ros::Publisher pose_, covariance_, polygon_, markers_;
  tf2_ros::TransformBroadcaster transforms_;
};

}  // namespace window_ingress::adapters
