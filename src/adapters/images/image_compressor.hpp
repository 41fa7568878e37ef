#pragma once

#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include "adapters/conversions/msg_conversion.hpp"
#include "adapters/images/image_conversion.hpp"

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

}  // namespace window_ingress::adapters
