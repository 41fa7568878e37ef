/// M01 to M14: invalid images.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <boost/make_shared.hpp>

#include "adapters/images/image_conversion.hpp"

namespace window_ingress::adapters::image_faults_test {

const ImageLimits kLimits;

struct BadImage {
  std::string encoding;
  std::uint32_t width, height, step;
  std::size_t bytes;
  std::string word;  // which the reason must contain
};

sensor_msgs::ImagePtr made(const BadImage& bad) {
  auto image = boost::make_shared<sensor_msgs::Image>();
  image->encoding = bad.encoding;
  image->width = bad.width;
  image->height = bad.height;
  image->step = bad.step;
  image->data.resize(bad.bytes);
  return image;
}

void expectRefused(const std::vector<BadImage>& all, const ImageLimits& limits = kLimits) {
  std::string last;
  for (const BadImage& bad : all) {
    const DecodedImage result = decode(made(bad), limits);
    EXPECT_TRUE(result.image.empty()) << bad.encoding;
    EXPECT_NE(result.reason.find(bad.word), std::string::npos) << bad.word << " is not in: " << result.reason;
    last = result.reason;
  }
  testing::Test::RecordProperty("seen",
                                std::to_string(all.size()) + " refused, e.g.: " + last.substr(0, 120));
}

TEST(Fault, M01_DataThatDoesNotFitItsSize) {
  const std::size_t right = 64 * 48;
  expectRefused({{"mono8", 64, 48, 64, right - 1, "3071 bytes, step * height is 3072"},
                 {"mono8", 64, 48, 64, right + 1, "3073 bytes, step * height is 3072"},
                 {"mono8", 64, 48, 64, 0, "0 bytes"},
                 {"bgr8", 64, 48, 192, 3 * right - 1, "bytes"},
                 {"mono16", 64, 48, 128, 2 * right + 1, "bytes"}});
}

TEST(Fault, M02_SizesThatWrapIn32Bits) {
  ImageLimits most;
  most.max_pixels = 100000000;
  const std::vector<BadImage> wrapped{{"mono8", 65536, 65537, 65536, 65536, "max_pixels"},
                                      {"mono8", 65537, 65536, 65537, 65536, "max_pixels"},
                                      {"mono8", 256, 0x01000001, 256, 256, "max_pixels"},
                                      {"bgr8", 0x55555556, 1, 2, 2, "max_pixels"}};
  expectRefused(wrapped);
  expectRefused(wrapped, most);
  // Small enough for any limit on pixels, but the number of bytes wraps.
  expectRefused({{"mono8", 1, 65537, 65536, 65536, "bytes, step * height is 4295032832"},
                 {"rgba16", 0x20000001, 1, 8, 8, "max_pixels"}});
}

TEST(Fault, M04_StepsThatDoNotFit) {
  expectRefused({{"bgr8", 64, 48, 191, 191 * 48, "below the 192"},
                 {"mono8", 64, 48, 63, 63 * 48, "below the 64"},
                 {"rgba16", 64, 48, 511, 511 * 48, "below the 512"},
                 {"mono8", 64, 48, 0, 0, "below"},
                 {"mono16", 64, 48, 129, 129 * 48, "odd"},
                 {"bayer_rggb16", 64, 48, 131, 131 * 48, "odd"}});
}

TEST(Fault, M06_EncodingsThatAreNone) {
  std::vector<BadImage> all;
  for (const std::string& encoding :
       {std::string(), std::string("florp"), std::string("BGR8"), std::string(9216, 'x')})
    all.push_back({encoding, 64, 48, 192, 192 * 48, "driver to one of mono8 8UC1 bgr8"});
  expectRefused(all);
  EXPECT_LT(whyRefused(*made(all.back()), kLimits).size(), 600u) << "a long name is cut";
}

TEST(Fault, M07_TypesThatAreNone) {
  expectRefused({{"8UC0", 64, 48, 64, 64 * 48, "'8UC0' is not supported"},
                 {"8UC9999", 64, 48, 64, 64 * 48, "'8UC9999' is not supported"},
                 {"128UC1", 64, 48, 64, 64 * 48, "'128UC1' is not supported"}});
}

TEST(Fault, M08_TypesWithoutAColour) {
  const struct {
    const char *type, *like;
    std::uint32_t bytes;
  } mapped[] = {{"8UC1", "mono8", 1}, {"8UC3", "bgr8", 3}, {"8UC4", "bgra8", 4}, {"16UC1", "mono16", 2}};
  for (const auto& m : mapped) {
    const auto typed = made({m.type, 8, 6, 8 * m.bytes, 48 * m.bytes, ""}),
               named = made({m.like, 8, 6, 8 * m.bytes, 48 * m.bytes, ""});
    for (std::size_t i = 0; i < typed->data.size(); ++i) typed->data[i] = named->data[i] = 5 * i;
    const DecodedImage a = decode(typed, kLimits), b = decode(named, kLimits);
    ASSERT_FALSE(a.image.empty()) << m.type << ": " << a.reason;
    EXPECT_EQ(cv::norm(a.image, b.image, cv::NORM_INF), 0.0) << m.type << " is read as " << m.like;
  }
  expectRefused({{"32FC1", 64, 48, 256, 256 * 48, "'32FC1' is not supported"}});
}

TEST(Fault, M09_SixteenBits) {
  const auto image = made({"mono16", 8, 6, 16, 96, ""});
  for (std::size_t i = 0; i < 48; ++i) image->data[2 * i + 1] = static_cast<std::uint8_t>(5 * i);
  const DecodedImage full = decode(image, kLimits);
  ASSERT_EQ(full.image.type(), CV_8UC1) << full.reason;
  for (int i = 0; i < 48; ++i) EXPECT_NEAR(full.image.data[i], 5 * i, 1.0);
  EXPECT_EQ(full.warning, "");
  for (std::size_t i = 0; i < 48; ++i) image->data[2 * i + 1] = static_cast<std::uint8_t>(i % 16);  // 12 bits
  const DecodedImage dark = decode(image, kLimits);
  EXPECT_FALSE(dark.image.empty());
  EXPECT_NE(dark.warning.find("lower 12 bits"), std::string::npos) << dark.warning;
  RecordProperty("seen", "scaled by 1/257; " + dark.warning);
}

TEST(Fault, M10_BigEndian) {
  std::string reason;
  for (const std::string encoding : {"mono16", "16UC1", "rgb16", "bayer_rggb16"}) {
    const auto image = made({encoding, 64, 48, 512, 512 * 48, ""});
    image->is_bigendian = 1;
    const DecodedImage result = decode(image, kLimits);
    EXPECT_TRUE(result.image.empty());
    EXPECT_NE(result.reason.find("big-endian"), std::string::npos) << encoding << ": " << result.reason;
    reason = result.reason;
  }
  const auto bytes = made({"mono8", 64, 48, 64, 64 * 48, ""});
  bytes->is_bigendian = 1;
  EXPECT_FALSE(decode(bytes, kLimits).image.empty()) << "of bytes there is no order";
  RecordProperty("seen", reason);
}

TEST(Fault, M12_EncodingsOfDrivers) {
  expectRefused({{"yuv422_yuy2", 64, 48, 128, 128 * 48, "set the camera driver to one of"},
                 {"nv12", 64, 48, 64, 64 * 72, "set the camera driver to one of"}});
}

long residentKb() {
  struct rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

TEST(Fault, M14_FramesTooLarge) {
  const auto large = made({"mono8", 8000, 6000, 8000, 48000000, ""});
  const auto giant = made({"bgr8", 20000, 10000, 60000, 600000000, ""});
  const long before_kb = residentKb();
  for (int i = 0; i < 20; ++i)
    for (const auto& image : {large, giant}) {
      const DecodedImage result = decode(image, kLimits);
      ASSERT_TRUE(result.image.empty());
      ASSERT_NE(result.reason.find("max_pixels = 8000000"), std::string::npos) << result.reason;
    }
  EXPECT_LT(residentKb() - before_kb, 1000) << "refused before anything is allocated";
  RecordProperty("seen",
                 "48 and 200 Mpx refused, memory + " + std::to_string(residentKb() - before_kb) + " KB");
}

}  // namespace window_ingress::adapters::image_faults_test
