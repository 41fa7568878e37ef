#include "adapters/images/image_to_msg.hpp"

#include <boost/make_shared.hpp>
#include <cstring>

namespace window_ingress::adapters {

sensor_msgs::ImagePtr toImageMsg(const cv::Mat& image, const std_msgs::Header& header) {
  auto message = boost::make_shared<sensor_msgs::Image>();
  message->header = header;
  message->encoding = image.channels() == 1 ? "mono8" : "bgr8";
  message->width = static_cast<std::uint32_t>(image.cols);
  message->height = static_cast<std::uint32_t>(image.rows);
  message->step = static_cast<std::uint32_t>(image.cols * image.elemSize());
  message->data.resize(std::size_t{message->step} * message->height);
  for (int row = 0; row < image.rows; ++row)
    std::memcpy(message->data.data() + std::size_t{message->step} * row, image.ptr(row), message->step);
  return message;
}

}  // namespace window_ingress::adapters
