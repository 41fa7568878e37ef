/// Images from messages, checked before anything touches their bytes.
#pragma once

#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "window_ingress/configuration/common_params.hpp"

namespace window_ingress::adapters {

using configuration::ImageLimits;

struct CompressedSize {
  std::uint32_t width = 0;   ///< [px]
  std::uint32_t height = 0;  ///< [px]
};

/// Size of a JPEG or PNG as its header tells, without decoding; nothing for anything else.
std::optional<CompressedSize> compressedSize(const std::vector<std::uint8_t>& bytes);

/// An image as the detector takes it, or why there is none.
struct DecodedImage {
  cv::Mat image;  ///< CV_8UC1 or CV_8UC3 (BGR); empty if refused. Shares the message's bytes if it can.
  std::shared_ptr<const void> owner;  ///< keeps shared bytes alive
  std::string reason;                 ///< why it was refused; empty if it was not
  std::string warning;                ///< it was read, but look at this
  double decode_ms = 0.0;             ///< what it took to decode it [ms]
};

/// Why this message must not be decoded: empty, sizes that do not fit, unknown encoding, too large; empty if
/// it may. Encodings: mono8 8UC1 bgr8 8UC3 rgb8 bgra8 8UC4 rgba8, mono16 16UC1 bgr16 rgb16 bgra16 rgba16
/// (little endian; the upper eight bits are used), bayer_{rggb,bggr,gbrg,grbg}{8,16}, yuv422 (UYVY). Others
/// are refused by name.
std::string whyRefused(const sensor_msgs::Image& message, const ImageLimits& limits);

/// Checked and converted; never throws.
DecodedImage decode(const sensor_msgs::ImageConstPtr& message, const ImageLimits& limits);

/// JPEG or PNG: the size in the file's header is checked before anything is decoded. Never throws.
DecodedImage decode(const sensor_msgs::CompressedImage& message, const ImageLimits& limits);

/// The other way; the bytes are copied. \param image CV_8UC1 or CV_8UC3 (BGR)
sensor_msgs::ImagePtr toImageMsg(const cv::Mat& image, const std_msgs::Header& header);

}  // namespace window_ingress::adapters
