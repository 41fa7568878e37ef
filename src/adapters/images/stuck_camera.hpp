#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>

namespace window_ingress::adapters {

/// Detects a stuck camera: its images stay the same to the bit under new stamps.
class StuckCamera {
 public:
  static constexpr double kStuckSec = 1.0;

  /// \return whether the image has been the same for longer than `kStuckSec`
  bool isStuck(const cv::Mat& image, double now_sec) {
    constexpr std::size_t kStride = 101;  // prime: samples every row and column, some 10,000 bytes
    std::uint64_t checksum = 1469598103934665603ULL;  // FNV-1a
    const std::size_t row_bytes = image.cols * image.elemSize();
    std::size_t offset = 0;
    for (int row = 0; row < image.rows; ++row) {
      const unsigned char* bytes = image.ptr(row);
      for (; offset < row_bytes; offset += kStride) checksum = (checksum ^ bytes[offset]) * 1099511628211ULL;
      offset -= row_bytes;
    }
    if (since_sec_ < 0.0 || checksum != checksum_) since_sec_ = now_sec;
    checksum_ = checksum;
    return now_sec - since_sec_ > kStuckSec;
  }

 private:
  std::uint64_t checksum_ = 0;
  double since_sec_ = -1.0;
};

}  // namespace window_ingress::adapters
