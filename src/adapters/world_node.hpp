#pragma once

#include <camera_info_manager/camera_info_manager.h>
#include <geometry_msgs/TwistStamped.h>
#include <ros/node_handle.h>
#include <std_srvs/Trigger.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>
#include <window_ingress/FlightVerdict.h>
#include <window_ingress/IngressState.h>

#include <memory>
#include <string>

#include "adapters/diagnostics.hpp"
#include "adapters/msg_conversion.hpp"
#include "adapters/run_node.hpp"
#include "window_ingress/simulation/world.hpp"

namespace window_ingress::adapters {

struct WorldNodeParams {
  std::string scenario;           ///< file; empty: a calm day, five metres in front of the window
  int seed = 1;                   ///< of everything that the scenario marks random
  double real_time_factor = 1.0;  ///< simulated over real time, if the machine can keep up
  double start_time_sec = 100.0;  ///< simulated time at the start: a stamp of zero means unstamped [s]
  double clock_rate_hz = 100.0;   ///< of /clock, in simulated time [Hz]
  double wait_sec =
      0.0;  ///< time starts when images and odometry are subscribed to, at the latest after this [s]
  std::string camera_frame = "camera_optical_frame";
  FrameNames frames;
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("scenario", self.scenario);
    field("seed", self.seed, 0, 2147483647);
    field("real_time_factor", self.real_time_factor, 0.01, 100.0);
    field("start_time_sec", self.start_time_sec, 1.0, 1e9);
    field("clock_rate_hz", self.clock_rate_hz, 20.0, 400.0);
    field("wait_sec", self.wait_sec, 0.0, 600.0);
    field("camera_frame", self.camera_frame);
    FrameNames::visit(self.frames, field);
  }
};

/// `simulation::World` on topics; stands in for vehicle, camera and Gazebo. Runs in one thread.
class WorldNode : public Node {
 public:
  WorldNode(ros::NodeHandle& nh, ros::NodeHandle& pnh);

 private:
  using Trigger = std_srvs::Trigger;

  void restart();
  void tick();
  bool mayRun();
  void stepOnce();
  void receiveCommand(const geometry_msgs::TwistStampedConstPtr& message);
  void receiveState(const window_ingress::IngressStateConstPtr& message);
  bool reset(Trigger::Request& request, Trigger::Response& response);

  void publishClock();
  void publishFrame(const simulation::CameraFrame& frame);
  void publishOdometry(const simulation::OdometrySample& sample);
  void publishImu(const simulation::ImuSample& sample);
  void publishTruth(double stamp_sec);
  void publishMounting();
  void publishReference();
  void publishVerdict();
  window_ingress::FlightVerdict verdict() const;
  ros::Time stampOf(double world_sec) const;
  Health speedHealth() const;

  WorldNodeParams params_;
  Diagnostics diagnostics_;
  TopicHealth command_health_;
  std::unique_ptr<simulation::World> world_;
  Eigen::Matrix3d R_odom_base_ = Eigen::Matrix3d::Identity();  // as the odometry last said
  simulation::Claim claim_ = simulation::Claim::kNone;
  window_ingress::FlightVerdict said_;
  double epoch_sec_;                 // stamp of the world's time zero
  double mission_start_sec_ = -1.0;  // in the world's time
  double clock_due_sec_ = 0.0, judge_due_sec_ = 0.0, verdict_due_sec_ = 0.0;
  double created_sec_, ticked_sec_, debt_sec_ = 0.0, lost_sec_ = 0.0;
  bool running_ = false;

  camera_info_manager::CameraInfoManager camera_info_;
  tf2_ros::TransformBroadcaster tf_;
  tf2_ros::StaticTransformBroadcaster static_tf_;
  ros::Subscriber command_subscriber_, state_subscriber_;
  ros::Publisher clock_publisher_, image_publisher_, info_publisher_, odom_publisher_, imu_publisher_;
  ros::Publisher reference_publisher_;
  ros::Publisher truth_odom_publisher_, truth_window_publisher_, truth_in_camera_publisher_,
      verdict_publisher_;
  ros::ServiceServer reset_;
  ros::SteadyTimer timer_;
};

}  // namespace window_ingress::adapters
