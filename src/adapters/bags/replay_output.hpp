/// What a replay leaves behind as csv: a row an image in each of three files.
#pragma once

#include <rosbag/bag.h>

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>

#include "adapters/bags/replay.hpp"
#include "evaluation/images/truth_comparison.hpp"
#include "evaluation/output_file.hpp"

namespace window_ingress::adapters {

/// How many messages of a topic lie in the bag.
std::size_t messagesIn(const rosbag::Bag& bag, const std::string& topic);

/// Writes folder/replay.json: the command, the bag with its topics and which of them were used, images with
/// and without calibration, odometry and attitude, messages refused and why.
/// \throws std::runtime_error if it cannot be written
void writeFacts(const std::filesystem::path& folder, const std::string& command, const rosbag::Bag& bag,
                const ReplayParams& params, const ReplaySummary& summary);

/// The arguments as one line that a shell takes apart again.
std::string commandLine(int argc, char** argv);

/// frames.csv: detection, pose, filtered pose, and the errors where the truth is known. details.csv: what an
/// image came with, its angles and widths, and why it did not contribute. latency.csv: milliseconds. The
/// same bag gives the same bytes in the first two.
class ReplayTables {
 public:
  /// \throws std::runtime_error if a file cannot be made
  ReplayTables(const std::filesystem::path& folder, const ReplayParams& params);

  /// \throws std::runtime_error if not all could be written
  void add(const ReplayedFrame& frame);

  const evaluation::TruthSummary& summary() const { return summary_; }

 private:
  std::string compare(const ReplayedFrame& frame);

  const ReplayParams& params_;
  bool has_truth_;
  evaluation::OutputFile frames_, details_, latency_;
  evaluation::TruthSummary summary_;
};

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
