#include "any_image.hpp"

#include <array>
#include <boost/make_shared.hpp>

namespace window_ingress::fuzz {
namespace {

struct Encoding {
  const char* name;
  std::uint32_t bytes;
};
constexpr std::array<Encoding, 24> kEncodings{
    {{"mono8", 1},        {"8UC1", 1},         {"bgr8", 3},        {"8UC3", 3},         {"rgb8", 3},
     {"bgra8", 4},        {"8UC4", 4},         {"rgba8", 4},       {"mono16", 2},       {"16UC1", 2},
     {"bgr16", 6},        {"rgb16", 6},        {"bgra16", 8},      {"rgba16", 8},       {"bayer_rggb8", 1},
     {"bayer_bggr8", 1},  {"bayer_gbrg8", 1},  {"bayer_grbg8", 1}, {"bayer_rggb16", 2}, {"bayer_bggr16", 2},
     {"bayer_gbrg16", 2}, {"bayer_grbg16", 2}, {"yuv422", 2},      {"32FC1", 4}}};

}  // namespace

sensor_msgs::ImagePtr anyImage(Bytes& bytes) {
  auto image = boost::make_shared<sensor_msgs::Image>();
  const std::size_t known = bytes.below(2 * kEncodings.size());
  const Encoding encoding = kEncodings[known % kEncodings.size()];
  image->encoding = known < kEncodings.size() ? encoding.name : bytes.text(64);
  const std::uint8_t shape = bytes.take<std::uint8_t>();
  image->width = shape & 1 ? bytes.take<std::uint32_t>() : bytes.take<std::uint8_t>();
  image->height = shape & 2 ? bytes.take<std::uint32_t>() : bytes.take<std::uint8_t>();
  image->step = shape & 4 ? bytes.take<std::uint32_t>() : image->width * encoding.bytes + (shape & 24) / 8;
  image->is_bigendian = (shape & 32) != 0;
  image->data = bytes.rest();
  if (shape & 64) image->data.resize((std::size_t{image->step} * image->height) % (1u << 20));
  return image;
}

sensor_msgs::ImagePtr smallImage(Bytes& bytes) {
  auto image = boost::make_shared<sensor_msgs::Image>();
  const Encoding encoding = kEncodings[bytes.below(kEncodings.size())];
  image->encoding = encoding.name;
  image->width = 1 + bytes.below(96);
  image->height = 1 + bytes.below(96);
  image->step = image->width * encoding.bytes + 2 * (bytes.take<std::uint8_t>() % 4);
  image->data.resize(std::size_t{image->step} * image->height);
  const std::vector<std::uint8_t> pattern = bytes.rest();
  for (std::size_t i = 0; i < image->data.size() && !pattern.empty(); ++i)
    image->data[i] = pattern[i % pattern.size()];
  return image;
}

}  // namespace window_ingress::fuzz
