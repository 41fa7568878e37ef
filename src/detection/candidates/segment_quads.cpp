#include "detection/candidates/segment_quads.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "detection/quad_sameness.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {
namespace {

using Eigen::Vector2d;

constexpr double kMeanCoverage = 0.65;        ///< least mean coverage of the four sides
const double kMinCornerSine = std::sin(0.6);  ///< of the angle between neighbouring sides
constexpr double kOddSide = 0.95;  ///< factor for each side whose polarity differs from the majority
constexpr double kSlackPx = 3.0;
constexpr double kRoundedPx = 1.5;        ///< edges end this far before a corner [px]
constexpr std::size_t kVariantsKept = 4;  ///< variants compared per quadrilateral kept
constexpr double kOnPart = 0.3;           ///< a side uses at least this part of its segment beyond a junction
constexpr double kLongest = 2.0;          ///< greatest mean side of a quadrilateral over its first side
constexpr double kLargest = 2.0;          ///< the same over the mean length of the segments at a corner
constexpr float kNoWay = 1e9F;
constexpr double kSmallestCosine = 0.25;  ///< of the angle between opposite sides

constexpr double kOpenCoverage = 0.6;  ///< coverage of the side between two others without a fourth
constexpr double kOpenSide = 0.3;      ///< least ratio of the shorter to the longer of two opposite sides
constexpr double kOpenLongest = 3.0;   ///< the longer over the side between, or that over the shorter
constexpr double kOpenCosine = 0.8;    ///< of the angle between the two opposite sides
constexpr std::size_t kMostOpen = 200;

// Part of the stretch from t1 to t2 that is covered by the segment, 0 to 1.
double coverage(double t1, double t2) {
  const double low = std::min(t1, t2), high = std::max(t1, t2);
  return high > low ? std::max(0.0, std::min(high, 1.0) - std::max(low, 0.0)) / (high - low) : 0.0;
}

// Distance of a segment's ends from a corner at t, if a side continues from there to a, or to b; running
// beyond counts half. kNoWay where too little of the segment continues.
std::array<float, 2> gapsPx(double length, double t) {
  const auto gap = [length](double short_by) {
    const double px = length * (short_by > 0.0 ? short_by : -0.5 * short_by);
    return static_cast<float>(std::max(0.0, px - kRoundedPx));
  };
  return {t > kOnPart ? gap(t - 1.0) : kNoWay, 1.0 - t > kOnPart ? gap(-t) : kNoWay};
}

}  // namespace

// Intersection of two lines, if both segments come near enough.
bool SegmentQuads::meet(const Side& p, const Side& q, Junction& junction) const {
  const double sine = geometry::cross(p.way, q.way);
  if (std::abs(sine) < kMinCornerSine * p.length * q.length) return false;
  const Vector2d d = q.segment.a - p.segment.a;
  const double t_p = geometry::cross(d, q.way) / sine;
  if (std::abs(t_p - 0.5) > p.reach) return false;
  const double t_q = geometry::cross(d, p.way) / sine;
  if (std::abs(t_q - 0.5) > q.reach) return false;
  junction.t_own = static_cast<float>(t_p), junction.t_other = static_cast<float>(t_q);
  junction.from_left = sine > 0.0;
  junction.own_gap_px = gapsPx(p.length, t_p), junction.other_gap_px = gapsPx(q.length, t_q);
  junction.point = p.segment.a + t_p * p.way;
  return true;
}

// Records the ways and sides for which the junction may be a corner.
void SegmentQuads::enter(int i, const Junction& junction) {
  const double size_px = kLargest * std::sqrt(sides_[i].length * sides_[junction.other].length);
  const double most_px = mostGap(size_px);
  bool any = false;
  for (int way : {kToA, kToB})
    for (int side : {kLeft, kRight}) {
      if (junction.gapPx(way, side) > most_px) continue;
      corners(i, way, side)[junction.other / 64] |= std::uint64_t{1} << (junction.other % 64);
      any = true;
    }
  if (!any) return;
  places_[i * count_ + junction.other] = static_cast<std::int16_t>(junctions_[i].size());
  junctions_[i].push_back(junction);
}

