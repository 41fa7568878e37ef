#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "window_ingress/detection/direction_bins.hpp"
#include "window_ingress/detection/edge_map.hpp"

namespace window_ingress::detection {

struct LineSupportParams {
  double min_length = 0.03;    ///< of a segment, in longer sides of the level
  double max_gap = 0.02;       ///< within a segment, in longer sides of the level
  double vote_fraction = 0.7;  ///< votes that start a segment, in pixels of the minimum length
  double spread_rad = 0.10;    ///< a pixel votes for lines this far from its gradient direction [rad]
  double direction_rad =
      0.45;                   ///< a pixel belongs to a line if its gradient is this close to the normal [rad]
  double min_density = 0.55;  ///< edge pixels on a segment over its length
  double join_gap =
      0.35;  ///< two pieces of one line are joined over a gap this long, in lengths of the pieces
  int max_segments = 600;  ///< the longest are kept

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("min_length", self.min_length, 0.005, 0.5);
    field("max_gap", self.max_gap, 0.0, 0.5);
    field("vote_fraction", self.vote_fraction, 0.1, 1.0);
    field("spread_rad", self.spread_rad, 0.0, 0.5);
    field("direction_rad", self.direction_rad, 0.05, 1.5);
    field("min_density", self.min_density, 0.0, 1.0);
    field("join_gap", self.join_gap, 0.0, 5.0);
    field("max_segments", self.max_segments, 4, 100000);
  }
};

/// A straight run of edge pixels, in pixels of the search level.
struct Segment {
  Eigen::Vector2d a, b;    ///< ends; seen from a to b the brighter side lies on the right of the screen
  Eigen::Vector2d normal;  ///< unit vector towards the brighter side
  int pixels = 0;          ///< edge pixels on it

  double length() const { return (b - a).norm(); }
};

/// Adds the segments that two pieces of one line make together; the pieces stay.
void joinCollinear(std::vector<Segment>& segments, double max_gap);

/// Probabilistic Hough transform (P4) that selects straight segments. Each edge pixel votes only for lines
/// near its own gradient direction, with its polarity, so that the two edges of a thin bar stay apart and the
/// vote costs a thirtieth of the full one. The edge map itself is not redrawn.
class LineSupport {
 public:
  explicit LineSupport(const LineSupportParams& params);

  /// Longest first; at most `max_segments`. Deterministic.
  std::vector<Segment> run(const EdgeMap& map);

 private:
  struct Pixel {
    std::int16_t x, y;
    std::int16_t angle;  ///< bin of the gradient direction
    std::int8_t state;   ///< 0 waiting, 1 voted, 2 used
  };
  struct Line {
    Eigen::Vector2d point, normal;
  };

  void prepare(const EdgeMap& map);
  void collect(const EdgeMap& map);
  void markSurroundings();
  void shuffle();
  int cellOf(const Pixel& pixel, int angle) const;
  int vote(const Pixel& pixel);
  void unvote(const Pixel& pixel);
  void take();
  void walk(const Line& line, const Eigen::Vector2d& start);
  void walkOneWay(const Line& line, std::uint32_t sectors, const Eigen::Vector2d& start, double way);
  int pixelNear(const Line& line, const Eigen::Vector2d& at) const;
  int pixelAt(const Line& line, const Eigen::Vector2d& at) const;
  bool mayHold(std::uint32_t sectors, const Eigen::Vector2d& at) const;
  std::uint32_t sectorsOf(const Line& line) const;
  void fit(Line& line) const;
  bool grow(const Pixel& seed, int cell, Segment& segment);

  static constexpr int kAngles = DirectionBins::kCount, kSectors = 32;

  LineSupportParams params_;
  DirectionBins bins_;
  double min_cosine_;
  int spread_;
  std::vector<Pixel> pixels_;
  std::vector<int> order_;
  cv::Mat index_;  ///< CV_32SC1: pixel number + 1, 0 none or used
  /// CV_32SC1, one pixel larger all round: the sectors of gradient directions in the 3 x 3 pixels about one.
  cv::Mat surroundings_;
  std::vector<std::uint16_t> votes_;
  std::vector<int> found_, found_before_;
  int rho_count_ = 0, rho_offset_ = 0;
  double min_length_px_ = 0.0, max_gap_px_ = 0.0;
};

}  // namespace window_ingress::detection
