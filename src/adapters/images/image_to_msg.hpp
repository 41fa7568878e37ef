#pragma once

#include <sensor_msgs/Image.h>

#include <opencv2/core.hpp>

namespace window_ingress::adapters {

/// An image as a message; the bytes are copied. \param image CV_8UC1 or CV_8UC3 (BGR)
sensor_msgs::ImagePtr toImageMsg(const cv::Mat& image, const std_msgs::Header& header);

}  // namespace window_ingress::adapters