void SegmentQuads::connect(const std::vector<Segment>& segments) {
  count_ = std::min(static_cast<int>(segments.size()), effort_.segments);
  words_ = (count_ + 63) / 64;
  if (static_cast<int>(junctions_.size()) < count_) junctions_.resize(count_);
  for (auto& list : junctions_) list.clear();
  corners_.assign(static_cast<std::size_t>(count_) * 4 * words_, 0);
  places_.resize(static_cast<std::size_t>(count_) * count_);
  sides_.clear();
  for (int i = 0; i < count_; ++i) {
    const Segment& segment = segments[i];
    const double length = segment.length();
    const double reach = 0.5 + params_.extension + kSlackPx / length;
    sides_.push_back({segment, segment.b - segment.a, length, reach});
  }
  Junction junction;
  for (int i = 0; i < count_; ++i)
    for (int j = 0; j < count_; ++j) {
      if (i == j || !meet(sides_[i], sides_[j], junction)) continue;
      junction.other = j;
      enter(i, junction);
    }
}

// Pairs of corners where two sides leave segment i on one side, both on segments from `lowest` on, until
// `use` returns false. \param size greatest mean side of a quadrilateral [distances of the corners]
template <typename Use>
void SegmentQuads::forEachBase(int i, int side, int lowest, double size, double min_coverage,
                               const Use& use) const {
  for (const Junction& first : junctions_[i]) {
    if (first.other < lowest || first.gapPx(kToB, side) >= kNoWay) continue;
    for (const Junction& second : junctions_[i]) {
      if (second.other < lowest || second.t_own <= first.t_own || second.gapPx(kToA, side) >= kNoWay)
        continue;
      const double stretch_px = (second.t_own - first.t_own) * sides_[i].length;
      if (stretch_px * stretch_px < 0.1 * min_area_px_) continue;
      const double gap_px = first.gapPx(kToB, side) + second.gapPx(kToA, side);
      const double most_px = mostGap(size * stretch_px);
      if (gap_px > most_px || coverage(first.t_own, second.t_own) < min_coverage) continue;
      if (!use(Base{i, side, &first, &second, stretch_px, gap_px, most_px})) return;
    }
  }
}

// The fourth segments k: each makes a corner with both neighbours j and l of the first one, i.
void SegmentQuads::close(const Base& base) {
  const Junction &ij = *base.first, &il = *base.second;
  const Way back_j = ij.otherTowards(1 - base.side), back_l = il.otherTowards(1 - base.side);
  // Side of j and l on which the first segment continues.
  const int side_j = ij.from_left ? kLeft : kRight, side_l = il.from_left ? kRight : kLeft;
  const std::uint64_t *of_j = corners(ij.other, back_j, side_j), *of_l = corners(il.other, back_l, side_l);
  for (int word = base.own / 64; word < words_; ++word)
    for (std::uint64_t both = of_j[word] & of_l[word]; both; both &= both - 1) {
      const int k = 64 * word + __builtin_ctzll(both);
      if (k <= base.own) continue;
      const Junction &jk = between(ij.other, k), &lk = between(il.other, k);
      const double gap_px = base.gap_px + jk.gapPx(back_j, side_j) + lk.gapPx(back_l, side_l);
      if (gap_px <= base.most_gap_px) consider(base, jk, lk, gap_px);
    }
}

void SegmentQuads::consider(const Base& base, const Junction& jk, const Junction& lk, double gap_px) {
  ++combinations_;
  const Junction &ij = *base.first, &il = *base.second;
  const double covered[4] = {coverage(ij.t_own, il.t_own), coverage(ij.t_other, jk.t_own),
                             coverage(jk.t_other, lk.t_other), coverage(lk.t_own, il.t_other)};
  const double mean = 0.25 * (covered[0] + covered[1] + covered[2] + covered[3]);
  if (mean < kMeanCoverage || *std::min_element(covered, covered + 4) < params_.min_coverage) return;
  const auto quad = geometry::canonical({ij.point, jk.point, lk.point, il.point});
  if (!quad) return;
  const double area = geometry::signedArea(*quad), size_px = std::sqrt(area);
  if (area < min_area_px_ || gap_px > mostGap(size_px)) return;
  const double closed = std::exp(-gap_px / closurePx(size_px));
  const Vector2d centre = 0.25 * (ij.point + jk.point + lk.point + il.point);
  int bright = 0;  // sides that are brighter inside
  for (int i : {base.own, ij.other, jk.other, il.other})
    bright += sides_[i].segment.normal.dot(centre - sides_[i].segment.a) > 0.0;
  const int odd = std::min(bright, 4 - bright);
  const double even = odd == 0 ? 1.0 : odd == 1 ? kOddSide : kOddSide * kOddSide;
  found_.push_back({mean * closed * even * std::sqrt(size_px), closed * even, *quad});
}

