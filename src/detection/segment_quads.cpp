#include "window_ingress/detection/segment_quads.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace window_ingress::detection {
namespace {

using Eigen::Vector2d;

constexpr double kSlackPx = 3.0;
constexpr double kRoundedPx = 1.5;       ///< edges end this far before a corner
constexpr std::size_t kVariants = 4;     ///< of each loop that is kept so many are compared
constexpr double kOnPart = 0.3;          ///< a segment goes on beyond a junction with this part of its length
constexpr double kSameLoopPx = 1.0;      ///< corners of the same loop differ less than this [px]
constexpr double kSameLoopPart = 0.005;  ///< plus this part of its size
constexpr double kSmallestCosine = 0.25;  ///< of the angle between opposite sides

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// Part of the stretch from t1 to t2 that the segment, 0 to 1, covers.
double coverage(double t1, double t2) {
  const double low = std::min(t1, t2), high = std::max(t1, t2);
  return high > low ? std::max(0.0, std::min(high, 1.0) - std::max(low, 0.0)) / (high - low) : 0.0;
}

// How far the ends of a segment are from its two corners; running beyond counts half [px].
double endGap(double length, double t1, double t2) {
  const auto gap = [&](double short_by) {
    const double px = length * (short_by > 0.0 ? short_by : -0.5 * short_by);
    return std::max(0.0, px - kRoundedPx);
  };
  return gap(-std::min(t1, t2)) + gap(std::max(t1, t2) - 1.0);
}

// Number of sides that are brighter inside.
int brighterInside(const std::array<const Segment*, 4>& sides, const Vector2d& centre) {
  int count = 0;
  for (const Segment* side : sides) count += side->normal.dot(centre - side->a) > 0.0;
  return count;
}

bool sameLoop(const geometry::Quadrilateral& a, const geometry::Quadrilateral& b, double near_px) {
  for (int i = 0; i < 4; ++i)
    if ((a[i] - b[i]).squaredNorm() > near_px * near_px) return false;
  return true;
}

}  // namespace

// Where two lines meet, if both segments come near enough.
bool SegmentQuads::meet(const Side& p, const Side& q, Junction& junction) const {
  const double sine = cross(p.way, q.way);
  if (std::abs(sine) < min_sine_ * p.length * q.length) return false;
  const Vector2d d = q.start - p.start;
  const double t_p = cross(d, q.way) / sine;
  if (std::abs(t_p - 0.5) > p.reach) return false;
  const double t_q = cross(d, p.way) / sine;
  if (std::abs(t_q - 0.5) > q.reach) return false;
  junction.t_own = static_cast<float>(t_p), junction.t_other = static_cast<float>(t_q);
  const bool towards_b = 1.0 - t_q > kOnPart, towards_a = t_q > kOnPart;
  junction.right = sine > 0.0 ? towards_b : towards_a;
  junction.left = sine > 0.0 ? towards_a : towards_b;
  junction.point = p.start + t_p * p.way;
  return true;
}

void SegmentQuads::connect(const std::vector<Segment>& segments) {
  count_ = std::min<int>(static_cast<int>(segments.size()), effort_.segments);
  words_ = (count_ + 63) / 64;
  if (static_cast<int>(junctions_.size()) < count_) junctions_.resize(count_);
  for (auto& list : junctions_) list.clear();
  meets_.assign(static_cast<std::size_t>(count_) * words_, 0);
  places_.resize(static_cast<std::size_t>(count_) * count_);
  sides_.clear();
  for (int i = 0; i < count_; ++i) {
    const Segment& s = segments[i];
    const double length = s.length();
    sides_.push_back({s.a, s.b - s.a, length, 0.5 + params_.extension + kSlackPx / length});
  }
  Junction junction;
  for (int i = 0; i < count_; ++i)
    for (int j = 0; j < count_; ++j) {
      if (i == j || !meet(sides_[i], sides_[j], junction)) continue;
      junction.other = j;
      places_[i * count_ + j] = static_cast<std::int16_t>(junctions_[i].size());
      junctions_[i].push_back(junction);
      meets_[i * words_ + j / 64] |= std::uint64_t{1} << (j % 64);
    }
}

// Quadrilaterals whose first segment is i: neighbours j and l on it, the fourth k meets both.
void SegmentQuads::combineFrom(const std::vector<Segment>& segments, int i) {
  const auto& own = junctions_[i];
  const double length = sides_[i].length;
  for (std::size_t a = 0; a < own.size(); ++a) {
    if (own[a].other < i) continue;
    const Vector2d along_a = segments[own[a].other].normal;
    for (std::size_t b = a + 1; b < own.size() && combinations_ < effort_.combinations; ++b) {
      if (own[b].other < i) continue;
      if (!((own[a].left && own[b].left) || (own[a].right && own[b].right))) continue;
      const double stretch = std::abs(own[a].t_own - own[b].t_own) * length;
      if (stretch * stretch < 0.1 * min_area_px_) continue;
      if (coverage(own[a].t_own, own[b].t_own) < params_.min_coverage) continue;
      if (std::abs(along_a.dot(segments[own[b].other].normal)) < kSmallestCosine) continue;
      close(segments, i, own[a], own[b]);
    }
  }
}

