/// What a replay leaves behind as csv: a row an image in each of three files.
#pragma once

#include <filesystem>
#include <string>

#include "adapters/bags/replay.hpp"
#include "evaluation/images/truth_comparison.hpp"
#include "evaluation/output_file.hpp"

namespace window_ingress::adapters {

/// frames.csv: detection, pose, filtered pose, and the errors where the truth is known. details.csv: what an
/// image came with, its angles and widths, and why it did not contribute. latency.csv: milliseconds. The
/// same bag gives the same bytes in the first two.
class ReplayTables {
 public:
  /// \throws std::runtime_error if a file cannot be made
  ReplayTables(const std::filesystem::path& folder, const ReplayParams& params);

  void add(const ReplayedFrame& frame);
  /// \throws std::runtime_error if not all could be written
  void close();

  const evaluation::TruthSummary& summary() const { return summary_; }

 private:
  std::string compare(const ReplayedFrame& frame);

  const ReplayParams& params_;
  bool has_truth_;
  evaluation::OutputFile frames_, details_, latency_;
  evaluation::TruthSummary summary_;
};

/// Seconds with all nine decimals, which a double has not.
std::string exactText(const ros::Time& stamp);

}  // namespace window_ingress::adapters
