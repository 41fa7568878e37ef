#include "adapters/images/image_files.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace window_ingress::adapters::image_files_test {

cv::Mat colours() {
  cv::Mat image(47, 65, CV_8UC3);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x)
      image.at<cv::Vec3b>(y, x) =
          cv::Vec3b(static_cast<uchar>(3 * x), static_cast<uchar>(4 * y), x * y % 7 ? 90 : 130);
  return image;
}

cv::Mat asOpenCvReads(const std::vector<std::uint8_t>& bytes) {
  return cv::imdecode(bytes, cv::IMREAD_ANYCOLOR | cv::IMREAD_IGNORE_ORIENTATION);
}

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.type() == b.type() && a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0.0;
}

TEST(ImageFiles, AreReadAsOpenCvReadsThem) {
  cv::Mat grey;
  cv::cvtColor(colours(), grey, cv::COLOR_BGR2GRAY);
  for (const cv::Mat& image : {colours(), grey})
    for (const char* format : {".jpg", ".png"}) {
      std::vector<std::uint8_t> bytes;
      cv::imencode(format, image, bytes);
      EXPECT_TRUE(same(readImage(bytes), asOpenCvReads(bytes))) << format << ", " << image.channels();
    }
}

TEST(ImageFiles, TransparencyAndSixteenBitsAreLeftOut) {
  cv::Mat transparent, wide;
  cv::cvtColor(colours(), transparent, cv::COLOR_BGR2BGRA);
  transparent.forEach<cv::Vec4b>([](cv::Vec4b& pixel, const int* at) { pixel[3] = at[1] % 2 ? 0 : 200; });
  colours().convertTo(wide, CV_16U, 257.0);
  for (const cv::Mat& image : {transparent, wide}) {
    std::vector<std::uint8_t> bytes;
    cv::imencode(".png", image, bytes);
    EXPECT_TRUE(same(readImage(bytes), colours())) << image.channels();
  }
}

/// The JPEG with an EXIF header that holds this orientation, little or big endian.
std::vector<std::uint8_t> held(std::vector<std::uint8_t> jpeg, std::uint8_t orientation, bool little) {
  std::vector<std::uint8_t> tiff = {'I', 'I', 42, 0, 8, 0,           0, 0, 1, 0, 0x12, 1, 3,
                                    0,   1,   0,  0, 0, orientation, 0, 0, 0, 0, 0,    0, 0};
  if (!little)
    tiff = {'M', 'M', 0, 42, 0, 0, 0, 8, 0, 1, 1, 0x12, 0, 3, 0, 0, 0, 1, 0, orientation, 0, 0, 0, 0, 0, 0};
  std::vector<std::uint8_t> exif = {0xff, 0xe1, 0, static_cast<std::uint8_t>(8 + tiff.size()), 'E', 'x', 'i',
                                    'f',  0,    0};
  exif.insert(exif.end(), tiff.begin(), tiff.end());
  jpeg.insert(jpeg.begin() + 2, exif.begin(), exif.end());
  return jpeg;
}

TEST(ImageFiles, PhotographsAreTurnedAsTheirCameraWasHeldIfAskedFor) {
  std::vector<std::uint8_t> jpeg;
  cv::imencode(".jpg", colours(), jpeg);
  for (std::uint8_t orientation = 0; orientation <= 9; ++orientation)
    for (const bool little : {true, false}) {
      const std::vector<std::uint8_t> bytes = held(jpeg, orientation, little);
      EXPECT_TRUE(same(readImage(bytes, true), cv::imdecode(bytes, cv::IMREAD_COLOR)))
          << int(orientation) << little;
      EXPECT_TRUE(same(readImage(bytes), readImage(jpeg)));
    }
}

TEST(ImageFiles, ACutOrFalseOrientationDoesNoHarm) {
  std::vector<std::uint8_t> jpeg;
  cv::imencode(".jpg", colours(), jpeg);
  const std::vector<std::uint8_t> good = held(jpeg, 6, true);
  for (std::size_t at = 4; at < 36; ++at)
    for (const std::uint8_t byte : {0x00, 0x7f, 0xff}) {
      std::vector<std::uint8_t> bytes = good;
      bytes[at] = byte;
      const cv::Mat image = readImage(bytes, true);
      EXPECT_TRUE(image.empty() || image.total() == colours().total()) << at;
    }
}

TEST(ImageFiles, JpegIsWrittenAsOpenCvWritesIt) {
  for (const int quality : {60, 95}) {
    std::vector<std::uint8_t> bytes;
    cv::imencode(".jpg", colours(), bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
    EXPECT_TRUE(same(readImage(writeJpeg(colours(), quality)), asOpenCvReads(bytes))) << quality;
  }
}

TEST(ImageFiles, WhatIsWrittenIsRead) {
  for (const char* name : {"a.png", "a.jpg", "a.jpeg"}) {
    const auto file = std::filesystem::path(::testing::TempDir()) / name;
    EXPECT_TRUE(writeImage(file.string(), colours()));
    std::ifstream input(file, std::ios::binary);
    EXPECT_LT(cv::norm(readImage({std::istreambuf_iterator<char>(input), {}}), colours(), cv::NORM_INF),
              100.0);
    std::filesystem::remove(file);
  }
  EXPECT_FALSE(writeImage("/proc/nowhere/a.jpg", colours()));
  EXPECT_FALSE(writeImage(::testing::TempDir() + "a.bmp", colours()));
}

TEST(ImageFiles, WhatIsNoImageIsEmpty) {
  for (const std::vector<std::uint8_t>& bytes :
       {std::vector<std::uint8_t>{}, {0xff}, {0xff, 0xd8}, {0xff, 0xd8, 0xff, 0xd9}, {0x89, 'P', 'N', 'G'}})
    EXPECT_TRUE(readImage(bytes).empty()) << bytes.size();
}

}  // namespace window_ingress::adapters::image_files_test
