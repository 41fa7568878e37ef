#include "adapters/images/image_compressor.hpp"

#include <gtest/gtest.h>

#include <boost/make_shared.hpp>
#include <opencv2/core.hpp>

namespace window_ingress::adapters::image_compressor_test {

boost::shared_ptr<sensor_msgs::Image> gradient(const std::string& encoding, int channels) {
  auto image = boost::make_shared<sensor_msgs::Image>();
  image->header.stamp = ros::Time(7.25);
  image->header.frame_id = "eye";
  image->width = 64;
  image->height = 48;
  image->step = 64 * static_cast<unsigned>(channels);
  image->encoding = encoding;
  for (unsigned y = 0; y < 48; ++y)
    for (unsigned x = 0; x < image->step; ++x)
      image->data.push_back(static_cast<unsigned char>(2 * y + x / 3));
  return image;
}

TEST(Compress, ComesBackAsTheSameImageUnderTheSameHeader) {
  for (const auto& [encoding, channels] : {std::pair{"bgr8", 3}, {"mono8", 1}, {"rgb8", 3}}) {
    const auto image = gradient(encoding, channels);
    const auto compressed = compress(image, {});
    ASSERT_TRUE(compressed) << compressed.reason;
    EXPECT_EQ(compressed.value->header.stamp, ros::Time(7.25));
    EXPECT_EQ(compressed.value->header.frame_id, "eye");
    const DecodedImage before = decode(image, {}), after = decode(*compressed.value, {});
    ASSERT_TRUE(after.reason.empty()) << after.reason;
    ASSERT_EQ(after.image.type(), before.image.type()) << encoding;
    EXPECT_LT(cv::norm(before.image, after.image, cv::NORM_L1) / static_cast<double>(image->data.size()),
              3.0);
  }
}

TEST(Compress, LessQualityIsSmaller) {
  ImageCompressorParams rough;
  rough.quality = 10;
  const auto image = gradient("bgr8", 3);
  EXPECT_LT(compress(image, rough).value->data.size(), compress(image, {}).value->data.size());
}

TEST(Compress, WhatIsNoImageIsRefusedWithAReason) {
  auto image = gradient("bgr8", 3);
  image->data.resize(100);
  EXPECT_FALSE(compress(image, {}).reason.empty());
  image = gradient("32FC1", 4);
  const auto compressed = compress(image, {});
  EXPECT_FALSE(compressed);
  EXPECT_NE(compressed.reason.find("32FC1"), std::string::npos) << compressed.reason;
}

}  // namespace window_ingress::adapters::image_compressor_test
