#include "adapters/bags/bag_topics.hpp"

#include <rosbag/exceptions.h>
#include <rosbag/view.h>

#include <filesystem>
#include <map>
#include <set>

#include "adapters/bags/bag_check.hpp"

namespace window_ingress::adapters {
namespace {

using Types = std::set<std::string>;

const Types kImages{"sensor_msgs/Image", "sensor_msgs/CompressedImage"};

std::map<std::string, std::string> typesByTopic(const rosbag::Bag& bag) {
  std::map<std::string, std::string> found;
  for (const rosbag::ConnectionInfo* connection : rosbag::View(bag).getConnections())
    found[connection->topic] = connection->datatype;
  return found;
}

bool isAside(const std::string& topic) {
  for (const char* part : {"ground_truth", "debug", "/demo/", "/rosbag/"})
    if (topic.find(part) != std::string::npos) return true;
  return false;
}

std::string listed(const std::map<std::string, std::string>& topics) {
  std::string text;
  for (const auto& [topic, type] : topics) text += (text.empty() ? "" : ", ") + topic + " (" + type + ")";
  return text;
}

class Chooser {
 public:
  explicit Chooser(const rosbag::Bag& bag) : bag_(bag), topics_(typesByTopic(bag)) {}

  std::string choose(const std::string& option, const std::string& wanted, const Types& types,
                     const std::string& needed = "") const {
    if (!wanted.empty()) return named(option, wanted, types);
    std::map<std::string, std::string> found;
    for (const auto& [topic, type] : topics_)
      if (types.count(type) > 0 && !isAside(topic)) found[topic] = type;
    if (found.empty() && !needed.empty())
      throw InputError(bag_.getFileName() + ": no " + needed + " in it: no topic of type " + *types.begin() +
                       ", only " + listed(topics_));
    if (found.size() > 1)
      throw InputError(bag_.getFileName() + ": choose one with " + option + ": " + listed(found));
    return found.empty() ? "" : found.begin()->first;
  }

 private:
  std::string named(const std::string& option, const std::string& wanted, const Types& types) const {
    for (const std::string& topic :
         {wanted, wanted + "/compressed", "/" + wanted, "/" + wanted + "/compressed"}) {
      const auto found = topics_.find(topic);
      if (found != topics_.end() && types.count(found->second) > 0) return topic;
    }
    throw InputError(bag_.getFileName() + ": " + option + " " + wanted + " is not in it as " +
                     *types.begin() + "; it has " + listed(topics_));
  }
  const rosbag::Bag& bag_;
  std::map<std::string, std::string> topics_;
};

}  // namespace

void openBag(rosbag::Bag& bag, const std::string& file) {
  if (std::filesystem::is_directory(file)) throw InputError(file + ": is a folder; name one bag in it");
  if (const std::string damage = whyDamaged(file); !damage.empty())
    throw InputError(file + ": damaged: " + damage + "; see 'rosbag check' and 'rosbag reindex'");
  try {
    bag.open(file, rosbag::bagmode::Read);
  } catch (const rosbag::BagUnindexedException&) {
    throw InputError(file + ": has no index, the recording was cut off; repair it with 'rosbag reindex'");
  } catch (const rosbag::BagException& error) {
    throw InputError(file + ": cannot be read as a bag: " + error.what());
  } catch (const std::exception& error) {  // of whatever a damaged file makes it allocate
    throw InputError(file + ": damaged: " + error.what());
  }
}

BagTopics chooseTopics(const rosbag::Bag& bag, const BagTopics& wanted) {
  const Chooser chooser(bag);
  BagTopics topics;
  topics.image = chooser.choose("--image", wanted.image, kImages, "images");
  topics.camera_info =
      chooser.choose("--camera-info", wanted.camera_info, {"sensor_msgs/CameraInfo"}, "calibration");
  topics.odom = chooser.choose("--odom", wanted.odom, {"nav_msgs/Odometry"});
  topics.imu = chooser.choose("--imu", wanted.imu, {"sensor_msgs/Imu"});
  if (!wanted.truth.empty())
    topics.truth = chooser.choose("--truth", wanted.truth, {"geometry_msgs/PoseStamped"}, "truth");
  return topics;
}

}  // namespace window_ingress::adapters
