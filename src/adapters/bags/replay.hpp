/// Runs detector, pose and filter over a bag in this process, by the bag's time: results are reproducible to
/// the byte.
#pragma once

#include <rosbag/bag.h>

#include <functional>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "adapters/bags/bag_reading.hpp"
#include "adapters/conversions/msg_conversion.hpp"
#include "adapters/images/image_conversion.hpp"
#include "evaluation/flights/flight_perception.hpp"
#include "evaluation/images/detection_table.hpp"

namespace window_ingress::adapters {

struct ReplayParams : configuration::Overlay {
  BagTopics topics;  ///< as chosen by `chooseTopics`
  std::optional<detection::ReferenceAppearance> reference = {};
  bool with_pose = false;  ///< the window's size is known
};

/// Result for one image.
struct ReplayedFrame {
  ros::Time stamp;
  evaluation::DetectionRow row;
  std::optional<estimation::FilteredWindow> filtered;
  openness::OpennessVerdict openness;  ///< UNKNOWN without poses
  std::string why_not_filtered;        ///< empty if this image contributed to the filter
  std::optional<geometry::PinholeCamera> camera;
  bool has_odometry = false;               ///< odometry at the exposure
  bool has_attitude = false;               ///< attitude at the exposure
  std::optional<Eigen::Isometry3d> truth;  ///< T_camera_window, if the bag holds it for this image
  cv::Mat image;                           ///< valid during the call
  const perception::WindowPerception* perception = nullptr;  ///< all detections; valid during the call
  const estimation::TargetEstimator* estimator = nullptr;  ///< state after this image; valid during the call
  double detector_ms = 0.0, pose_ms = 0.0;
};

struct ReplaySummary {
  int images = 0;                      ///< readable images
  int calibrated = 0;                  ///< images with a matching calibration
  int with_odometry = 0;               ///< images with odometry at the exposure
  int with_attitude = 0;               ///< images with an attitude at the exposure
  int jumps = 0;                       ///< jumps back in time, each of which resets everything
  int refused = 0;                     ///< unusable messages
  std::map<std::string, int> reasons;  ///< reasons of the refusals, without numbers
  std::string refusal;                 ///< the last refusal
  double milliseconds = 0.0;           ///< processing time of detector and pose
};

/// The reference in the bag, if any, as the nodes would use it. \throws InputError
std::optional<detection::ReferenceAppearance> recordedReference(const rosbag::Bag& bag,
                                                                const ReplayParams& params);

/// frame_id of the bag's odometry; empty without any.
std::string recordedOdomFrame(const rosbag::Bag& bag, const std::string& topic);

/// A stamp more than `kJumpSec` before the newest one is a jump back in time, which resets everything, as a
/// looped bag does in the nodes. \param each called for each image in the order of the bag \param jumped
/// called at each jump, with a message \throws InputError if the bag is damaged halfway
ReplaySummary replay(const rosbag::Bag& bag, const ReplayParams& params,
                     const std::function<void(const ReplayedFrame&)>& each,
                     const std::function<void(const std::string&)>& jumped = {});

constexpr double kJumpSec = 1.0;

}  // namespace window_ingress::adapters
