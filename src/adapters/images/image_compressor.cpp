#include "adapters/images/image_compressor.hpp"

#include <ros/master.h>

#include "adapters/images/image_files.hpp"
#include "adapters/nodes.hpp"
#include "adapters/runtime/diagnostics.hpp"
#include "adapters/runtime/parameter_server.hpp"

namespace window_ingress::adapters {
namespace {

bool isPublished(const std::string& topic) {
  ros::master::V_TopicInfo topics;
  ros::master::getTopics(topics);
  for (const ros::master::TopicInfo& info : topics)
    if (info.name == topic) return true;
  return false;
}

}  // namespace

Converted<sensor_msgs::CompressedImage> compress(const sensor_msgs::ImageConstPtr& image,
                                                 const ImageCompressorParams& params) {
  const DecodedImage decoded = decode(image, params.image);
  if (!decoded.reason.empty()) return {std::nullopt, decoded.reason};
  sensor_msgs::CompressedImage message;
  message.header = image->header;
  const std::string encoding = decoded.image.channels() == 1 ? "mono8" : "bgr8";
  message.format = encoding + "; jpeg compressed " + (encoding == "mono8" ? "" : encoding);
  message.data = writeJpeg(decoded.image, params.quality);
  if (message.data.empty()) return {std::nullopt, "cannot be written as JPEG"};
  return {message, ""};
}

/// Publishes images as JPEG, for recordings with a camera driver that does not compress: image_raw to
/// compressed. If the topic already has a publisher, the node reports that and stays silent.
class ImageCompressorNode : public Node {
 public:
  ImageCompressorNode(ros::NodeHandle& nh, ros::NodeHandle& pnh)
      : params_(readParameters<ImageCompressorParams>(pnh)), diagnostics_(nh, pnh) {
    const std::string topic = nh.resolveName("compressed");
    if (isPublished(topic)) {
      ROS_WARN("%s is already published: this node is not needed (record.launch compress:=false)",
               topic.c_str());
      return;
    }
    publisher_ = nh.advertise<sensor_msgs::CompressedImage>("compressed", 5);
    subscriber_ = diagnostics_.subscribe(nh, "image_raw", 5, &ImageCompressorNode::receive, this);
  }

 private:
  void receive(const sensor_msgs::ImageConstPtr& image) {
    if (publisher_.getNumSubscribers() == 0) return;
    if (const auto compressed = compress(image, params_))
      publisher_.publish(*compressed.value);
    else
      ROS_WARN_THROTTLE(10.0, "image not compressed: %s", compressed.reason.c_str());
  }

  ImageCompressorParams params_;
  Diagnostics diagnostics_;
  ros::Publisher publisher_;
  ros::Subscriber subscriber_;
};

std::unique_ptr<Node> makeImageCompressor(ros::NodeHandle& nh, ros::NodeHandle& pnh) {
  return std::make_unique<ImageCompressorNode>(nh, pnh);
}

}  // namespace window_ingress::adapters
