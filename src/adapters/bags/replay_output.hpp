/// Output of a replay: three csv files with one row per image.
#pragma once

#include <rosbag/bag.h>

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>

#include "adapters/bags/replay.hpp"
#include "evaluation/images/truth_comparison.hpp"
#include "evaluation/output_file.hpp"

namespace window_ingress::adapters {

/// Number of messages of a topic in the bag.
std::size_t messagesIn(const rosbag::Bag& bag, const std::string& topic);

/// Writes folder/replay.json: command, bag, topics and their use, counts of images with and without
/// calibration, odometry and attitude, refused messages and reasons.
/// \throws std::runtime_error if it cannot be written
void writeFacts(const std::filesystem::path& folder, const std::string& command, const rosbag::Bag& bag,
                const ReplayParams& params, const ReplaySummary& summary);

/// The arguments as one line with shell quoting.
std::string commandLine(int argc, char** argv);

/// frames.csv: detection, pose, filtered pose, and errors where the truth is known. details.csv: inputs of
/// each image, angles and widths, and why it did not contribute. latency.csv: milliseconds. The first two
/// files are reproducible to the byte.
class ReplayTables {
 public:
  /// \throws std::runtime_error if a file cannot be made
  ReplayTables(const std::filesystem::path& folder, const ReplayParams& params);

  /// \throws std::runtime_error if a row cannot be written completely
  void add(const ReplayedFrame& frame);

  const evaluation::TruthSummary& summary() const { return summary_; }

 private:
  std::string compare(const ReplayedFrame& frame);

  const ReplayParams& params_;
  bool has_truth_;
  evaluation::OutputFile frames_, details_, latency_;
  evaluation::TruthSummary summary_;
};

/// Writes pictures/NNNNN.jpg, at most `kMax` evenly spaced ones plus one at each change between found and not
/// found, and strip.csv: stamp, file, reason and content.
class DetectionStrip {
 public:
  static constexpr int kMax = 36;         ///< pictures evenly spaced over time
  static constexpr int kMaxChanges = 24;  ///< additional pictures at changes

  /// \param images expected number of images
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
