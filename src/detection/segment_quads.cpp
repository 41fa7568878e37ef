#include "window_ingress/detection/segment_quads.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace window_ingress::detection {
namespace {

using Eigen::Vector2d;

constexpr int kMaxCombinations = 100000;
constexpr double kSlackPx = 3.0;
constexpr double kRoundedPx = 1.5;  ///< edges end this far before a corner

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Where two segments' lines meet; `t` counts along each segment, 0 to 1 between its ends.
struct Junction {
  int other = 0;
  double t_own = 0.0, t_other = 0.0;
  Vector2d point;
};

struct Covered {
  double value = 0.0, closure = 0.0;
  geometry::Quadrilateral quad;
};

// Part of [t1, t2] that lies within [0, 1].
double coverage(double t1, double t2) {
  const double low = std::min(t1, t2), high = std::max(t1, t2);
  return high > low ? std::max(0.0, std::min(high, 1.0) - std::max(low, 0.0)) / (high - low) : 0.0;
}

// How far a segment's ends are from the corners at t1 and t2; running beyond counts half, and edges are
// rounded off.
double endGap(const Segment& segment, double t1, double t2) {
  const auto gap = [&](double short_by) {
    const double px = segment.length() * (short_by > 0.0 ? short_by : -0.5 * short_by);
    return std::max(0.0, px - kRoundedPx);
  };
  return gap(-std::min(t1, t2)) + gap(std::max(t1, t2) - 1.0);
}

class Search {
 public:
  Search(const std::vector<Segment>& segments, const SegmentQuadsParams& params, double min_area_px)
      : segments_(segments),
        count_(std::min<int>(segments.size(), params.max_segments)),
        params_(params),
        min_area_px_(min_area_px),
        junctions_(count_) {}

  void run(std::vector<Covered>& found) {
    for (int i = 0; i < count_; ++i)
      for (int j = i + 1; j < count_; ++j) meet(i, j);
    for (int i = 0; i < count_; ++i) combineFrom(i, found);
  }
  bool budgetExceeded() const { return exhausted() || count_ < static_cast<int>(segments_.size()); }

 private:
  bool exhausted() const { return combinations_ > kMaxCombinations || steps_ > 10 * kMaxCombinations; }

  bool within(double t, double length) const {
    const double slack = params_.extension + kSlackPx / length;
    return t > -slack && t < 1.0 + slack;
  }

  void meet(int i, int j) {
    const Segment &p = segments_[i], &q = segments_[j];
    const Vector2d u = p.b - p.a, v = q.b - q.a;
    const double sine = cross(u, v), lp = u.norm(), lq = v.norm();
    if (std::abs(sine) < std::sin(params_.min_angle_rad) * lp * lq) return;
    const Vector2d d = q.a - p.a;
    const double ti = cross(d, v) / sine, tj = cross(d, u) / sine;
    if (!within(ti, lp) || !within(tj, lq)) return;
    const Vector2d point = p.a + ti * u;
    junctions_[i].push_back({j, ti, tj, point});
    junctions_[j].push_back({i, tj, ti, point});
  }

  // All rings i, j, k, l with i the smallest and j < l: each ring of four segments once.
  void combineFrom(int i, std::vector<Covered>& found) {
    const auto& own = junctions_[i];
    for (std::size_t a = 0; a < own.size(); ++a)
      for (std::size_t b = a + 1; b < own.size() && !exhausted(); ++b) {
        if (own[a].other < i || own[b].other < i) continue;
        if (coverage(own[a].t_own, own[b].t_own) >= params_.min_coverage) close(i, own[a], own[b], found);
      }
  }

  void close(int i, const Junction& ij, const Junction& il, std::vector<Covered>& found) {
    const auto &from_j = junctions_[ij.other], &from_l = junctions_[il.other];
    std::size_t b = 0;
    for (const Junction& jk : from_j) {
      if (jk.other <= i) continue;
      while (b < from_l.size() && from_l[b].other < jk.other) ++b;
      if (b == from_l.size()) return;
      ++steps_;
      if (from_l[b].other == jk.other) consider(segments_[i], ij, il, jk, from_l[b], found);
    }
  }

  double closure(const double gaps_px[4], double area_px) const {
    const double mean = (gaps_px[0] + gaps_px[1] + gaps_px[2] + gaps_px[3]) / 8.0;
    return std::exp(-mean / (params_.closure_px + params_.closure_side * std::sqrt(area_px)));
  }

  void consider(const Segment& first, const Junction& ij, const Junction& il, const Junction& jk,
                const Junction& lk, std::vector<Covered>& found) {
    ++combinations_;
    const double sides[4] = {coverage(ij.t_own, il.t_own), coverage(ij.t_other, jk.t_own),
                             coverage(jk.t_other, lk.t_other), coverage(lk.t_own, il.t_other)};
    const double mean = 0.25 * (sides[0] + sides[1] + sides[2] + sides[3]);
    if (*std::min_element(sides, sides + 4) < params_.min_coverage || mean < params_.mean_coverage) return;
    const auto quad = geometry::canonical({ij.point, jk.point, lk.point, il.point});
    if (!quad) return;
    const double area = geometry::signedArea(*quad);
    if (area < min_area_px_) return;
    const double gaps_px[4] = {endGap(first, ij.t_own, il.t_own),
                               endGap(segments_[ij.other], ij.t_other, jk.t_own),
                               endGap(segments_[jk.other], jk.t_other, lk.t_other),
                               endGap(segments_[il.other], lk.t_own, il.t_other)};
    const double closed = closure(gaps_px, area);
    found.push_back({mean * closed * std::pow(area, 0.25), closed, *quad});
  }

  const std::vector<Segment>& segments_;
  int count_;
  const SegmentQuadsParams& params_;
  double min_area_px_;
  std::vector<std::vector<Junction>> junctions_;
  int combinations_ = 0;
  int steps_ = 0;
};

}  // namespace

SegmentQuads::Result SegmentQuads::run(const std::vector<Segment>& segments, double min_area_px) const {
  std::vector<Covered> found;
  Search search(segments, params_, min_area_px);
  search.run(found);
  std::vector<int> order(found.size());
  std::iota(order.begin(), order.end(), 0);
  const auto better = [&](int a, int b) {
    return found[a].value > found[b].value || (found[a].value == found[b].value && a < b);
  };
  const auto kept = order.begin() + std::min<std::size_t>(order.size(), params_.max_quads);
  std::partial_sort(order.begin(), kept, order.end(), better);
  Result result;
  result.budget_exceeded = search.budgetExceeded() || static_cast<int>(found.size()) > params_.max_quads;
  for (auto i = order.begin(); i != kept; ++i) {
    Candidate candidate;
    candidate.quad = found[*i].quad;
    candidate.source = CandidateSource::kSegments;
    candidate.closure = found[*i].closure;
    result.candidates.push_back(candidate);
  }
  return result;
}

}  // namespace window_ingress::detection
