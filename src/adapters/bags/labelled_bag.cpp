#include "adapters/bags/labelled_bag.hpp"

#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>

#include <functional>

#include "adapters/bags/recorded_transforms.hpp"
#include "adapters/conversions/msg_conversion.hpp"
#include "adapters/images/image_conversion.hpp"

namespace window_ingress::adapters {
namespace {

/// Calls `each` with every image that can be read, until it says false.
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

// Images of one second look alike.
std::string groupOf(const rosbag::Bag& bag, const ros::Time& stamp) {
  return bag.getFileName() + "/" + std::to_string(stamp.sec);
}

template <typename Work>
auto readingBag(const rosbag::Bag& bag, const Work& work) {
  try {
    return work();
  } catch (const ros::Exception& error) {  // rosbag's own and those of deserialisation
    throw InputError(bag.getFileName() + ": damaged: " + error.what());
  }
}

}  // namespace

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
      sample->name = std::to_string(header.stamp.toSec());
      sample->group = groupOf(bag, header.stamp);
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
