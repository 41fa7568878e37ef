#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "detection/candidates/edge_chains.hpp"
#include "window_ingress/detection/detector_params.hpp"

namespace window_ingress::detection {

/// A straight piece of a border, in pixels of the undistorted search level.
struct Segment {
  Eigen::Vector2d a, b;    ///< ends; seen from a to b the brighter side lies on the right of the screen
  Eigen::Vector2d normal;  ///< unit vector towards the brighter side
  double pixels = 0.0;     ///< edge pixels on it
  double contrast = 0.0;   ///< mean gradient [grey levels per pixel]

  double length() const { return (b - a).norm(); }
};

/// Hough transform (P4) that selects straight segments by votes, minimum length and maximum gap. The
/// probabilistic transform saves votes by drawing random pixels. Here each straight run of connected pixels
/// votes once, weighted by its pixels, for the lines that its gradient direction allows: some hundred voters
/// in place of ten thousand, and a repeatable result. A line takes the runs that voted for it, from its
/// longest outwards, up to the first gap that is too wide. The edge map itself is not redrawn.
class HoughSegments {
 public:
  explicit HoughSegments(const HoughSegmentsParams& params) : params_(params) {}

  /// Strongest first, by length and the root of the contrast; at most 300. Deterministic. Valid
  /// until the next call.
  const std::vector<Segment>& run(const std::vector<EdgeChain>& runs, const cv::Size& level);

  /// 1 for each run of the last call that lies on a segment.
  const std::vector<std::uint8_t>& onSegment() const { return used_; }

 private:
  static constexpr int kAngles = 128;  ///< of the full circle: polarity distinguishes the two edges of a bar
  static constexpr double kRhoStepPx = 3.0;

  struct Ballot {
    Eigen::Vector2d middle;               ///< of a run
    int first_angle = 0, last_angle = 0;  ///< of its votes, modulo kAngles
  };
  struct Member {
    double from = 0.0, to = 0.0;  ///< position along the candidate line
    int run = 0;
  };

  void prepare(const cv::Size& level);
  void vote(const std::vector<EdgeChain>& runs);
  int cellOf(const Eigen::Vector2d& point, int angle) const;
  void collect(const std::vector<EdgeChain>& runs, int seed);
  bool grow(const std::vector<EdgeChain>& runs, int seed, Segment& segment);
  void extend(const std::vector<EdgeChain>& runs, int way, LineMoments& moments, double& end);

  HoughSegmentsParams params_;
  Eigen::Vector2d centre_;
  int rhos_ = 0;
  double min_length_px_ = 0.0, max_gap_px_ = 0.0, off_line_px_ = 0.0;
  std::vector<Eigen::Vector2d> normals_;  ///< of the angles
  std::vector<Ballot> ballots_;           ///< one per run
  std::vector<float> votes_;              ///< of the cells [px]
  std::vector<int> cells_;                ///< of all votes, run by run
  std::vector<int> starts_, voters_;      ///< voters of cell c: from starts_[c] to starts_[c + 1]
  std::vector<std::uint8_t> used_;
  std::vector<int> asked_;  ///< seed that last considered each run
  std::vector<Member> members_;
  std::vector<int> taken_;
  std::vector<Segment> segments_;
};

/// Keeps the part of an edge map that lies on the segments found: Hough selects (P4), it does not draw.
/// \param runs and \param lines after their last call \param edges an earlier result, whose memory is reused
/// \return CV_8UC1, 0 or 255
cv::Mat edgesOnSegments(const EdgeChains& runs, const HoughSegments& lines, const cv::Size& level,
                        cv::Mat edges = {});

}  // namespace window_ingress::detection
