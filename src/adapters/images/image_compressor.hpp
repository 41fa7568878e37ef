#pragma once

#include <ros/node_handle.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include "adapters/conversions/msg_conversion.hpp"
#include "adapters/images/image_conversion.hpp"
#include "adapters/runtime/diagnostics.hpp"
#include "adapters/runtime/run_node.hpp"

namespace window_ingress::adapters {

struct ImageCompressorParams {
  int quality = 90;  ///< JPEG quality, 1 to 100
  ImageLimits image;
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("quality", self.quality, 1, 100);
    field.group("image", self.image);
  }
};

/// The image as JPEG with the same header, or the reason why not.
Converted<sensor_msgs::CompressedImage> compress(const sensor_msgs::ImageConstPtr& image,
                                                 const ImageCompressorParams& params);

/// Publishes images as JPEG, for recordings with a camera driver that does not compress: image_raw to
/// compressed. If the topic already has a publisher, the node reports that and stays silent.
class ImageCompressorNode : public Node {
 public:
  ImageCompressorNode(ros::NodeHandle& nh, ros::NodeHandle& pnh);

 private:
  void receive(const sensor_msgs::ImageConstPtr& image);

  ImageCompressorParams params_;
  Diagnostics diagnostics_;
  ros::Publisher publisher_;
  ros::Subscriber subscriber_;
};

}  // namespace window_ingress::adapters
