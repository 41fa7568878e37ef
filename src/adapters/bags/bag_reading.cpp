#include "adapters/bags/bag_reading.hpp"

#include <geometry_msgs/PoseStamped.h>
#include <rosbag/exceptions.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <tf2/exceptions.h>

#include <filesystem>
#include <functional>
#include <set>

#include "adapters/bags/bag_check.hpp"
#include "adapters/images/image_conversion.hpp"

namespace window_ingress::adapters {
namespace {

using Types = std::set<std::string>;

const Types kImages{"sensor_msgs/Image", "sensor_msgs/CompressedImage"};

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

std::string named(const rosbag::Bag& bag, const std::string& option, const std::string& wanted,
                  const Types& types) {
  const auto topics = typesByTopic(bag);
  for (const std::string& topic :
       {wanted, wanted + "/compressed", "/" + wanted, "/" + wanted + "/compressed"}) {
    const auto found = topics.find(topic);
    if (found != topics.end() && types.count(found->second) > 0) return topic;
  }
  throw InputError(bag.getFileName() + ": " + option + " " + wanted + " is not in it as " + *types.begin() +
                   "; it has " + listed(topics));
}

/// \param needed what the topic holds, if the bag must have it
std::string choose(const rosbag::Bag& bag, const std::string& option, const std::string& wanted,
                   const Types& types, const std::string& needed = "") {
  if (!wanted.empty()) return named(bag, option, wanted, types);
  const auto topics = typesByTopic(bag);
  std::map<std::string, std::string> found;
  for (const auto& [topic, type] : topics)
    if (types.count(type) > 0 && !isAside(topic)) found[topic] = type;
  if (found.empty() && !needed.empty())
    throw InputError(bag.getFileName() + ": no " + needed + " in it: no topic of type " + *types.begin() +
                     ", only " + listed(topics));
  if (found.size() > 1)
    throw InputError(bag.getFileName() + ": choose one with " + option + ": " + listed(found));
  return found.empty() ? "" : found.begin()->first;
}

/// Calls `each` with every readable image until it returns false.
void forEachImage(const rosbag::Bag& bag, const std::string& topic, int every,
                  const std::function<bool(const std_msgs::Header&, const cv::Mat&)>& each) {
  int number = 0;
  for (const rosbag::MessageInstance& message : rosbag::View(bag, rosbag::TopicQuery(topic))) {
    if (number++ % every != 0) continue;
    DecodedImage decoded;
    std_msgs::Header header;
    if (const auto image = message.instantiate<sensor_msgs::Image>()) {
      header = image->header;
      decoded = decode(image, ImageLimits{});
    } else if (const auto compressed = message.instantiate<sensor_msgs::CompressedImage>()) {
      header = compressed->header;
      decoded = decode(*compressed, ImageLimits{});
    }
    if (!decoded.image.empty() && !each(header, decoded.image)) return;
  }
}

geometry::PinholeCamera cameraOf(const rosbag::Bag& bag, const std::string& topic) {
  std::string reason = "nothing on it";
  for (const rosbag::MessageInstance& message : rosbag::View(bag, rosbag::TopicQuery(topic))) {
    const auto info = message.instantiate<sensor_msgs::CameraInfo>();
    if (!info) continue;
    const auto camera = cameraFromMsg(*info, false);
    if (camera) return *camera.value;
    reason = camera.reason;
  }
  throw InputError(bag.getFileName() + ": " + topic + ": " + reason);
}

template <typename Work>
auto readingBag(const rosbag::Bag& bag, const Work& work) {
  try {
    return work();
  } catch (const ros::Exception& error) {  // from rosbag and from deserialisation
    throw InputError(bag.getFileName() + ": damaged: " + error.what());
  }
}

}  // namespace

void openBag(rosbag::Bag& bag, const std::string& file) {
  if (std::filesystem::is_directory(file)) throw InputError(file + ": is a folder; name one bag in it");
  if (const std::string damage = whyDamaged(file); !damage.empty())
    throw InputError(file + ": damaged: " + damage + "; repair it with 'rosbag reindex'");
  try {
    bag.open(file, rosbag::bagmode::Read);
  } catch (const rosbag::BagUnindexedException&) {
    throw InputError(file + ": has no index, the recording was cut off; repair it with 'rosbag reindex'");
  } catch (const rosbag::BagException& error) {
    throw InputError(file + ": cannot be read as a bag: " + error.what());
  } catch (const std::exception& error) {  // also allocation failures of a damaged file
    throw InputError(file + ": damaged: " + error.what());
  }
}

std::map<std::string, std::string> typesByTopic(const rosbag::Bag& bag) {
  std::map<std::string, std::string> found;
  for (const rosbag::ConnectionInfo* connection : rosbag::View(bag).getConnections())
    found[connection->topic] = connection->datatype;
  return found;
}

BagTopics chooseTopics(const rosbag::Bag& bag, const BagTopics& wanted) {
  BagTopics topics;
  topics.image = choose(bag, "--image", wanted.image, kImages, "images");
  topics.camera_info =
      choose(bag, "--camera-info", wanted.camera_info, {"sensor_msgs/CameraInfo"}, "calibration");
  topics.odom = choose(bag, "--odom", wanted.odom, {"nav_msgs/Odometry"});
  topics.imu = choose(bag, "--imu", wanted.imu, {"sensor_msgs/Imu"});
  if (!wanted.truth.empty())
    topics.truth = choose(bag, "--truth", wanted.truth, {"geometry_msgs/PoseStamped"}, "truth");
  return topics;
}

void RecordedTransforms::take(const tf2_msgs::TFMessage& message) {
  for (const geometry_msgs::TransformStamped& transform : message.transforms)
    if (fromMsg(transform.transform)) buffer_.setTransform(transform, "bag", true);
}

Converted<Eigen::Isometry3d> RecordedTransforms::between(const std::string& to,
                                                         const std::string& from) const {
  try {
    return fromMsg(buffer_.lookupTransform(to, from, ros::Time(0)).transform);
  } catch (const tf2::TransformException& error) {
    return {std::nullopt, error.what()};
  }
}

std::map<ros::Time, Eigen::Isometry3d> recordedTruth(const rosbag::Bag& bag, const std::string& topic) {
  std::map<ros::Time, Eigen::Isometry3d> truth;
  for (const rosbag::MessageInstance& message : rosbag::View(bag, rosbag::TopicQuery(topic)))
    if (const auto pose = message.instantiate<geometry_msgs::PoseStamped>())
      if (const auto T_camera_window = fromMsg(pose->pose))
        truth[pose->header.stamp] = *T_camera_window.value;
  return truth;
}

std::vector<evaluation::LabelledImage> labelledImages(const rosbag::Bag& bag, const BagTopics& topics,
                                                      const geometry::OpeningSize& opening, int every) {
  return readingBag(bag, [&] {
    const auto truth = recordedTruth(bag, topics.truth);
    const geometry::PinholeCamera camera = cameraOf(bag, topics.camera_info);
    std::vector<evaluation::LabelledImage> images;
    forEachImage(bag, topics.image, every, [&](const std_msgs::Header& header, const cv::Mat& image) {
      const auto pose = truth.find(header.stamp);
      if (pose == truth.end() || image.cols != camera.width || image.rows != camera.height) return true;
      auto sample = evaluation::labelled(image.clone(), pose->second, camera, opening);
      if (!sample) return true;
      sample->group =
          bag.getFileName() + "/" + std::to_string(header.stamp.sec);  // images within one second look alike
      images.push_back(*sample);
      return true;
    });
    if (images.empty())
      throw InputError(bag.getFileName() + ": no image on " + topics.image + " with the stamp of a pose on " +
                       topics.truth + " and the size of the calibration");
    return images;
  });
}

std::vector<cv::Mat> imagesOf(const rosbag::Bag& bag, const BagTopics& topics, int every, int most) {
  return readingBag(bag, [&] {
    std::vector<cv::Mat> images;
    forEachImage(bag, topics.image, every, [&](const std_msgs::Header&, const cv::Mat& image) {
      images.push_back(image.clone());
      return static_cast<int>(images.size()) < most;
    });
    return images;
  });
}

}  // namespace window_ingress::adapters
