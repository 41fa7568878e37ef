// The nodes as nodelets, for a nodelet manager that shares images without copying. setpoint_guard and world
// are separate processes on purpose. Each nodelet has its own queue and thread, because the manager's thread
// could call into a node during its construction or destruction.
#include <nodelet/nodelet.h>
#include <ros/callback_queue.h>
#include <ros/names.h>
#include <ros/spinner.h>

#include <exception>
#include <memory>
#include <pluginlib/class_list_macros.hpp>
#include <string>

#include "adapters/nodes.hpp"
#include "adapters/runtime/console_decoupling.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::adapters {

template <MakeNode& make>
class NodeletOf : public nodelet::Nodelet {
 public:
  ~NodeletOf() override {
    spinner_.stop();
    if (node_) node_->stop();
  }

 private:
  // An exception from onInit would end the manager and every nodelet in it.
  void onInit() override {
    decoupleConsole();  // affects the whole manager: its console output no longer waits for a terminal
    try {
      ros::NodeHandle nh = getNodeHandle(), pnh = getPrivateNodeHandle();
      const std::string space = nh.getNamespace();  // roscpp cannot name /: it is empty, or the manager's
      if (!space.empty() && space != ros::names::parentNamespace(getName()))
        throw InputError("its topics would be in " + space +
                         ", the manager's namespace: take a manager in /, or start all nodes in a namespace");
      nh.setCallbackQueue(&queue_);
      pnh.setCallbackQueue(&queue_);
      node_ = make(nh, pnh);
      spinner_.start();
    } catch (const std::exception& error) {
      NODELET_FATAL("%s: not started: %s", getName().c_str(), error.what());
    }
  }
  ros::CallbackQueue queue_;
  std::unique_ptr<Node> node_;
  ros::AsyncSpinner spinner_{1, &queue_};
};

class WindowDetectorNodelet : public NodeletOf<makeWindowDetector> {};
class HomographyPoseNodelet : public NodeletOf<makeHomographyPose> {};
class IngressNavigatorNodelet : public NodeletOf<makeIngressNavigator> {};

}  // namespace window_ingress::adapters

PLUGINLIB_EXPORT_CLASS(window_ingress::adapters::WindowDetectorNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(window_ingress::adapters::HomographyPoseNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(window_ingress::adapters::IngressNavigatorNodelet, nodelet::Nodelet)
