#pragma once

#include <ros/time.h>
#include <rosbag/bag.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

#include <Eigen/Geometry>
#include <map>
#include <string>
#include <vector>

#include "adapters/conversions/msg_conversion.hpp"
#include "evaluation/images/labelled_image.hpp"
#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::adapters {

/// Topics of a bag; an empty one is found by its type.
struct BagTopics {
  std::string image, camera_info, odom, imu, truth;
};

/// Opens a bag for reading. \throws InputError for a missing, empty, truncated or otherwise broken file
void openBag(rosbag::Bag& bag, const std::string& file);

/// Message types in the bag, by topic.
std::map<std::string, std::string> typesByTopic(const rosbag::Bag& bag);

/// Fills in each empty topic with the only one of the right type, ignoring ground truth and debug images. An
/// image topic may be named without "/compressed". `odom`, `imu` and `truth` may stay empty. \throws
/// InputError if there are no images, no calibration, or several topics to choose from
BagTopics chooseTopics(const rosbag::Bag& bag, const BagTopics& wanted);

/// Transforms that hold for the whole bag, such as the camera's mounting.
class RecordedTransforms {
 public:
  /// Ignores transforms that are not finite.
  void take(const tf2_msgs::TFMessage& message);
  /// T_to_from, or the reason why it is unknown.
  Converted<Eigen::Isometry3d> between(const std::string& to, const std::string& from) const;

 private:
  tf2::BufferCore buffer_;
};

/// T_camera_window by image stamp, from a topic of true poses. Poses that are not finite are left out.
std::map<ros::Time, Eigen::Isometry3d> recordedTruth(const rosbag::Bag& bag, const std::string& topic);

/// Images of a bag, labelled by the true pose of the window.
/// \param topics as chosen by `chooseTopics`, `truth` among them
/// \param every use one image out of this many
/// \throws InputError if the bag is damaged, or nothing in it can be used
std::vector<evaluation::LabelledImage> labelledImages(const rosbag::Bag& bag, const BagTopics& topics,
                                                      const geometry::OpeningSize& opening, int every);

/// Decoded images of a bag, without labels. \param most stops after this many
std::vector<cv::Mat> imagesOf(const rosbag::Bag& bag, const BagTopics& topics, int every, int most);

}  // namespace window_ingress::adapters
