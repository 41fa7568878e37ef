/// Detector, pose and filter over a bag, in this process, by the time of the bag: the same bag gives the same
/// bytes.
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

/// What became of one image.
struct ReplayedFrame {
  ros::Time stamp;
  evaluation::DetectionRow row;
  std::optional<estimation::FilteredWindow> filtered;
  openness::OpennessVerdict openness;  ///< UNKNOWN without poses
  std::string why_not_filtered;        ///< empty if this image contributed
  std::optional<geometry::PinholeCamera> camera;
  bool has_odometry = false;               ///< at the exposure
  bool has_attitude = false;               ///< likewise
  std::optional<Eigen::Isometry3d> truth;  ///< T_camera_window, if the bag holds it for this image
  cv::Mat image;                           ///< valid during the call
  const perception::WindowPerception* perception = nullptr;  ///< likewise: all that it saw
  const estimation::TargetEstimator* tracker = nullptr;      ///< likewise: all that is known after it
  double detector_ms = 0.0, pose_ms = 0.0;
};

struct ReplaySummary {
  int images = 0;                      ///< that could be read
  int calibrated = 0;                  ///< of those: with a calibration that fits
  int with_odometry = 0;               ///< of those: with odometry at the exposure
  int with_attitude = 0;               ///< of those: with an attitude at the exposure
  int jumps = 0;                       ///< back in time, after each of which everything was forgotten
  int refused = 0;                     ///< messages that could not be used
  std::map<std::string, int> reasons;  ///< why, numbers left out
  std::string refusal;                 ///< the last of them
  double milliseconds = 0.0;           ///< spent in the detector and the pose
};

/// The target as the bag itself has it, if it does: what the nodes would take. \throws InputError
std::optional<detection::ReferenceAppearance> recordedReference(const rosbag::Bag& bag,
                                                                const ReplayParams& params);

/// frame_id of the bag's odometry; empty without any.
std::string recordedOdomFrame(const rosbag::Bag& bag, const std::string& topic);

/// A stamp more than `kJumpSec` before the newest one is a jump back in time: everything starts anew, as it
/// does in the nodes when a bag is looped. \param each called for each image in the order of the bag \param
/// jumped called at each jump, with what to say about it \throws InputError if the bag is damaged half way
ReplaySummary replay(const rosbag::Bag& bag, const ReplayParams& params,
                     const std::function<void(const ReplayedFrame&)>& each,
                     const std::function<void(const std::string&)>& jumped = {});

constexpr double kJumpSec = 1.0;

}  // namespace window_ingress::adapters
