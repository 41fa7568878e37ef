#pragma once

#include <nav_msgs/Odometry.h>
#include <std_msgs/Bool.h>
#include <window_ingress/WindowPose.h>

#include "adapters/guard/setpoint_gate.hpp"
#include "adapters/inputs/topic_input.hpp"
#include "adapters/markers/flight_markers.hpp"
#include "adapters/navigator/engagement_monitor.hpp"
#include "adapters/navigator/guard_monitor.hpp"
#include "adapters/navigator/mission_action.hpp"
#include "adapters/navigator/upstream_faults.hpp"
#include "adapters/nodes.hpp"
#include "adapters/runtime/lockstep.hpp"
#include "adapters/runtime/master_watch.hpp"
#include "window_ingress/estimation/sender_clock.hpp"

namespace window_ingress::adapters {

using configuration::NavigatorNodeParams;

/// `navigation::Navigator` between topics and services: pose and odometry in, velocity out. In IDLE it sends
/// zeros, so that an autopilot accepts the switch to a mode that follows setpoints (not in lockstep). After
/// an abort it stops sending, so that the autopilot's own failsafe acts. While disabled it starts no mission
/// and sends no setpoints.
class NavigatorNode : public Node {
 public:
  NavigatorNode(ros::NodeHandle& nh, ros::NodeHandle& pnh);
  void stop() override;

 private:
  void receiveOdometry(const nav_msgs::OdometryConstPtr& message);
  void receivePose(const window_ingress::WindowPoseConstPtr& message);
  void takeCamera(const window_ingress::CameraInBody& message);
  void receiveEngaged(const std_msgs::BoolConstPtr& message);
  void step();
  bool isComplete(const Lockstep::Step& step) const;
  void stepInStep(const Lockstep::Step& step);
  void forgetSilentInputs();
  void restartIfClockJumpedBack(double now_sec);
  void abortIfForgotten();
  void abortIfItSlept();
  bool clockStandsStill(double now_sec);
  navigation::NavigatorOutput decide(double now_sec);
  void advertiseServices(ros::NodeHandle& pnh);
  Reply startMission(const navigation::MissionPolicy& policy);
  Reply abortMission(const std::string& why);
  std::string whyFlying() const;
  bool isLeftToOthers() const;
  Reply reset();
  Reply enable(bool wanted);
  Reply said(const std::string& service, const Reply& reply);
  void publish(const navigation::NavigatorOutput& output, const ros::Time& now);
  void publishSetpoint(const navigation::Setpoint& setpoint, const ros::Time& now);
  void publishState(const navigation::NavigatorOutput& output, const ros::Time& now);
  void publishMarkers(const navigation::NavigatorOutput& output, const ros::Time& now);
  void reportHealth();
  Health engagementHealth() const;
  Health missionHealth() const;
  Health vehicleHealth() const;
  Health cameraHealth() const;
  Health masterHealth() const;
  const FrameNames& frames() const { return params_.navigator.vehicle.frames; }

  NavigatorNodeParams params_;
  Diagnostics diagnostics_;
  TopicInput odom_, pose_;
  estimation::SenderClock odom_clock_;
  EngagementMonitor engagement_;
  UpstreamFaults upstream_;
  GuardMonitor guard_;
  ClockWatch clock_;
  navigation::Navigator navigator_;
  navigation::NavigatorInput input_;
  navigation::NavigatorOutput last_;
  FlightTrail trail_;
  double drawn_sec_ = 0.0, stepped_sec_ = 0.0;
  window_ingress::IngressState said_;
  double last_now_sec_ = -1.0, clock_moved_sec_ = 0.0, said_sec_ = 0.0;
  bool was_enabled_ = false, is_disabled_ = false;
  SetpointGate last_gate_;  // checked without delay, so no input is late
  std::string refused_;     // the last refusal
  std::optional<Lockstep> lockstep_;
  double step_sec_ = 0.0;  // in lockstep: the world's time

  ros::Subscriber engaged_subscriber_;
  ros::Publisher setpoint_publisher_, state_publisher_, marker_publisher_;
  std::vector<ros::ServiceServer> services_;
  std::optional<MissionAction> action_;  // not in lockstep, which has no client
  ros::SteadyTimer timer_;
  std::optional<MasterWatch> master_;  // not in lockstep
};

}  // namespace window_ingress::adapters
