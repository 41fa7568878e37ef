#pragma once

#include <nav_msgs/Odometry.h>
#include <ros/node_handle.h>
#include <sensor_msgs/Imu.h>
#include <std_srvs/Trigger.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>
#include <window_ingress/WindowDetection.h>
#include <window_ingress/WindowPose.h>

#include <optional>
#include <string>

#include "adapters/conversions/msg_conversion.hpp"
#include "adapters/inputs/attitude_source.hpp"
#include "adapters/inputs/camera_source.hpp"
#include "adapters/inputs/clock_watch.hpp"
#include "adapters/inputs/stamp_gate.hpp"
#include "adapters/pose/pose_health.hpp"
#include "adapters/pose/pose_publisher.hpp"
#include "adapters/pose/window_selection.hpp"
#include "adapters/runtime/diagnostics.hpp"
#include "adapters/runtime/lockstep.hpp"
#include "adapters/runtime/run_node.hpp"
#include "window_ingress/configuration/pose_node_params.hpp"
#include "window_ingress/estimation/sender_clock.hpp"
#include "window_ingress/estimation/target_estimator.hpp"

namespace window_ingress::adapters {

using configuration::PoseNodeParams;

/// Pose estimator and filter between topics: corners and calibration in, the window's pose out.
class PoseNode : public Node {
 public:
  PoseNode(ros::NodeHandle& nh, ros::NodeHandle& pnh);

 private:
  using Trigger = std_srvs::Trigger;

  void receiveWindow(const window_ingress::WindowDetectionConstPtr& message);
  void receiveOdometry(const nav_msgs::OdometryConstPtr& message);
  void receiveImu(const sensor_msgs::ImuConstPtr& message);
  void takeOdometry(const nav_msgs::OdometryConstPtr& message);
  void takeImu(const sensor_msgs::ImuConstPtr& message);
  void processPending(bool however_old);
  bool isComplete(const Lockstep::Step& step) const;
  void process(const window_ingress::WindowDetection& message);
  struct Refusal {
    std::uint8_t reject;
    std::string reason;
  };
  Refusal estimate(const window_ingress::WindowDetection& message, window_ingress::WindowPose& out);
  bool reset(Trigger::Request& request, Trigger::Response& response);
  void forget();
  bool isFromBeforeReset(const std_msgs::Header& header) const {
    return !lockstep_ && header.stamp <= forgotten_;
  }
  void restartIfClockJumpedBack();
  Health mountingHealth() const;
  geometry::OpeningSize sizeSaid() const {
    return {params_.pose.opening_width_m, params_.pose.opening_height_m};
  }

  navigation::VehicleParams vehicle_;
  PoseNodeParams params_;
  Diagnostics diagnostics_;
  TopicHealth window_health_, odom_health_;
  std::optional<TopicHealth> imu_health_;
  std::optional<Lockstep> lockstep_;
  ros::Time window_came_, odom_came_, imu_came_;  // stamps of the last messages, used or not
  StampGate window_gate_, odom_gate_;
  estimation::SenderClock odom_clock_;
  ClockWatch clock_;
  CameraSource camera_;
  estimation::TargetEstimator estimator_;
  estimation::Consistency consistency_;
  UnusedImages unused_;
  double odometry_stamp_sec_ = -1.0;
  ros::Time forgotten_;  // messages up to this stamp describe a world that no longer exists
  window_ingress::WindowDetectionConstPtr pending_;
  double pending_since_sec_ = 0.0;  // on the steady clock
  Converted<Eigen::Isometry3d> T_base_camera_;

  tf2_ros::Buffer tf_;
  std::optional<TfAttitude> tf_attitude_;
  tf2_ros::TransformListener tf_listener_;
  WindowSelection selection_;
  PosePublisher publisher_;
  ros::Subscriber window_subscriber_, odom_subscriber_, imu_subscriber_;
  ros::ServiceServer reset_;
  ros::SteadyTimer timer_;
};

}  // namespace window_ingress::adapters
