#pragma once

#include <geometry_msgs/PointStamped.h>
#include <ros/node_handle.h>
#include <std_msgs/UInt32.h>
#include <tf2_ros/buffer.h>
#include <window_ingress/Facade.h>
#include <window_ingress/IngressState.h>
#include <window_ingress/SelectWindow.h>

#include <cstdint>
#include <string>

#include "adapters/runtime/diagnostics.hpp"
#include "window_ingress/estimation/target_estimator.hpp"

namespace window_ingress::adapters {

/// The memory of all windows between topics: what it knows goes out (`facade`, `markers`), which of them is
/// the target comes in (`~select_window`, a click in rviz: `clicked_point`, a goal of the navigator's action:
/// `chosen_window`), and what the navigator does (`state`).
class FacadeTopics {
 public:
  /// \param tracker \param tf both outlive this
  FacadeTopics(ros::NodeHandle& nh, ros::NodeHandle& pnh, Diagnostics& diagnostics,
               estimation::TargetEstimator& tracker, const tf2_ros::Buffer& tf,
               const std::string& odom_frame);

  /// After an image; sends a few times a second. \param markers where rviz looks
  void publish(const ros::Time& stamp, ros::Publisher& markers);
  /// At once, to who hears of windows only now and then: after all have been forgotten.
  void tellAnew(const ros::Time& stamp);

 private:
  window_ingress::Facade tell(const ros::Time& stamp);
  bool select(window_ingress::SelectWindow::Request& request, window_ingress::SelectWindow::Response& reply);
  void receiveChoice(const std_msgs::UInt32& message);
  void receiveClick(const geometry_msgs::PointStamped& message);
  void receiveState(const window_ingress::IngressState& message);
  Health health() const;

  estimation::TargetEstimator& tracker_;
  const tf2_ros::Buffer& tf_;
  std::string odom_frame_;
  ros::Publisher publisher_;
  ros::Subscriber choice_, click_, state_;
  ros::ServiceServer select_;
  double published_sec_ = -1.0;  // on the steady clock
  std::uint32_t published_target_ = 0;
  std::string last_click_;  // what became of it
};

}  // namespace window_ingress::adapters
