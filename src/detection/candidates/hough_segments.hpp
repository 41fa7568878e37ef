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
  double contrast = 0.0;   ///< mean gradient [grey levels a pixel]

  double length() const { return (b - a).norm(); }
};

/// Hough transform (P4) that selects straight segments: votes, minimum length, maximum gap. Where the
/// probabilistic transform saves votes by drawing pixels at random, here each straight run of connected
/// pixels votes once, with the weight of its pixels, for the lines that its gradient direction allows: some
/// hundred voters in place of ten thousand, and the same result each time. A line takes the runs that voted
/// for it, from its longest outwards, up to the first gap that is too wide. The edge map itself is not
/// redrawn.
class HoughSegments {
 public:
  explicit HoughSegments(const HoughSegmentsParams& params) : params_(params) {}

  /// Strongest first, by length and the root of the contrast; at most 300. Deterministic. Valid
  /// until the next call.
  const std::vector<Segment>& run(const std::vector<EdgeChain>& runs, const cv::Size& level);

  /// 1 for each run of the last call that lies on a segment.
  const std::vector<std::uint8_t>& onSegment() const { return used_; }

 private:
  static constexpr int kAngles = 128;  ///< of the full circle: polarity tells the two edges of a bar apart
  static constexpr double kRhoStepPx = 3.0;

  struct Ballot {
    int first_angle = 0, last_angle = 0;  ///< angles it votes for, modulo kAngles
  };
  struct Member {
    double from = 0.0, to = 0.0;  ///< along the line that may take it
    int run = 0;
  };

  void prepare(const cv::Size& level);
  void vote(const std::vector<EdgeChain>& runs);
  void countVotes(const std::vector<EdgeChain>& runs);
  int cellOf(const Eigen::Vector2d& middle, int angle) const;
  void collect(const std::vector<EdgeChain>& runs, int seed);
  bool grow(const std::vector<EdgeChain>& runs, int seed, Segment& segment);
  void extend(const std::vector<EdgeChain>& runs, int way, LineMoments& moments, double& end);

  HoughSegmentsParams params_;
  Eigen::Vector2d centre_;
  int rhos_ = 0;
  double min_length_px_ = 0.0, max_gap_px_ = 0.0, off_line_px_ = 0.0;
  std::vector<Eigen::Vector2d> normals_;  ///< of the angles
  std::vector<Eigen::Vector2d> middles_;  ///< of the runs
  std::vector<Ballot> ballots_;           ///< one a run
  std::vector<float> votes_;              ///< of the cells [px]
  std::vector<int> cells_;                ///< of all votes, run by run
  std::vector<int> starts_, voters_;      ///< voters of cell c: from starts_[c] to starts_[c + 1]
  std::vector<std::pair<double, int>> order_;
  std::vector<std::uint8_t> used_;
  std::vector<int> asked_;  ///< the seed that asked a run last
  std::vector<Member> members_;
  std::vector<int> taken_;
  std::vector<Segment> segments_;
};

/// Of an edge map what lies on the segments that were found: Hough selects (P4), it does not draw.
/// \param runs and \param lines after their last call \param edges CV_8UC1, result, 0 or 255
void keepOnSegments(const EdgeChains& runs, const HoughSegments& lines, const cv::Size& level,
                    cv::Mat& edges);

}  // namespace window_ingress::detection
