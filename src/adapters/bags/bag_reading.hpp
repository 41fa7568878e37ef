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

/// Topics of a bag; empty: found by type.
struct BagTopics {
  std::string image, camera_info, odom, imu, truth;
};

/// Opens a bag for reading. \throws InputError for a missing, empty, truncated or otherwise broken file
void openBag(rosbag::Bag& bag, const std::string& file);

/// Types of messages by the topics that the bag has.
std::map<std::string, std::string> typesByTopic(const rosbag::Bag& bag);

/// Fills in what is empty: the one topic of the right type, ground truth and debug images left aside. An
/// image topic may be named without its "/compressed". `odom`, `imu` and `truth` may stay empty. \throws
/// InputError if there are no images, no calibration, or several topics to choose from
BagTopics chooseTopics(const rosbag::Bag& bag, const BagTopics& wanted);

/// What is wrong with the structure of a bag, so that rosbag must not open it: it follows lengths and places
/// out of the file without asking, and reads past its buffers. Empty if it may, or if rosbag itself will say
/// what is the matter (no file, no bag, no index). Of compressed chunks, whose contents bear a checksum, only
/// the sizes are looked at.
std::string whyDamaged(const std::string& file);

/// Transforms of a bag that hold for all of it, as the mounting of the camera does.
class RecordedTransforms {
 public:
  /// What is not finite is left out.
  void take(const tf2_msgs::TFMessage& message);
  /// T_to_from, or why it is not known.
  Converted<Eigen::Isometry3d> between(const std::string& to, const std::string& from) const;

 private:
  tf2::BufferCore buffer_;
};

/// T_camera_window by the stamps of the images, as a topic of true poses has it. What is not finite is left
/// out.
std::map<ros::Time, Eigen::Isometry3d> recordedTruth(const rosbag::Bag& bag, const std::string& topic);

/// Images of a bag with what they show, by a topic with the true pose of the window.
/// \param topics as chosen by `chooseTopics`, `truth` among them
/// \param every take one image of so many
/// \throws InputError if the bag is damaged, or nothing in it can be used
std::vector<evaluation::LabelledImage> labelledImages(const rosbag::Bag& bag, const BagTopics& topics,
                                                      const geometry::OpeningSize& opening, int every);

/// Images of a bag alone, decoded. \param most stop after so many
std::vector<cv::Mat> imagesOf(const rosbag::Bag& bag, const BagTopics& topics, int every, int most);

}  // namespace window_ingress::adapters
