#include "adapters/images/image_conversion.hpp"

#include <gtest/gtest.h>

#include <boost/make_shared.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>

namespace window_ingress::adapters::image_conversion_test {

const ImageLimits kLimits;

sensor_msgs::ImagePtr makeImage(const std::string& encoding, std::uint32_t width, std::uint32_t height,
                                std::uint32_t step, std::size_t bytes) {
  auto image = boost::make_shared<sensor_msgs::Image>();
  image->encoding = encoding;
  image->width = width;
  image->height = height;
  image->step = step;
  image->data.resize(bytes);
  return image;
}

// A colour ramp as BGR. Every encoding of it must convert to the same image.
cv::Mat ramp() {
  cv::Mat image(48, 64, CV_8UC3);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x)
      image.at<cv::Vec3b>(y, x) = cv::Vec3b(static_cast<uchar>(3 * x), static_cast<uchar>(4 * y), 90);
  return image;
}

sensor_msgs::ImagePtr fromMat(const cv::Mat& mat, const std::string& encoding) {
  const auto step = static_cast<std::uint32_t>(mat.cols * mat.elemSize());
  auto image = makeImage(encoding, static_cast<std::uint32_t>(mat.cols), static_cast<std::uint32_t>(mat.rows),
                         step, std::size_t{step} * static_cast<std::size_t>(mat.rows));
  for (int row = 0; row < mat.rows; ++row)
    std::copy(mat.ptr(row), mat.ptr(row) + step,
              image->data.begin() + static_cast<std::ptrdiff_t>(row) * step);
  return image;
}

double difference(const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_INF); }

TEST(ImageFromMsg, RefusesSizesThatOverflow32Bits) {
  const auto wrapped = makeImage("mono8", 65536, 65537, 65536, 65536);
  EXPECT_FALSE(whyRefused(*wrapped, kLimits).empty());
  const auto tall = makeImage("mono8", 256, 0x01000001, 256, 256);
  EXPECT_FALSE(whyRefused(*tall, kLimits).empty());
  const auto wide = makeImage("bgr8", 0x55555556, 1, 2, 2);
  EXPECT_FALSE(whyRefused(*wide, kLimits).empty());
  EXPECT_TRUE(decode(wrapped, {100000000}).image.empty());
}

TEST(ImageFromMsg, RefusesEmptyAndHuge) {
  for (const auto& [width, height] : {std::pair{0u, 0u}, {0u, 48u}, {64u, 0u}, {8000u, 6000u}})
    EXPECT_NE(whyRefused(*makeImage("mono8", width, height, width, std::size_t{width} * height), kLimits)
                  .find("max_pixels"),
              std::string::npos)
        << width << "x" << height;
}

TEST(ImageFromMsg, RefusesDataThatDoesNotFit) {
  for (const std::size_t bytes : {0u, 64u * 48u - 1u, 64u * 48u + 1u})
    EXPECT_NE(whyRefused(*makeImage("mono8", 64, 48, 64, bytes), kLimits).find("bytes"), std::string::npos)
        << bytes;
  EXPECT_NE(whyRefused(*makeImage("bgr8", 64, 48, 64, 64 * 48), kLimits).find("step"), std::string::npos);
  EXPECT_NE(whyRefused(*makeImage("mono16", 64, 48, 129, 129 * 48), kLimits).find("odd"), std::string::npos);
}

TEST(ImageFromMsg, RefusesEncodingsByName) {
  for (const std::string encoding :
       {"", "florp", "BGR8", "8UC0", "8UC9999", "128UC1", "32FC1", "yuv422_yuy2", "nv12"}) {
    const std::string reason = whyRefused(*makeImage(encoding, 64, 48, 1024, 1024 * 48), kLimits);
    EXPECT_NE(reason.find("mono8"), std::string::npos) << "must list what is supported: " << reason;
  }
  EXPECT_LT(whyRefused(*makeImage(std::string(9000, 'x'), 64, 48, 64, 64 * 48), kLimits).size(), 600u);
}

