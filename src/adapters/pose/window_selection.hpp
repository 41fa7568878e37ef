#pragma once

#include <geometry_msgs/PointStamped.h>
#include <ros/node_handle.h>
#include <std_msgs/UInt32.h>
#include <tf2_ros/buffer.h>
#include <window_ingress/Facade.h>
#include <window_ingress/IngressState.h>
#include <window_ingress/SelectWindow.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "adapters/inputs/attitude_source.hpp"
#include "adapters/markers/window_markers.hpp"
#include "adapters/runtime/services.hpp"
#include "window_ingress/estimation/target_estimator.hpp"

namespace window_ingress::adapters {

/// Selects the target among all known windows, by `~select_window`, a click in rviz (`clicked_point`), a goal
/// of the navigator's action (`chosen_window`), or otherwise by the navigator's progress (`state`). Publishes
/// all known windows (`facade`, `markers`).
class WindowSelection {
 public:
  /// \param estimator \param tf both must outlive this
  WindowSelection(ros::NodeHandle& nh, ros::NodeHandle& pnh, Diagnostics& diagnostics,
                  estimation::TargetEstimator& estimator, const tf2_ros::Buffer& tf,
                  const std::string& odom_frame)
      : estimator_(estimator), tf_(tf), odom_frame_(odom_frame) {
    publisher_ = nh.advertise<window_ingress::Facade>("facade", 1, true);
    click_ = diagnostics.subscribe(nh, "clicked_point", 1, &WindowSelection::receiveClick, this);
    choice_ = diagnostics.subscribe(nh, "chosen_window", 1, &WindowSelection::receiveChoice, this);
    state_ = diagnostics.subscribe(nh, "state", 1, &WindowSelection::receiveState, this);
    select_ = advertise<window_ingress::SelectWindow>(
        pnh, "select_window", [this](const auto& request) { return estimator_.selectWindow(request.id); });
    diagnostics.add("windows", [this] { return health(); });
  }

  /// Call after each image; publishes a few times a second. \param markers topic of the markers
  void publish(const ros::Time& stamp, ros::Publisher& markers) {
    const double now_sec = steadyNowSec();
    const std::uint32_t target = estimator_.facade().targetId();
    if (now_sec - published_sec_ < kFacadePeriodSec && target == published_target_) return;
    const window_ingress::Facade message = tell(stamp);
    if (markers.getNumSubscribers() > 0) markers.publish(facadeMarkers(message));
  }

  /// Publishes at once, after all windows were forgotten, because the regular messages are rare.
  void tellAnew(const ros::Time& stamp) {
    last_click_.clear();
    tell(stamp);
  }

 private:
  static constexpr double kFacadePeriodSec = 0.5;

  window_ingress::Facade tell(const ros::Time& stamp) {
    published_sec_ = steadyNowSec();
    published_target_ = estimator_.facade().targetId();
    window_ingress::Facade message = toMsg(estimator_.facade(), stamp.toSec());
    message.header = headerOf(stamp, odom_frame_);
    publisher_.publish(message);
    return message;
  }

  void receiveChoice(const std_msgs::UInt32ConstPtr& message) {
    const Reply reply = estimator_.selectWindow(message->data);
    ROS_INFO("chosen by a goal: %s", reply.message.c_str());
    if (reply.success) published_sec_ = -1.0;  // publishes the choice with the next image
  }

  void receiveClick(const geometry_msgs::PointStampedConstPtr& message) {
    const Eigen::Vector3d point = toEigen(message->point);
    const std::string& frame = message->header.frame_id;
    const auto T_odom_frame = frame == odom_frame_
                                  ? Converted<Eigen::Isometry3d>{Eigen::Isometry3d::Identity(), ""}
                                  : mountingOf(tf_, odom_frame_, frame);
    if (!T_odom_frame)
      last_click_ = "a point in '" + frame + "', which tf does not connect with " + odom_frame_ +
                    ": choose rviz's fixed frame accordingly";
    else if (!point.allFinite())
      last_click_ = "the point is not finite";
    else
      last_click_ = estimator_.selectWindowNear(*T_odom_frame.value * point).message;
    ROS_INFO("clicked: %s", last_click_.c_str());
  }

  void receiveState(const window_ingress::IngressStateConstPtr& message) {
    estimator_.addNavigatorState(message->window_id, message->given_up, message->next_window != 0);
  }

  Health health() const {
    const facade::FacadeMemory& facade = estimator_.facade();
    const auto shown = std::count_if(facade.windows().begin(), facade.windows().end(),
                                     [](const auto& window) { return window.isConfirmed(); });
    const std::uint32_t target = facade.targetId();
    std::string text = std::to_string(shown) +
                       " known, target: " + (target == 0 ? "none yet" : "window " + std::to_string(target));
    if (facade.isChosen()) text += " (chosen)";
    if (!last_click_.empty()) text += "; last click: " + last_click_;
    return {Health::kOk, text};
  }

  estimation::TargetEstimator& estimator_;
  const tf2_ros::Buffer& tf_;
  std::string odom_frame_;
  ros::Publisher publisher_;
  ros::Subscriber choice_, click_, state_;
  ros::ServiceServer select_;
  double published_sec_ = -1.0;  // on the steady clock
  std::uint32_t published_target_ = 0;
  std::string last_click_;  // result of the last click
};

}  // namespace window_ingress::adapters
