#include <ros/callback_queue.h>
#include <ros/console.h>
#include <ros/init.h>
#include <ros/master.h>

#include <csignal>
#include <cstdio>
#include <exception>

#include "adapters/nodes.hpp"
#include "adapters/runtime/console_decoupling.hpp"

namespace window_ingress::adapters {
namespace {

volatile std::sig_atomic_t stop_requested = 0;

void requestStop(int) { stop_requested = 1; }

// roscpp's own handler closes the topics before the node can send its last messages.
void catchSignals() {
  std::signal(SIGINT, requestStop);
  std::signal(SIGTERM, requestStop);
}

// roscpp's own wait for a master ignores signals.
bool waitForMaster() {
  if (ros::master::check()) return true;
  std::fprintf(stderr, "waiting for a ROS master at %s\n", ros::master::getURI().c_str());
  while (!stop_requested && !ros::master::check()) ros::WallDuration(0.2).sleep();
  return !stop_requested;
}

void spinUntilStopped() {
  constexpr double kLongestWaitSec = 0.05;
  while (ros::ok() && !stop_requested)
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(kLongestWaitSec));
}

// The reason must stand out among the other nodes' lines, because roslaunch continues without this node.
std::unique_ptr<Node> makeOrSayWhyNot(const std::string& name, MakeNode& make, ros::NodeHandle& nh,
                                      ros::NodeHandle& pnh) {
  try {
    return make(nh, pnh);
  } catch (const std::exception& error) {
    ROS_FATAL("%s: %s", name.c_str(), error.what());
    return nullptr;
  }
}

}  // namespace

int runNode(int argc, char** argv, const std::string& name, MakeNode& make) {
  decoupleConsole();
  bool refused = false;
  try {
    ros::init(argc, argv, name, ros::init_options::NoSigintHandler);
    catchSignals();
    if (!waitForMaster()) return 0;
    ros::NodeHandle nh, pnh("~");
    const std::unique_ptr<Node> node = makeOrSayWhyNot(name, make, nh, pnh);
    refused = !node;
    if (node) spinUntilStopped();
    if (node && ros::ok()) node->stop();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name.c_str(), error.what());
    refused = true;
  }
  ros::shutdown();
  return refused ? 2 : 0;
}

}  // namespace window_ingress::adapters
