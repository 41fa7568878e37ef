#pragma once

#include <camera_info_manager/camera_info_manager.h>
#include <geometry_msgs/TwistStamped.h>
#include <nav_msgs/Odometry.h>
#include <window_ingress/IngressState.h>
#include <window_ingress/Inject.h>

#include "adapters/inputs/topic_input.hpp"
#include "adapters/nodes.hpp"
#include "adapters/world/world_lockstep.hpp"
#include "adapters/world/world_publishers.hpp"
#include "adapters/world/world_referee.hpp"
#include "simulation/schedule.hpp"
#include "simulation/world.hpp"
#include "window_ingress/configuration/world_node_params.hpp"

namespace window_ingress::adapters {

using configuration::WorldNodeParams;

/// `simulation::World` on topics; replaces vehicle, camera and Gazebo. Runs in one thread.
///
/// Its time follows the steady clock, the steps of lockstep, or, for an external vehicle, the stamps of
/// `vehicle_odom`.
class WorldNode : public Node {
 public:
  WorldNode(ros::NodeHandle& nh, ros::NodeHandle& pnh);
  void stop() override { referee_.finish(); }

 private:
  void subscribe(ros::NodeHandle& nh);
  void calibrate(const simulation::Scenario& scenario);
  void restart();
  void tick();
  void tickLockstep();
  void advanceToNextStep();
  bool mayRun();
  bool imageIsDue();
  void stepOnce();
  void deliverImages();
  void deliverNewestImages();
  void deliver(const simulation::CameraFrame& frame);
  void receiveCommand(const geometry_msgs::TwistStampedConstPtr& message);
  void receiveState(const window_ingress::IngressStateConstPtr& message);
  void receiveVehicle(const nav_msgs::OdometryConstPtr& message);
  void begin(const navigation::VehicleState& vehicle);
  void follow(const navigation::VehicleState& vehicle, const Eigen::Vector3d& angular_velocity_radps);
  Reply reset();
  std::string makeOthersForget();
  Reply inject(const window_ingress::InjectRequest& request);

  void tellTime();
  void sendCalibration(const simulation::CalibrationSample& sample);
  void sendOdometry(const simulation::OdometrySample& sample);
  void sendImu(const simulation::ImuSample& sample);
  ros::Time stampOf(double world_sec) const;
  ros::Time now() const { return stampOf(world_->timeSec()); }
  bool isExternal() const { return world_->scenario().vehicle.profile == "external"; }
  Health speedHealth() const;
  Health externalHealth() const;

  WorldNodeParams params_;
  Diagnostics diagnostics_;
  std::optional<TopicInput> command_, vehicle_;
  std::unique_ptr<simulation::World> world_;
  Eigen::Matrix3d R_odom_base_ = Eigen::Matrix3d::Identity();  // from the latest odometry
  std::optional<Eigen::Isometry3d> T_odom_start_;      // set if the world starts at the vehicle's place
  std::optional<simulation::VelocityCommand> answer_;  // in lockstep: applied when time continues
  double epoch_sec_;                                   // stamp at the world's time zero
  double clock_due_sec_ = 0.0;
  double created_sec_, ticked_sec_, debt_sec_ = 0.0, lost_sec_ = 0.0;
  double began_sec_ = 0.0, followed_sec_ = -1.0;
  long images_due_ = 0, images_lost_ = 0;  // for an external vehicle
  bool running_ = false;

  camera_info_manager::CameraInfoManager camera_info_;
  WorldPublishers publishers_;
  WorldReferee referee_;
  std::optional<WorldLockstep> lockstep_;
  std::optional<simulation::Periodic> truth_due_, images_;  // images_ is for lockstep
  ros::Subscriber state_subscriber_;
  ros::ServiceServer reset_, inject_;
  ros::ServiceClient detector_reset_, pose_reset_;
  ros::SteadyTimer timer_;
};

}  // namespace window_ingress::adapters
