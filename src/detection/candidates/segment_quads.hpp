#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "detection/candidates/candidate.hpp"
#include "detection/candidates/hough_segments.hpp"
#include "window_ingress/detection/detector_params.hpp"

namespace window_ingress::detection {

/// Quadrilaterals whose sides are straight segments and whose corners are the segments' intersections. Finds
/// windows whose contour is broken or merges with its neighbours (P4 selects and constrains, P7).
class SegmentQuads {
 public:
  struct Result {
    std::vector<Candidate> candidates;  ///< best covered first, each quadrilateral once
    bool budget_exceeded = false;
  };

  /// Mean distance of segment ends from corners that reduces closure by a factor of e: so many pixels, and
  /// this part of the quadrilateral's mean side.
  static constexpr double kClosurePx = 1.5, kClosureSide = 0.02;

  explicit SegmentQuads(const SegmentQuadsParams& params) : params_(params) {}

  /// Limits of the search: number of strongest segments combined, number of combinations, number of best
  /// covered quadrilaterals kept, and least closure.
  struct Effort {
    int segments, combinations, quads;
    double min_closure;
  };
  static constexpr Effort kQuick = {180, 100000, 100, 0.2}, kThorough = {260, 300000, 250, 0.03};

  /// \param segments strongest first, in pixels of the search level
  Result run(const std::vector<Segment>& segments, double min_area_px, const Effort& effort);

  /// Quadrilaterals from three sides of the last run each, as if something covered the fourth: closed at the
  /// end of the longer and at the end of the shorter opposite side. Likeliest first, each once.
  std::vector<Candidate> open();

 private:
  /// The ways along a segment, and its sides as seen from a to b.
  enum Way { kToA, kToB };
  enum SideOf { kLeft, kRight };

  /// Intersection of two segments' lines; `t` runs from 0 at end a to 1 at end b.
  struct Junction {
    int other = 0;
    bool from_left = false;  ///< the other segment, from a to b, crosses from left to right
    float t_own = 0.0F, t_other = 0.0F;
    /// Distances of the segments' ends from this corner, by the way a side continues; kNoWay: no side there.
    std::array<float, 2> own_gap_px, other_gap_px;
    Eigen::Vector2d point;

    Way otherTowards(int side) const { return from_left == (side == kRight) ? kToB : kToA; }
    float gapPx(int way, int side) const { return own_gap_px[way] + other_gap_px[otherTowards(side)]; }
  };

  /// A segment prepared for junctions: a line may meet it up to `reach` from its middle [its lengths].
  struct Side {
    Segment segment;
    Eigen::Vector2d way;
    double length = 0.0, reach = 0.0;
  };
  /// Two neighbouring corners on the first segment, their distance, and their gaps.
  struct Base {
    int own = 0, side = kLeft;
    const Junction *first = nullptr, *second = nullptr;
    double stretch_px = 0.0, gap_px = 0.0, most_gap_px = 0.0;
  };
  struct Found {
    double value = 0.0, closure = 0.0;
    geometry::Quadrilateral quad;
  };

  void connect(const std::vector<Segment>& segments);
  bool meet(const Side& p, const Side& q, Junction& junction) const;
  void enter(int i, const Junction& junction);
  template <typename Use>
  void forEachBase(int i, int side, int lowest, double size, double min_coverage, const Use& use) const;
  void close(const Base& base);
  void consider(const Base& base, const Junction& jk, const Junction& lk, double gap_px);
  void closeOpen(const Base& base);
  Result best(std::size_t most, std::size_t looked_at) const;
  double mostGap(double size_px) const { return tolerance_ * closurePx(size_px); }
  double closurePx(double size_px) const { return 8.0 * (kClosurePx + kClosureSide * size_px); }
  const Junction& between(int i, int j) const { return junctions_[i][places_[i * count_ + j]]; }
  std::uint64_t* corners(int i, int way, int side) { return &corners_[((i * 2 + way) * 2 + side) * words_]; }

  SegmentQuadsParams params_;
  Effort effort_ = kQuick;
  int count_ = 0, words_ = 0, combinations_ = 0;
  double min_area_px_ = 0.0, tolerance_ = 0.0;
  std::vector<Side> sides_;
  std::vector<std::vector<Junction>> junctions_;
  std::vector<std::uint64_t> corners_;  ///< by segment, way and side: one bit per segment it meets there
  std::vector<std::int16_t> places_;    ///< index of a pair's junction
  std::vector<Found> found_;
};

}  // namespace window_ingress::detection
