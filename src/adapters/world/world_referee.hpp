#pragma once

#include <ros/node_handle.h>
#include <window_ingress/FlightVerdict.h>
#include <window_ingress/IngressState.h>

#include <string>

#include "simulation/world.hpp"

namespace window_ingress::adapters {

/// The referee's verdict on a topic and in a file. The first outcome counts; later events are not part of the
/// flight.
class WorldReferee {
 public:
  /// \param file json, written at an outcome and at the end; empty: no file
  WorldReferee(ros::NodeHandle& nh, const std::string& file);

  void restart();
  void hear(const window_ingress::IngressState& state, const simulation::World& world);
  /// Call after each step of the world.
  void judge(const simulation::World& world, const ros::Time& now);
  void finish() const;  ///< call when the node ends

 private:
  double limitBegins(const simulation::World& world) const;
  window_ingress::FlightVerdict verdict(const simulation::World& world, const ros::Time& now) const;
  void write() const;

  std::string file_;
  ros::Publisher publisher_;
  simulation::Claim claim_ = simulation::Claim::kNone;
  bool heard_of_this_flight_ = false;  // before it, PASSED and ABORTED belong to an earlier flight
  window_ingress::FlightVerdict said_;
  double mission_start_sec_ = -1.0, judge_due_sec_ = 0.0, verdict_due_sec_ = 0.0;  // in the world's time
};

/// The content of the file.
std::string toJson(const window_ingress::FlightVerdict& verdict);

}  // namespace window_ingress::adapters