void SegmentQuads::close(const std::vector<Segment>& segments, int i, const Junction& ij,
                         const Junction& il) {
  const std::uint64_t *of_j = &meets_[static_cast<std::size_t>(ij.other) * words_],
                      *of_l = &meets_[static_cast<std::size_t>(il.other) * words_];
  for (int word = i / 64; word < words_; ++word)
    for (std::uint64_t both = of_j[word] & of_l[word]; both; both &= both - 1) {
      const int k = 64 * word + __builtin_ctzll(both);
      if (k > i) consider(segments, i, ij, il, between(ij.other, k), between(il.other, k));
    }
}

void SegmentQuads::consider(const std::vector<Segment>& segments, int i, const Junction& ij,
                            const Junction& il, const Junction& jk, const Junction& lk) {
  ++combinations_;
  const double covered[4] = {coverage(ij.t_own, il.t_own), coverage(ij.t_other, jk.t_own),
                             coverage(jk.t_other, lk.t_other), coverage(lk.t_own, il.t_other)};
  const double mean = 0.25 * (covered[0] + covered[1] + covered[2] + covered[3]);
  if (mean < params_.mean_coverage || *std::min_element(covered, covered + 4) < params_.min_coverage) return;
  const std::array<const Segment*, 4> sides = {&segments[i], &segments[ij.other], &segments[jk.other],
                                               &segments[il.other]};
  const int bright = brighterInside(sides, 0.25 * (ij.point + jk.point + lk.point + il.point));
  const auto quad = geometry::canonical({ij.point, jk.point, lk.point, il.point});
  if (!quad) return;
  const double area = geometry::signedArea(*quad);
  if (area < min_area_px_) return;
  const double gap_px = endGap(sides_[i].length, ij.t_own, il.t_own) +
                        endGap(sides_[ij.other].length, ij.t_other, jk.t_own) +
                        endGap(sides_[jk.other].length, jk.t_other, lk.t_other) +
                        endGap(sides_[il.other].length, lk.t_own, il.t_other);
  const double closed =
      std::exp(-gap_px / 8.0 / (params_.closure_px + params_.closure_side * std::sqrt(area)));
  const int odd = std::min(bright, 4 - bright);
  const double even = odd == 0 ? 1.0 : odd == 1 ? params_.odd_side : params_.odd_side * params_.odd_side;
  found_.push_back({mean * closed * even * std::sqrt(std::sqrt(area)), closed * even, *quad});
}

// The best, each loop once.
void SegmentQuads::keepBest() {
  order_.resize(found_.size());
  std::iota(order_.begin(), order_.end(), 0);
  const auto better = [&](int a, int b) {
    return found_[a].value > found_[b].value || (found_[a].value == found_[b].value && a < b);
  };
  const std::size_t looked_at = std::min(order_.size(), kVariants * static_cast<std::size_t>(effort_.quads));
  result_.budget_exceeded = result_.budget_exceeded || looked_at < order_.size();
  std::partial_sort(order_.begin(), order_.begin() + static_cast<std::ptrdiff_t>(looked_at), order_.end(),
                    better);
  order_.resize(looked_at);
  result_.candidates.clear();
  for (int i : order_) {
    const Found& one = found_[i];
    const double near_px = kSameLoopPx + kSameLoopPart * std::sqrt(geometry::signedArea(one.quad));
    const bool known =
        std::any_of(result_.candidates.begin(), result_.candidates.end(),
                    [&](const Candidate& better) { return sameLoop(better.quad, one.quad, near_px); });
    if (known) continue;
    if (static_cast<int>(result_.candidates.size()) == effort_.quads) {
      result_.budget_exceeded = true;
      return;
    }
    Candidate candidate;
    candidate.quad = candidate.seen = one.quad;
    candidate.source = CandidateSource::kSegments;
    candidate.closure = one.closure;
    result_.candidates.push_back(candidate);
  }
}

const SegmentQuads::Result& SegmentQuads::run(const std::vector<Segment>& segments, double min_area_px,
                                              const Effort& effort) {
  effort_ = effort;
  found_.clear();
  combinations_ = 0;
  min_area_px_ = min_area_px;
  min_sine_ = std::sin(params_.min_angle_rad);
  connect(segments);
  for (int i = 0; i < count_; ++i) combineFrom(segments, i);
  result_.budget_exceeded =
      combinations_ >= effort_.combinations || count_ < static_cast<int>(segments.size());
  keepBest();
  return result_;
}

}  // namespace window_ingress::detection
