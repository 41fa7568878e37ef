/// All nodes, and the main of each: one line for refused parameters, signals answered within 2 s, exit codes.
#pragma once

#include <ros/node_handle.h>

#include <memory>
#include <string>

namespace window_ingress::adapters {

/// A node that `runNode` runs.
class Node {
 public:
  virtual ~Node() = default;
  /// Called once after SIGINT or SIGTERM, while topics still exist: must leave the vehicle at rest, within
  /// one second.
  virtual void stop() {}
};

/// Makes a node with its parameters. \throws std::exception if it refuses to start
using MakeNode = std::unique_ptr<Node>(ros::NodeHandle& nh, ros::NodeHandle& pnh);

/// Runs one node until it is stopped.
/// \return 0 after SIGINT, SIGTERM or a shutdown; 2 if the node refused to start, after one line on stderr
int runNode(int argc, char** argv, const std::string& name, MakeNode& make);

MakeNode makeCameraMounting;
MakeNode makeHomographyPose;
MakeNode makeImageCompressor;
MakeNode makeIngressNavigator;
MakeNode makeSetpointGuard;
MakeNode makeWindowDetector;
MakeNode makeWorld;

}  // namespace window_ingress::adapters
