#include "detection/candidates/segment_quads.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "drawn_window.hpp"

namespace window_ingress::detection::segment_quads_test {

using Eigen::Vector2d;

Segment segment(const Vector2d& a, const Vector2d& b) {
  const Vector2d along = (b - a).normalized();
  return {a, b, Vector2d(-along.y(), along.x()), (b - a).norm(), 20.0};
}

bool holds(const SegmentQuads::Result& result, const geometry::Quadrilateral& quad) {
  return std::any_of(result.candidates.begin(), result.candidates.end(),
                     [&](const Candidate& c) { return test::worstCorner(c.quad, quad) < 0.01; });
}

/// The sides of a rectangle, and the distances of their ends from its corners, as Candidate::closure counts
/// them.
struct Sides {
  std::vector<Segment> segments;
  double closure = 1.0;
};

// Each end stops some pixels before its corner, or runs beyond it.
Sides looseSides(const geometry::Quadrilateral& quad, std::mt19937& random) {
  std::uniform_real_distribution<double> short_px(-25.0, 15.0);
  std::bernoulli_distribution turned(0.5);
  Sides sides;
  double gap_px = 0.0;
  for (int i = 0; i < 4; ++i) {
    const Vector2d a = quad[i], b = quad[(i + 1) % 4], along = (b - a).normalized();
    const double from = short_px(random), to = short_px(random);
    for (double px : {from, to}) gap_px += std::max(0.0, (px > 0.0 ? px : -0.5 * px) - 1.5);
    const Vector2d start = a + from * along, end = b - to * along;
    sides.segments.push_back(turned(random) ? segment(end, start) : segment(start, end));
  }
  const double size_px = std::sqrt(geometry::signedArea(quad));
  sides.closure = std::exp(-gap_px / 8.0 / (SegmentQuads::kClosurePx + SegmentQuads::kClosureSide * size_px));
  return sides;
}

TEST(SegmentQuads, FindsALoopAmongClutterExactlyIfItIsClosedEnough) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(0.0, 320.0), wobble(-8.0, 8.0);
  const SegmentQuads::Effort effort{100, 1000000, 100000, 0.3};
  int closed = 0, open = 0;
  for (int n = 0; n < 300; ++n) {
    geometry::Quadrilateral quad = test::rectangle(90, 60, 210, 170);
    for (Vector2d& corner : quad) corner += Vector2d(wobble(random), wobble(random));
    Sides sides = looseSides(quad, random);
    if (std::abs(std::log(sides.closure / effort.min_closure)) < 0.05) continue;
    for (int k = 0; k < 30; ++k)
      sides.segments.push_back(
          segment({place(random), place(random)}, Vector2d(place(random), place(random))));
    std::shuffle(sides.segments.begin(), sides.segments.end(), random);
    const bool expected = sides.closure > effort.min_closure;
    SegmentQuads quads{SegmentQuadsParams()};
    EXPECT_EQ(holds(quads.run(sides.segments, 1000.0, effort), quad), expected) << sides.closure;
    ++(expected ? closed : open);
  }
  EXPECT_GT(closed, 50);
  EXPECT_GT(open, 50);
}

TEST(SegmentQuads, TheOutlineOfAGridIsFoundBeforeItsCellsUseUpTheBudget) {
  std::vector<Segment> segments;
  for (int i = 0; i <= 9; ++i)
    for (double edge : {-1.0, 1.0}) {
      segments.push_back(segment({50.0, 20.0 + 20.0 * i + edge}, {230.0, 20.0 + 20.0 * i + edge}));
      segments.push_back(segment({50.0 + 20.0 * i + edge, 20.0}, {50.0 + 20.0 * i + edge, 200.0}));
    }
  SegmentQuads quads{SegmentQuadsParams()};
  const auto result = quads.run(segments, 150.0, SegmentQuads::kQuick);
  EXPECT_TRUE(holds(result, test::rectangle(49, 19, 231, 201)));
}

TEST(SegmentQuads, StopsAtItsBudgetAndSaysSo) {
  std::vector<Segment> segments;
  for (int i = 0; i < 30; ++i) {
    segments.push_back(segment({50.0, 20.0 + 6.0 * i}, {230.0, 20.0 + 6.0 * i}));
    segments.push_back(segment({50.0 + 6.0 * i, 20.0}, {50.0 + 6.0 * i, 200.0}));
  }
  SegmentQuads quads{SegmentQuadsParams()};
  const auto result = quads.run(segments, 100.0, {60, 500, 20, 0.01});
  EXPECT_TRUE(result.budget_exceeded);
  EXPECT_LE(result.candidates.size(), 20u);
}

TEST(SegmentQuads, ClosesWhatHasThreeSidesWhereTheyEnd) {
  const geometry::Quadrilateral quad = test::rectangle(90, 60, 210, 170);
  const std::vector<Segment> segments = {segment({88, 60}, {190, 60}), segment({90, 61}, {90, 168}),
                                         segment({92, 170}, {208, 170})};  // above it ends earlier
  SegmentQuads quads{SegmentQuadsParams()};
  EXPECT_TRUE(quads.run(segments, 100.0, SegmentQuads::kQuick).candidates.empty());
  const auto open = quads.open();
  ASSERT_FALSE(open.empty());
  EXPECT_LE(open.size(), 4u);
  EXPECT_TRUE(std::any_of(open.begin(), open.end(),
                          [&](const Candidate& one) { return test::worstCorner(one.quad, quad) < 3.0; }));
}

TEST(SegmentQuads, NothingFromNothing) {
  EXPECT_TRUE(SegmentQuads(SegmentQuadsParams()).run({}, 1.0, SegmentQuads::kQuick).candidates.empty());
  const Segment one{{0, 0}, {10, 0}, {0, 1}, 10, 20.0};
  EXPECT_TRUE(SegmentQuads(SegmentQuadsParams())
                  .run({one, one, one, one}, 1.0, SegmentQuads::kQuick)
                  .candidates.empty());
}

}  // namespace window_ingress::detection::segment_quads_test
