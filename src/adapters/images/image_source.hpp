#pragma once

#include <image_transport/exception.h>
#include <image_transport/image_transport.h>
#include <image_transport/subscriber_plugin.h>
#include <ros/node_handle.h>
#include <sensor_msgs/CompressedImage.h>

#include <functional>
#include <pluginlib/class_loader.hpp>
#include <string>
#include <utility>

#include "adapters/images/image_conversion.hpp"
#include "adapters/images/stuck_camera.hpp"
#include "adapters/inputs/rate_limit.hpp"
#include "adapters/inputs/topic_input.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::adapters {

/// Why this transport cannot be used, with a list of transports; empty if it can.
inline std::string whyNoTransport(const std::string& transport) {
  using Plugin = image_transport::SubscriberPlugin;
  std::string known = "compressed";
  pluginlib::ClassLoader<Plugin> plugins("image_transport", "image_transport::SubscriberPlugin");
  for (const std::string& plugin : plugins.getDeclaredClasses()) {
    if (transport == "compressed" || plugin == Plugin::getLookupName(transport)) return "";
    const std::string name = plugin.substr(plugin.find('/') + 1, plugin.rfind("_sub") - plugin.find('/') - 1);
    if (name != "compressed") known += ", " + name;
  }
  return "image_transport is '" + transport + "', available are: " + known +
         "; for others install the plugin (Noetic: ros-noetic-" + transport +
         "-image-transport; Debian 13: ros-" + transport +
         "-image-transport; Debian 12: build it in your workspace)";
}

/// Images of the topic `image_raw` by any transport of image_transport, or by "compressed". The latter is
/// decoded here, because its plugin decodes without a check of the size and is missing in some distributions.
class ImageSource {
 public:
  using Callback = std::function<void(const std_msgs::Header&, const DecodedImage&)>;

  /// \throws InputError that lists the transports if this one does not exist
  ImageSource(ros::NodeHandle& nh, Diagnostics& diagnostics, const std::string& transport,
              const ImageLimits& limits, const StampLimits& stamps, const RateLimit& rate, Callback callback)
      : limits_(limits),
        rate_(rate),
        callback_(std::move(callback)),
        diagnostics_(diagnostics),
        input_(diagnostics, "image", stamps),
        transport_(nh) {
    if (transport == "compressed")
      subscribeCompressed(nh);
    else
      subscribePlugin(transport);
  }

  bool isConnected() const { return input_.isConnected(); }

 private:
  void subscribeCompressed(ros::NodeHandle& nh) {
    input_.watch(diagnostics_.subscribe(nh, nh.resolveName("image_raw") + "/compressed", 1,
                                        &ImageSource::receiveCompressed, this));
  }

  void subscribePlugin(const std::string& transport) {
    const boost::function<void(const sensor_msgs::ImageConstPtr&)> callback =
        [this](const sensor_msgs::ImageConstPtr& message) {
          diagnostics_.handle("image",
                              [&] { receive(message->header, [&] { return decode(message, limits_); }); });
        };
    try {
      const image_transport::TransportHints hints(transport, ros::TransportHints().tcpNoDelay());
      input_.watch(transport_.subscribe("image_raw", 1, callback, ros::VoidPtr(), hints));
    } catch (const image_transport::Exception& error) {
      const std::string why = whyNoTransport(transport);
      throw InputError(why.empty() ? error.what() : why);
    }
  }

  void receiveCompressed(const sensor_msgs::CompressedImageConstPtr& message) {
    receive(message->header, [&] { return decode(*message, limits_); });
  }

  void receive(const std_msgs::Header& header, const std::function<DecodedImage()>& decode) {
    if (!input_.admits(header.stamp) || !rate_.admits(header.stamp.toSec())) return;
    const double begun_sec = steadyNowSec();
    DecodedImage decoded = decode();
    decoded.decode_ms = 1e3 * (steadyNowSec() - begun_sec);
    if (!decoded.reason.empty()) return input_.refused(decoded.reason);
    if (camera_.isStuck(decoded.image, steadyNowSec()))
      decoded.warning = "the image does not change any more: is the camera stuck?";
    input_.accepted(decoded.warning);
    input_.stamped(header.stamp.toSec());
    callback_(header, decoded);
  }

  ImageLimits limits_;
  RateLimit rate_;
  StuckCamera camera_;
  Callback callback_;
  Diagnostics& diagnostics_;
  TopicInput input_;
  image_transport::ImageTransport transport_;
};

}  // namespace window_ingress::adapters
