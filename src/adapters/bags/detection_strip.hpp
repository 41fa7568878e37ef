/// Some images of a replay with what the detector made of them, evenly over time, for a page to show.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>

#include "adapters/bags/replay.hpp"
#include "evaluation/output_file.hpp"

namespace window_ingress::adapters {

/// Writes pictures/NNNNN.jpg, at most `kMax` of them and one at each change between found and not found, and
/// strip.csv: stamp, file, why it is there, and what it shows.
class DetectionStrip {
 public:
  static constexpr int kMax = 36;         ///< evenly over time
  static constexpr int kMaxChanges = 24;  ///< beyond those

  /// \param images that will come
  /// \throws std::runtime_error if the folder cannot be made
  DetectionStrip(const std::filesystem::path& folder, std::size_t images);

  void add(const ReplayedFrame& frame);  ///< \throws std::runtime_error if an image cannot be written

 private:
  const char* whyShown(const ReplayedFrame& frame);

  std::filesystem::path folder_;
  evaluation::OutputFile list_;
  std::size_t step_;
  std::size_t seen_ = 0;
  int changes_ = 0;
  bool was_found_ = false;
  cv::Mat canvas_;
};

}  // namespace window_ingress::adapters