TEST(ImageFromMsg, RefusesBigEndian16Bit) {
  auto image = makeImage("mono16", 64, 48, 128, 128 * 48);
  EXPECT_TRUE(whyRefused(*image, kLimits).empty());
  image->is_bigendian = 1;
  EXPECT_NE(whyRefused(*image, kLimits).find("endian"), std::string::npos);
}

TEST(ImageFromMsg, ReadsEveryColourEncodingAlike) {
  const cv::Mat bgr = ramp();
  const std::pair<const char*, int> converted[] = {{"rgb8", cv::COLOR_BGR2RGB},
                                                   {"bgra8", cv::COLOR_BGR2BGRA},
                                                   {"rgba8", cv::COLOR_BGR2RGBA},
                                                   {"8UC4", cv::COLOR_BGR2BGRA}};
  for (const auto& [encoding, code] : converted) {
    cv::Mat other;
    cv::cvtColor(bgr, other, code);
    const DecodedImage result = decode(fromMat(other, encoding), kLimits);
    ASSERT_EQ(result.image.type(), CV_8UC3) << encoding << ": " << result.reason;
    EXPECT_EQ(difference(result.image, bgr), 0.0) << encoding;
  }
  for (const char* encoding : {"bgr8", "8UC3"})
    EXPECT_EQ(difference(decode(fromMat(bgr, encoding), kLimits).image, bgr), 0.0);
}

TEST(ImageFromMsg, ReadsGreyOf8And16Bits) {
  cv::Mat grey, wide;
  cv::cvtColor(ramp(), grey, cv::COLOR_BGR2GRAY);
  grey.convertTo(wide, CV_16UC1, 257.0);
  for (const char* encoding : {"mono8", "8UC1"})
    EXPECT_EQ(difference(decode(fromMat(grey, encoding), kLimits).image, grey), 0.0);
  for (const char* encoding : {"mono16", "16UC1"}) {
    const DecodedImage result = decode(fromMat(wide, encoding), kLimits);
    ASSERT_EQ(result.image.type(), CV_8UC1) << result.reason;
    EXPECT_LE(difference(result.image, grey), 1.0) << encoding;
    EXPECT_TRUE(result.warning.empty());
  }
}

TEST(ImageFromMsg, WarnsOf12BitsIn16) {
  const cv::Mat dark(48, 64, CV_16UC1, cv::Scalar(4095));
  EXPECT_NE(decode(fromMat(dark, "mono16"), kLimits).warning.find("12 bits"), std::string::npos);
}

TEST(ImageFromMsg, ReadsBayerYuvAnd16BitColour) {
  const std::pair<const char*, std::uint32_t> encodings[] = {
      {"bayer_rggb8", 1},  {"bayer_bggr8", 1}, {"bayer_gbrg8", 1}, {"bayer_grbg8", 1},
      {"bayer_rggb16", 2}, {"yuv422", 2},      {"bgr16", 6},       {"rgba16", 8}};
  for (const auto& [encoding, bytes] : encodings) {
    const auto image = makeImage(encoding, 64, 48, 64 * bytes, std::size_t{64} * bytes * 48);
    EXPECT_EQ(decode(image, kLimits).image.type(), CV_8UC3)
        << encoding << ": " << decode(image, kLimits).reason;
  }
}

TEST(ImageFromMsg, PaddedRowsReadLikeTightOnes) {
  const cv::Mat bgr = ramp();
  auto padded = makeImage("bgr8", 64, 48, 256, 256 * 48);
  for (int row = 0; row < 48; ++row)
    std::copy(bgr.ptr(row), bgr.ptr(row) + 192, padded->data.begin() + row * 256);
  EXPECT_EQ(difference(decode(padded, kLimits).image, bgr), 0.0);
}

