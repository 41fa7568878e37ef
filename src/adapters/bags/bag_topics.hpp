#pragma once

#include <rosbag/bag.h>

#include <string>

#include "window_ingress/text/text.hpp"

namespace window_ingress::adapters {

/// Topics of a bag; empty: found by type.
struct BagTopics {
  std::string image, camera_info, odom, imu, truth;
};

/// Opens a bag for reading. \throws InputError for a missing, empty, truncated or otherwise broken file
void openBag(rosbag::Bag& bag, const std::string& file);

/// Fills in what is empty: the one topic of the right type, ground truth and debug images left aside. An
/// image topic may be named without its "/compressed". `odom`, `imu` and `truth` may stay empty. \throws
/// InputError if there are no images, no calibration, or several topics to choose from
BagTopics chooseTopics(const rosbag::Bag& bag, const BagTopics& wanted);

}  // namespace window_ingress::adapters
