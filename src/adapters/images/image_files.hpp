/// JPEG and PNG by libjpeg and libpng: OpenCV's own readers load GDAL and 110 more libraries, 39 MB per
/// process.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace window_ingress::adapters {

/// \param upright turns a photograph as viewers do, by the orientation that its camera has noted (EXIF)
/// \return CV_8UC1 for a grey image, else CV_8UC3 (BGR); empty if it is neither JPEG nor PNG, or damaged.
/// Ignores transparency.
cv::Mat readImage(const std::vector<std::uint8_t>& bytes, bool upright = false);

/// \param image CV_8UC1 or CV_8UC3 (BGR)
/// \param quality 1 to 100
/// \return empty if it cannot be written
std::vector<std::uint8_t> writeJpeg(const cv::Mat& image, int quality);

/// Writes a file in the format of its extension: .jpg, .jpeg or .png. \return whether it succeeded
bool writeImage(const std::string& file, const cv::Mat& image);

}  // namespace window_ingress::adapters
