#include "adapters/images/image_from_msg.hpp"
#include "pictures.hpp"
#include "targets.hpp"

namespace window_ingress::fuzz {
namespace {

void check(const adapters::DecodedImage& picture, const adapters::ImageLimits& limits) {
  require(picture.image.empty() == !picture.reason.empty(), "a picture or a reason, not both or none");
  if (picture.image.empty()) return;
  require(picture.image.type() == CV_8UC1 || picture.image.type() == CV_8UC3, "8 bits, grey or colour");
  require(picture.image.total() <= static_cast<std::size_t>(limits.max_pixels), "no more than max_pixels");
  require(cv::sum(picture.image)[0] >= 0.0, "all of its bytes can be read");
}

}  // namespace

void image(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  adapters::ImageLimits limits;
  limits.max_pixels = 1 << 16;
  if (bytes.take<std::uint8_t>() % 4 > 0) return check(adapters::decode(anyImage(bytes), limits), limits);
  sensor_msgs::CompressedImage compressed;
  compressed.data = bytes.rest();
  check(adapters::decode(compressed, limits), limits);
}

}  // namespace window_ingress::fuzz
