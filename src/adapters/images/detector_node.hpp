#pragma once

#include <ros/node_handle.h>
#include <std_srvs/Trigger.h>
#include <window_ingress/ReferenceImage.h>
#include <window_ingress/WindowDetection.h>
#include <window_ingress/WindowDetectorConfig.h>
#include <window_ingress/WindowPose.h>

#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "adapters/images/image_source.hpp"
#include "adapters/images/processing_time.hpp"
#include "adapters/images/reference_source.hpp"
#include "adapters/inputs/attitude_source.hpp"
#include "adapters/inputs/camera_source.hpp"
#include "adapters/inputs/clock_watch.hpp"
#include "adapters/runtime/diagnostics.hpp"
#include "adapters/runtime/lockstep.hpp"
#include "adapters/runtime/reconfigure.hpp"
#include "adapters/runtime/run_node.hpp"
#include "window_ingress/configuration/detector_node_params.hpp"
#include "window_ingress/detection/window_detector.hpp"
#include "window_ingress/perception/window_perception.hpp"

namespace window_ingress::adapters {

using configuration::DetectorNodeParams;

/// The detector between topics: images in, corners out, with or without calibration.
class DetectorNode : public Node {
 public:
  DetectorNode(ros::NodeHandle& nh, ros::NodeHandle& pnh);

 private:
  using Trigger = std_srvs::Trigger;
  using Tuning = Reconfigure<window_ingress::WindowDetectorConfig, detection::DetectorParams>;

  void receive(const std_msgs::Header& header, const DecodedImage& decoded);
  void restartIfClockJumpedBack();
  void look(const std_msgs::Header& header, const DecodedImage& decoded);
  bool isComplete(const Lockstep::Step& step) const;
  void lookInStep(const Lockstep::Step& step);
  void publishDebugImage(const std_msgs::Header& header, const cv::Mat& image, double milliseconds);
  std::string yawAt(const ros::Time& stamp) const;
  void receivePose(const window_ingress::WindowPose::ConstPtr& message);
  bool hasPoseOfLastImage() const;
  std::optional<geometry::Quadrilateral> expectedAt(const std_msgs::Header& header) const;
  void receiveReference(const window_ingress::ReferenceImage& message);
  void use(const detection::ReferenceAppearance& reference, const std::string& source);
  std::string captureFault() const;
  bool captureReference(Trigger::Request& request, Trigger::Response& response);
  bool reset(Trigger::Request& request, Trigger::Response& response);
  Health detectionHealth() const;
  Health referenceHealth() const;

  navigation::VehicleParams vehicle_;
  DetectorNodeParams params_;
  Diagnostics diagnostics_;
  ClockWatch clock_;
  perception::WindowPerception perception_;
  CameraSource camera_;
  std::optional<AttitudeSource> attitude_;
  ImageSource images_;
  Tuning tuning_;
  cv::Mat canvas_;
  DecodedImage last_image_;
  double searched_sec_ = 0.0;  ///< time of the last searched image, on the steady clock
  bool reference_is_guess_ = false;
  std::string reference_from_;  // source of the reference; empty: no reference
  ProcessingTime times_;
  std::optional<Lockstep> lockstep_;
  std_msgs::Header waiting_header_;  // in lockstep: header of the image that waits for its step
  std::optional<DecodedImage> waiting_;
  ros::Time reference_stamp_, announced_, looked_;

  window_ingress::WindowPose::ConstPtr last_pose_;  // of an earlier image
  ros::Subscriber reference_subscriber_, pose_subscriber_;
  ros::Publisher window_publisher_, debug_publisher_;
  ros::ServiceServer capture_, reset_;
};

}  // namespace window_ingress::adapters
