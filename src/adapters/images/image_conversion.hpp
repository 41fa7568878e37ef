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

#include "window_ingress/configuration/detector_node_params.hpp"

namespace window_ingress::adapters {

using configuration::ImageLimits;

struct CompressedSize {
  std::uint32_t width = 0;   ///< [px]
  std::uint32_t height = 0;  ///< [px]
};

/// Size of a JPEG or PNG from its header, without decoding; empty for other formats.
std::optional<CompressedSize> compressedSize(const std::vector<std::uint8_t>& bytes);

/// A decoded image for the detector, or the reason why not.
struct DecodedImage {
  cv::Mat image;  ///< CV_8UC1 or CV_8UC3 (BGR); empty if refused. Shares the message's bytes if it can.
  std::shared_ptr<const void> owner;  ///< keeps shared bytes alive
  std::string reason;                 ///< why the image was refused; empty if it was not
  std::string warning;                ///< problem of an image that was read all the same
  double decode_ms = 0.0;             ///< decoding time [ms]
};

/// Why this message must not be decoded: no data, inconsistent sizes, unknown encoding, too large. Empty if
/// it may. Encodings: mono8 8UC1 bgr8 8UC3 rgb8 bgra8 8UC4 rgba8, mono16 16UC1 bgr16 rgb16 bgra16 rgba16
/// (little endian; the upper eight bits are used), bayer_{rggb,bggr,gbrg,grbg}{8,16}, yuv422 (UYVY). Others
/// are refused by name.
std::string whyRefused(const sensor_msgs::Image& message, const ImageLimits& limits);

/// Checks and converts; never throws.
DecodedImage decode(const sensor_msgs::ImageConstPtr& message, const ImageLimits& limits);

/// JPEG or PNG. Checks the size in the file's header before decoding. Never throws.
DecodedImage decode(const sensor_msgs::CompressedImage& message, const ImageLimits& limits);

/// Image to message; copies the bytes. \param image CV_8UC1 or CV_8UC3 (BGR)
sensor_msgs::ImagePtr toImageMsg(const cv::Mat& image, const std_msgs::Header& header);

}  // namespace window_ingress::adapters
