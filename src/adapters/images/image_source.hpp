#pragma once

#include <image_transport/image_transport.h>
#include <ros/node_handle.h>

#include <functional>
#include <string>

#include "adapters/images/image_conversion.hpp"
#include "adapters/inputs/stamp_gate.hpp"
#include "adapters/runtime/topic_health.hpp"

namespace window_ingress::adapters {

/// Why images cannot come by this transport, and which there are; empty if they can.
std::string whyNoTransport(const std::string& transport);

/// Images of the topic `image_raw`, by any transport: those that image_transport has, and "compressed",
/// which is read here, because its plugin decodes without looking at sizes and is not in every distribution.
class ImageSource {
 public:
  using Callback = std::function<void(const std_msgs::Header&, const DecodedImage&)>;

  /// \throws InputError that lists the transports if there is no such one
  ImageSource(ros::NodeHandle& nh, Diagnostics& diagnostics, const std::string& transport,
              const ImageLimits& limits, const StampLimits& stamps, Callback callback);

  bool isConnected() const {
    return plugin_subscriber_.getNumPublishers() + compressed_subscriber_.getNumPublishers() > 0;
  }

 private:
  void subscribeCompressed(ros::NodeHandle& nh);
  void subscribePlugin(const std::string& transport);
  void receive(const std_msgs::Header& header, const std::function<DecodedImage()>& decode);

  ImageLimits limits_;
  StampGate gate_;
  StuckWatch stuck_;
  Callback callback_;
  Diagnostics& diagnostics_;
  TopicHealth health_;
  image_transport::ImageTransport transport_;
  image_transport::Subscriber plugin_subscriber_;
  ros::Subscriber compressed_subscriber_;
};

}  // namespace window_ingress::adapters
