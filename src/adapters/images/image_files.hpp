/// JPEG and PNG by libjpeg and libpng: OpenCV's own readers load GDAL and 110 libraries more, 39 MB in each
/// process.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace window_ingress::adapters {

/// \return CV_8UC1 if the image is grey, else CV_8UC3 (BGR); empty if it is neither JPEG nor PNG, or damaged.
///         Transparency and the orientation that a camera noted are left out of account.
cv::Mat readImage(const std::vector<std::uint8_t>& bytes);

/// \param image CV_8UC1 or CV_8UC3 (BGR)
/// \param quality 1 to 100
/// \return empty if it cannot be written
std::vector<std::uint8_t> writeJpeg(const cv::Mat& image, int quality);

/// Writes a file of the format that its name ends with: .jpg, .jpeg or .png. \return whether it could
bool writeImage(const std::string& file, const cv::Mat& image);

}  // namespace window_ingress::adapters