TEST(ImageFromMsg, SharesBytesAndKeepsThemAlive) {
  DecodedImage result;
  const unsigned char* bytes = nullptr;
  {
    const auto message = fromMat(ramp(), "bgr8");
    bytes = message->data.data();
    result = decode(message, kLimits);
  }
  EXPECT_EQ(result.image.data, bytes) << "copied without need";
  EXPECT_EQ(difference(result.image, ramp()), 0.0);
}

TEST(ImageFromMsg, NothingRandomGetsThroughOrThrows) {
  std::mt19937 random(7);
  const char* encodings[] = {"mono8", "bgr8", "mono16", "yuv422", "bayer_rggb8", "8UC4", "", "rgb16"};
  for (int i = 0; i < 2000; ++i) {
    const auto image =
        makeImage(encodings[random() % 8], random() % 40, random() % 40, random() % 300, random() % 4000);
    image->is_bigendian = random() % 2;
    const DecodedImage result = decode(image, kLimits);
    ASSERT_EQ(result.image.empty(), !result.reason.empty());
    if (!result.image.empty()) {
      ASSERT_EQ(result.image.cols, static_cast<int>(image->width));
    }
  }
}

sensor_msgs::CompressedImage compressed(const std::string& extension) {
  sensor_msgs::CompressedImage message;
  cv::imencode(extension, ramp(), message.data);
  return message;
}

TEST(CompressedImage, ReadsJpegAndPng) {
  EXPECT_EQ(difference(decode(compressed(".png"), kLimits).image, ramp()), 0.0);
  EXPECT_LT(difference(decode(compressed(".jpg"), kLimits).image, ramp()), 40.0);
}

TEST(CompressedImage, SizeIsReadFromTheHeader) {
  for (const char* extension : {".png", ".jpg"}) {
    const auto size = compressedSize(compressed(extension).data);
    ASSERT_TRUE(size) << extension;
    EXPECT_EQ(size->width, 64u);
    EXPECT_EQ(size->height, 48u);
  }
}

TEST(CompressedImage, RefusesABombBeforeDecodingIt) {
  auto message = compressed(".png");
  message.data[16] = 0x7f;  // width 2^31 in the header
  EXPECT_NE(decode(message, kLimits).reason.find("max_pixels"), std::string::npos);
}

TEST(CompressedImage, RefusesWhatIsCutOffButNotWhatIsPadded) {
  for (const char* extension : {".jpg", ".png"}) {
    const sensor_msgs::CompressedImage whole = compressed(extension);
    sensor_msgs::CompressedImage cut = whole, padded = whole, followed = whole;
    cut.data.resize(whole.data.size() * 9 / 10);
    padded.data.resize(whole.data.size() + 100, 0);
    followed.data.insert(followed.data.end(), 100, 0x5a);  // data of the camera's own
    EXPECT_NE(decode(cut, kLimits).reason.find("cut off"), std::string::npos) << extension;
    EXPECT_EQ(decode(padded, kLimits).reason, "") << extension;
    EXPECT_EQ(decode(followed, kLimits).reason, "") << extension;
  }
}

TEST(CompressedImage, SurvivesTruncationAndFlippedBytes) {
  std::mt19937 random(3);
  for (const char* extension : {".png", ".jpg"}) {
    for (int i = 0; i < 300; ++i) {
      auto message = compressed(extension);
      if (i % 2 == 0) message.data.resize(random() % message.data.size());
      for (int flips = 0; flips < 3 && !message.data.empty(); ++flips)
        message.data[random() % message.data.size()] ^= static_cast<unsigned char>(1 + random() % 255);
      const DecodedImage result = decode(message, kLimits);
      EXPECT_EQ(result.image.empty(), !result.reason.empty());
    }
  }
  EXPECT_FALSE(decode(sensor_msgs::CompressedImage(), kLimits).reason.empty());
}

}  // namespace window_ingress::adapters::image_conversion_test
