/// Checks whether bags hold the topics that replay.launch plays from them.
#pragma once

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "adapters/bags/bag_check.hpp"
#include "launch_checks.hpp"

namespace window_ingress::tools {

/// Message types by topic over all bags; empty if one of them cannot be opened, which is reported elsewhere.
/// \throws InputError for a damaged bag: rosbag would read past its end
inline std::map<std::string, std::string> typesIn(const std::vector<std::string>& bags) {
  std::map<std::string, std::string> types;
  for (const auto& file : bags)
    if (!std::filesystem::is_regular_file(file)) return {};
  try {
    for (const auto& file : bags) {
      if (const std::string damage = adapters::whyDamaged(file); !damage.empty())
        throw InputError(file + ": damaged: " + damage + "; repair it with 'rosbag reindex'");
      const rosbag::Bag bag(file);
      for (const auto* topic : rosbag::View(bag).getConnections()) types[topic->topic] = topic->datatype;
    }
  } catch (const rosbag::BagException&) {
    return {};
  }
  return types;
}

/// The argument of replay.launch for a topic of this type; empty if it does not play this type.
inline std::string argumentFor(const std::string& topic, const std::string& type) {
  static const std::map<std::string, std::string> names = {
      {"sensor_msgs/CameraInfo", "camera_info:="},
      {"nav_msgs/Odometry", "odom:="},
      {"sensor_msgs/Imu", "imu:="},
      {"sensor_msgs/Image", "image_transport:=raw image:="}};
  if (type == "sensor_msgs/CompressedImage") return "image:=" + topic.substr(0, topic.rfind('/'));
  const auto name = names.find(type);
  return name == names.end() ? "" : name->second + topic;
}

/// The player's clock is the time of recording: if that is not the time of the stamps, the nodes refuse all.
/// \throws InputError for a bag whose recorder ran by another clock than the camera
inline void checkRecordersClock(const std::vector<std::string>& bags) {
  constexpr double kDaySec = 86400.0;
  for (const auto& file : bags) {
    const rosbag::Bag bag(file);
    for (const auto& message : rosbag::View(bag, rosbag::TypeQuery("sensor_msgs/CameraInfo"))) {
      const auto info = message.instantiate<sensor_msgs::CameraInfo>();
      if (!info || info->header.stamp.isZero()) break;
      const double days = (message.getTime() - info->header.stamp).toSec() / kDaySec;
      if (std::abs(days) > 1.0)
        throw InputError(formatted(
            "replay.launch: %s: recorded %.0f days after the stamps of its images. Start record.launch after "
            "sim.launch, so that both have one clock. 'ingress replay' can read this bag",
            file.c_str(), days));
      break;
    }
  }
}

/// \param played NAME=TOPIC separated by blanks, NAME being the launch argument
/// \throws InputError that names each topic missing in all bags, and alternatives in them
inline void checkPlayed(const std::string& files, const std::string& played) {
  const auto types = typesIn(filesIn(files));
  std::vector<std::string> faults;
  std::istringstream words(types.empty() ? "" : played);
  for (std::string word; words >> word;) {
    const auto name = word.substr(0, word.find('=')), topic = word.substr(name.size() + 1);
    if (types.count(topic) > 0) continue;
    std::string others;
    for (const auto& [other, type] : types) {
      const std::string argument = argumentFor(other, type);
      const bool is_aside = other.rfind("/ground_truth/", 0) == 0 || other.rfind("/debug_image", 0) == 0;
      if (!is_aside && argument.find(name + ":=") != std::string::npos)
        others += (others.empty() ? ": give " : " or ") + argument;
    }
    if (types.count(topic + "/compressed") > 0) others = ": give image_transport:=compressed";
    if (!others.empty()) faults.push_back("replay.launch: no " + topic + " in " + files + others);
  }
  if (!faults.empty()) throw InputError(parameters::joined(faults, "\n"));
  if (!types.empty()) checkRecordersClock(filesIn(files));
}

}  // namespace window_ingress::tools