// The best of what was found, each quadrilateral once.
SegmentQuads::Result SegmentQuads::best(std::size_t most, std::size_t looked_at) const {
  std::vector<int> order(found_.size());
  std::iota(order.begin(), order.end(), 0);
  looked_at = std::min(order.size(), looked_at);
  const auto end = order.begin() + static_cast<std::ptrdiff_t>(looked_at);
  std::partial_sort(order.begin(), end, order.end(), [this](int a, int b) {
    return found_[a].value > found_[b].value || (found_[a].value == found_[b].value && a < b);
  });
  Result result;
  result.budget_exceeded = looked_at < order.size();
  for (auto i = order.begin(); i != end; ++i) {
    const Found& one = found_[*i];
    const Sameness same(one.quad);
    const bool known = std::any_of(result.candidates.begin(), result.candidates.end(),
                                   [&](const Candidate& better) { return same.sameQuad(better.quad); });
    if (known) continue;
    if (result.candidates.size() == most) {
      result.budget_exceeded = true;
      break;
    }
    Candidate& candidate = result.candidates.emplace_back();
    candidate.quad = candidate.seen = one.quad;
    candidate.source = CandidateSource::kSegments;
    candidate.closure = one.closure;
  }
  return result;
}

// Two sides that may be opposite end where something covers the fourth side, or one of them.
void SegmentQuads::closeOpen(const Base& base) {
  const auto wayAlong = [&](const Junction& corner) {
    const Segment& segment = sides_[corner.other].segment;
    return Vector2d((corner.otherTowards(base.side) == kToA ? segment.a : segment.b) - corner.point);
  };
  const Vector2d one = wayAlong(*base.first), other = wayAlong(*base.second);
  const double one_px = one.norm(), other_px = other.norm(), between_px = base.stretch_px;
  const auto [shorter, longer] = std::minmax(one_px, other_px);
  if (shorter < kOpenSide * longer || longer > kOpenLongest * between_px ||
      shorter * kOpenLongest < between_px || one.dot(other) < kOpenCosine * one_px * other_px)
    return;
  const double closed = std::exp(-base.gap_px / closurePx(between_px));
  for (double far_px : {longer, shorter}) {
    const Vector2d far_one = base.first->point + one * far_px / one_px,
                   far_other = base.second->point + other * far_px / other_px;
    const auto quad = geometry::canonical({base.first->point, far_one, far_other, base.second->point});
    const double area = quad ? geometry::signedArea(*quad) : 0.0;
    if (area >= min_area_px_) found_.push_back({closed * std::pow(area, 0.25), closed, *quad});
  }
}

std::vector<Candidate> SegmentQuads::open() {
  found_.clear();
  for (int i = 0; i < count_; ++i)
    for (int side : {kLeft, kRight})
      forEachBase(i, side, 0, 1.0, kOpenCoverage, [this](const Base& base) {
        closeOpen(base);
        return true;
      });
  return best(kMostOpen, found_.size()).candidates;
}

SegmentQuads::Result SegmentQuads::run(const std::vector<Segment>& segments, double min_area_px,
                                       const Effort& effort) {
  effort_ = effort;
  found_.clear();
  combinations_ = 0;
  min_area_px_ = min_area_px;
  tolerance_ = -std::log(effort.min_closure);
  connect(segments);
  for (int i = 0; i < count_; ++i)
    for (int side : {kLeft, kRight})  // segment i has the lowest index of the four
      forEachBase(i, side, i, kLongest, params_.min_coverage, [this](const Base& base) {
        const Segment &one = sides_[base.first->other].segment, &other = sides_[base.second->other].segment;
        if (std::abs(one.normal.dot(other.normal)) < kSmallestCosine) return true;
        close(base);
        return combinations_ < effort_.combinations;
      });
  const auto most = static_cast<std::size_t>(effort_.quads);
  Result result = best(most, kVariantsKept * most);
  result.budget_exceeded = result.budget_exceeded || combinations_ >= effort_.combinations ||
                           count_ < static_cast<int>(segments.size());
  return result;
}

}  // namespace window_ingress::detection
