#pragma once

#include <ros/node_handle.h>
#include <std_srvs/Trigger.h>
#include <window_ingress/ReferencePicture.h>
#include <window_ingress/WindowDetection.h>
#include <window_ingress/WindowDetectorConfig.h>

#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "adapters/camera_source.hpp"
#include "adapters/diagnostics.hpp"
#include "adapters/image_source.hpp"
#include "adapters/lockstep.hpp"
#include "adapters/reconfigure.hpp"
#include "adapters/run_node.hpp"
#include "window_ingress/detection/window_detector.hpp"
#include "window_ingress/detection/window_tracker.hpp"

namespace window_ingress::adapters {

/// The operator's picture of the target.
struct ReferenceParams {
  std::string picture;          ///< file; empty: no reference
  std::vector<double> corners;  ///< of the opening's inner border in it, x1 y1 .. x4 y4 from top left,
                                ///< clockwise [px]; empty: the whole picture is the target with its frame
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("picture", self.picture);
    field("corners", self.corners);
  }
};

struct DetectorNodeParams {
  std::string image_transport = "raw";  ///< raw, compressed, or a plugin of image_transport
  bool image_is_rectified = false;      ///< pictures are rectified: P of camera_info counts
  bool lockstep = false;                ///< with the simulated world, step by step; only with use_sim_time
  ImageLimits image;
  StampLimits stamps;
  ReferenceParams reference;
  detection::DetectorParams detector;
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("image_transport", self.image_transport);
    field("image_is_rectified", self.image_is_rectified);
    field("lockstep", self.lockstep);
    field.group("image", self.image);
    field.group("stamps", self.stamps);
    field.group("reference", self.reference);
    field.group("detector", self.detector);
  }
};

/// A reference from a picture and eight numbers, or none for the whole picture. \throws ParameterError
detection::ReferenceAppearance makeReference(const cv::Mat& picture, const std::vector<double>& corners,
                                             const detection::DetectorParams& params);

/// Reads the operator's picture. \throws ParameterError that says what is wrong with it
detection::ReferenceAppearance loadReference(const ReferenceParams& reference,
                                             const detection::DetectorParams& params);

/// The detector between topics: images in, corners out, with or without calibration.
class DetectorNode : public Node {
 public:
  DetectorNode(ros::NodeHandle& nh, ros::NodeHandle& pnh);

 private:
  using Trigger = std_srvs::Trigger;
  using Tuning = Reconfigure<window_ingress::WindowDetectorConfig, detection::DetectorParams>;

  void receive(const std_msgs::Header& header, const GuardedImage& picture);
  void look(const std_msgs::Header& header, const GuardedImage& picture);
  bool isComplete(const Lockstep::Step& step) const;
  void lookInStep(const Lockstep::Step& step);
  void publishDebugImage(const std_msgs::Header& header, const cv::Mat& image);
  void receiveReference(const window_ingress::ReferencePicture& message);
  bool captureReference(Trigger::Request& request, Trigger::Response& response);
  bool reset(Trigger::Request& request, Trigger::Response& response);
  Health detectionHealth() const;

  DetectorNodeParams params_;
  Diagnostics diagnostics_;
  detection::WindowTracker detector_;
  CameraSource camera_;
  ImageSource images_;
  Tuning tuning_;
  cv::Mat canvas_;
  GuardedImage last_picture_;
  std::optional<detection::WindowObservation> last_window_;
  double slowest_ms_ = 0.0;
  std::optional<Lockstep> lockstep_;
  std_msgs::Header waiting_header_;  // in lockstep: of the picture that waits for its step
  std::optional<GuardedImage> waiting_;
  ros::Time reference_stamp_, announced_;

  ros::Subscriber reference_subscriber_;
  ros::Publisher window_publisher_, debug_publisher_;
  ros::ServiceServer capture_, reset_;
};

}  // namespace window_ingress::adapters
