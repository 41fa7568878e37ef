/// Image messages from arbitrary bytes.
#pragma once

#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include "bytes.hpp"

namespace window_ingress::fuzz {

/// Sizes, step, encoding and number of bytes, which may contradict each other.
sensor_msgs::ImagePtr anyImage(Bytes& bytes);

/// An image of at most 96 x 96 pixels with a valid layout. The bytes are its pattern, repeated.
sensor_msgs::ImagePtr smallImage(Bytes& bytes);

}  // namespace window_ingress::fuzz
