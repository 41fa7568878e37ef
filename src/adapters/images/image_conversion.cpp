#include "adapters/images/image_conversion.hpp"

#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <array>
#include <boost/make_shared.hpp>
#include <cstddef>
#include <initializer_list>
#include <opencv2/imgproc.hpp>

#include "adapters/images/image_files.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::adapters {
namespace {

using Bytes = std::vector<std::uint8_t>;

std::uint32_t bigEndian(const Bytes& bytes, std::size_t at, int count) {
  std::uint32_t value = 0;
  for (int i = 0; i < count; ++i) value = value << 8 | bytes[at + i];
  return value;
}

// PNG: the IHDR chunk, always first, starts with width and height.
std::optional<CompressedSize> pngSize(const Bytes& bytes) {
  constexpr std::array<std::uint8_t, 8> kMagic{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  if (bytes.size() < 24 || !std::equal(kMagic.begin(), kMagic.end(), bytes.begin())) return std::nullopt;
  return CompressedSize{bigEndian(bytes, 16, 4), bigEndian(bytes, 20, 4)};
}

// Where the first segment "ff marker length .." of a JPEG begins whose marker is wanted, if there is one.
template <typename Wanted>
std::optional<std::size_t> findSegment(const Bytes& bytes, const Wanted& wanted) {
  std::size_t at = 2;
  while (at + 4 <= bytes.size() && bytes[at] == 0xff) {
    const std::uint8_t marker = bytes[at + 1];
    if (wanted(marker)) return at;
    at += marker == 0xff ? 1 : 2 + bigEndian(bytes, at + 2, 2);  // ff: a fill byte
  }
  return std::nullopt;
}

// Start of frame: C0 to CF, except the tables C4 (Huffman), C8 (reserved) and CC (arithmetic).
bool isStartOfFrame(std::uint8_t marker) {
  return marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
}

// JPEG: a start of frame holds length, precision, height, width.
std::optional<CompressedSize> jpegSize(const Bytes& bytes) {
  if (bytes.size() < 4 || bytes[0] != 0xff || bytes[1] != 0xd8) return std::nullopt;
  const auto frame = findSegment(bytes, isStartOfFrame);
  if (!frame || *frame + 9 > bytes.size()) return std::nullopt;
  return CompressedSize{bigEndian(bytes, *frame + 7, 2), bigEndian(bytes, *frame + 5, 2)};
}

bool holds(const Bytes& bytes, std::size_t from, std::initializer_list<std::uint8_t> mark) {
  const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(std::min(from, bytes.size()));
  return std::search(begin, bytes.end(), mark.begin(), mark.end()) != bytes.end();
}

// Whether a JPEG or PNG ends before its end mark: a decoder would fill the missing part with grey. Cameras
// append padding or data of their own. A JPEG's end is sought behind its first start of scan (ff da), because
// an embedded preview lies before it, in a segment of its own.
bool isCutOff(const Bytes& bytes) {
  if (pngSize(bytes)) return !holds(bytes, 0, {'I', 'E', 'N', 'D', 0xae, 0x42, 0x60, 0x82});
  const auto scan = findSegment(bytes, [](std::uint8_t marker) { return marker == 0xda; });
  return !scan || !holds(bytes, *scan, {0xff, 0xd9});
}

namespace enc = sensor_msgs::image_encodings;

constexpr int kAsItIs = -1;

struct Encoding {
  const char* name;
  int code = kAsItIs;          // conversion code of cv::cvtColor to BGR
  const char* read_as = name;  // the ROS encoding it is read as

  bool isSixteenBit() const { return enc::bitDepth(read_as) == 16; }
  int bytesPerPixel() const { return enc::numChannels(read_as) * enc::bitDepth(read_as) / 8; }
  int type() const { return CV_MAKETYPE(isSixteenBit() ? CV_16U : CV_8U, enc::numChannels(read_as)); }
};

// OpenCV names a Bayer pattern by its second row.
constexpr std::array<Encoding, 23> kEncodings{{{"mono8"},
                                               {"8UC1", kAsItIs, "mono8"},
                                               {"bgr8"},
                                               {"8UC3", kAsItIs, "bgr8"},
                                               {"rgb8", cv::COLOR_RGB2BGR},
                                               {"bgra8", cv::COLOR_BGRA2BGR},
                                               {"8UC4", cv::COLOR_BGRA2BGR, "bgra8"},
                                               {"rgba8", cv::COLOR_RGBA2BGR},
                                               {"mono16"},
                                               {"16UC1", kAsItIs, "mono16"},
                                               {"bgr16"},
                                               {"rgb16", cv::COLOR_RGB2BGR},
                                               {"bgra16", cv::COLOR_BGRA2BGR},
                                               {"rgba16", cv::COLOR_RGBA2BGR},
                                               {"bayer_rggb8", cv::COLOR_BayerBG2BGR},
                                               {"bayer_bggr8", cv::COLOR_BayerRG2BGR},
                                               {"bayer_gbrg8", cv::COLOR_BayerGR2BGR},
                                               {"bayer_grbg8", cv::COLOR_BayerGB2BGR},
                                               {"bayer_rggb16", cv::COLOR_BayerBG2BGR},
                                               {"bayer_bggr16", cv::COLOR_BayerRG2BGR},
                                               {"bayer_gbrg16", cv::COLOR_BayerGR2BGR},
                                               {"bayer_grbg16", cv::COLOR_BayerGB2BGR},
                                               {"yuv422", cv::COLOR_YUV2BGR_UYVY}}};

const Encoding* find(const std::string& name) {
  const auto found =
      std::find_if(kEncodings.begin(), kEncodings.end(), [&](const Encoding& e) { return name == e.name; });
  return found == kEncodings.end() ? nullptr : &*found;
}

std::string unknownEncoding(const std::string& name) {
  std::string text =
      "encoding '" + name.substr(0, 40) + "' is not supported; set the camera driver to one of";
  for (const Encoding& encoding : kEncodings) text += std::string(" ") + encoding.name;
  return text;
}

std::string tooLarge(std::uint32_t width, std::uint32_t height, const ImageLimits& limits) {
  if (width > 0 && height > 0 && height <= static_cast<std::uint64_t>(limits.max_pixels) / width) return "";
  return formatted("image of %ux%u pixels is empty or above max_pixels = %d", width, height,
                   limits.max_pixels);
}

std::string badLayout(const sensor_msgs::Image& message, const Encoding& encoding) {
  const std::uint64_t row =
      std::uint64_t{message.width} * static_cast<std::uint64_t>(encoding.bytesPerPixel());
  const std::uint64_t bytes = std::uint64_t{message.height} * message.step;
  if (message.step < row)
    return "step of " + std::to_string(message.step) + " bytes is below the " + std::to_string(row) +
           " of a row of " + std::to_string(message.width) + " " + encoding.name + " pixels";
  if (message.data.size() != bytes)
    return formatted("data holds %zu bytes, step * height is ", message.data.size()) + std::to_string(bytes);
  if (encoding.isSixteenBit() && message.step % 2 != 0) return "step of a 16-bit image is odd";
  if (encoding.isSixteenBit() && message.is_bigendian) return "big-endian 16-bit images are not supported";
  if (std::string(encoding.name) == "yuv422" && message.width % 2 != 0) return "yuv422 needs an even width";
  return "";
}

std::string unusedRange(const sensor_msgs::Image& message, const Encoding& encoding) {
  if (!encoding.isSixteenBit()) return "";
  std::uint16_t highest = 0;
  for (std::size_t i = 1; i < message.data.size(); i += 2)
    highest = std::max<std::uint16_t>(highest, message.data[i]);
  return highest < 16
             ? "16-bit image uses only its lower 12 bits: it reads as nearly black; scale it in the driver"
             : "";
}

DecodedImage refused(const std::string& reason) { return {{}, nullptr, reason, "", 0.0}; }

// Shares the message's bytes if no conversion is needed.
cv::Mat converted(const sensor_msgs::Image& message, const Encoding& encoding) {
  cv::Mat image(static_cast<int>(message.height), static_cast<int>(message.width), encoding.type(),
                const_cast<unsigned char*>(message.data.data()), message.step);
  if (encoding.code != kAsItIs) {
    cv::Mat colour;
    cv::cvtColor(image, colour, encoding.code);
    image = colour;
  }
  if (!encoding.isSixteenBit()) return image;
  cv::Mat narrow;
  image.convertTo(narrow, CV_8U, 255.0 / 65535.0);
  return narrow;
}

}  // namespace

std::optional<CompressedSize> compressedSize(const Bytes& bytes) {
  const auto png = pngSize(bytes);
  return png ? png : jpegSize(bytes);
}

std::string whyRefused(const sensor_msgs::Image& message, const ImageLimits& limits) {
  const Encoding* encoding = find(message.encoding);
  if (!encoding) return unknownEncoding(message.encoding);
  const std::string large = tooLarge(message.width, message.height, limits);
  return large.empty() ? badLayout(message, *encoding) : large;
}

DecodedImage decode(const sensor_msgs::ImageConstPtr& message, const ImageLimits& limits) {
  const std::string reason = whyRefused(*message, limits);
  if (!reason.empty()) return refused(reason);
  const Encoding& encoding = *find(message->encoding);
  try {
    DecodedImage result;
    result.image = converted(*message, encoding);
    result.owner = std::make_shared<sensor_msgs::ImageConstPtr>(message);
    result.warning = unusedRange(*message, encoding);
    return result;
  } catch (const std::exception& error) {
    return refused(std::string("cannot be converted: ") + error.what());
  }
}

DecodedImage decode(const sensor_msgs::CompressedImage& message, const ImageLimits& limits) {
  const auto size = compressedSize(message.data);
  if (!size) return refused("compressed image is neither JPEG nor PNG, or its header is broken");
  const std::string large = tooLarge(size->width, size->height, limits);
  if (!large.empty()) return refused(large);
  if (isCutOff(message.data)) return refused("compressed image is cut off: it has no end mark");
  try {
    DecodedImage result;
    result.image = readImage(message.data);
    if (result.image.empty()) return refused("compressed image cannot be decoded: truncated or damaged");
    return result;
  } catch (const std::exception& error) {
    return refused(std::string("compressed image cannot be decoded: ") + error.what());
  }
}

sensor_msgs::ImagePtr toImageMsg(const cv::Mat& image, const std_msgs::Header& header) {
  auto message = boost::make_shared<sensor_msgs::Image>();
  message->header = header;
  message->encoding = image.channels() == 1 ? enc::MONO8 : enc::BGR8;
  message->width = static_cast<std::uint32_t>(image.cols);
  message->height = static_cast<std::uint32_t>(image.rows);
  message->step = static_cast<std::uint32_t>(image.cols * image.elemSize());
  message->data.reserve(std::size_t{message->step} * message->height);
  for (int row = 0; row < image.rows; ++row)
    message->data.insert(message->data.end(), image.ptr(row), image.ptr(row) + message->step);
  return message;
}

}  // namespace window_ingress::adapters
