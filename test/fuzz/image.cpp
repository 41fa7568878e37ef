#include "adapters/images/image_conversion.hpp"
#include "any_image.hpp"
#include "targets.hpp"

namespace window_ingress::fuzz {
namespace {

void check(const adapters::DecodedImage& decoded, const adapters::ImageLimits& limits) {
  require(decoded.image.empty() == !decoded.reason.empty(), "an image or a reason, not both or none");
  if (decoded.image.empty()) return;
  require(decoded.image.type() == CV_8UC1 || decoded.image.type() == CV_8UC3, "8 bits, grey or colour");
  require(decoded.image.total() <= static_cast<std::size_t>(limits.max_pixels), "no more than max_pixels");
  require(cv::sum(decoded.image)[0] >= 0.0, "all of its bytes can be read");
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
