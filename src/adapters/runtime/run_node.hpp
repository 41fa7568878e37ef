/// The main of every node: one line for refused parameters, signals answered within 2 s, exit codes.
#pragma once

#include <ros/node_handle.h>

#include <functional>
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

using MakeNode = std::function<std::unique_ptr<Node>(ros::NodeHandle& nh, ros::NodeHandle& pnh)>;

/// Runs one node until it is stopped.
/// \return 0 after SIGINT, SIGTERM or a shutdown; 2 if the node refused to start, after one line on stderr
int runNode(int argc, char** argv, const std::string& name, const MakeNode& make);

/// As above, for a class with a constructor from (nh, pnh).
template <typename Class>
int runNode(int argc, char** argv, const std::string& name) {
  return runNode(argc, argv, name,
                 [](ros::NodeHandle& nh, ros::NodeHandle& pnh) { return std::make_unique<Class>(nh, pnh); });
}

}  // namespace window_ingress::adapters
