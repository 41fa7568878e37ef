#include "detection/tracking/track_recheck.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace window_ingress::detection::track_recheck_test {

using Eigen::Vector2d;
using geometry::Quadrilateral;

Quadrilateral squareAt(double x, double y, double size) {
  return {Vector2d(x, y), Vector2d(x + size, y), Vector2d(x + size, y + size), Vector2d(x, y + size)};
}

// Rechecks whenever a recheck is due. \return whether the search's result is preferred
bool preferred(TrackRecheck& confirmation, int frames, const Quadrilateral& searched) {
  bool taken = false;
  for (int i = 0; i < frames && !taken; ++i)
    if (confirmation.isDue()) taken = confirmation.prefers(searched, squareAt(100, 100, 80));
  return taken;
}

TEST(TrackRecheck, ATrackThatTheSearchConfirmsIsLeftAlone) {
  const TrackParams params;
  TrackRecheck confirmation(params);
  confirmation.start();
  EXPECT_FALSE(
      preferred(confirmation, params.confirmations * TrackRecheck::kEveryFrames, squareAt(101, 100, 80)));
  EXPECT_TRUE(confirmation.isConfirmed());
  for (int i = 0; i < 1000; ++i) ASSERT_FALSE(confirmation.isDue()) << "no more searches";
  confirmation.doubt();
  EXPECT_FALSE(preferred(confirmation, 1000, squareAt(200, 100, 80)))
      << "another window never takes its place";
  EXPECT_TRUE(preferred(confirmation, 1000, squareAt(105, 103, 74))) << "other borders of it may";
  confirmation.doubt();
  EXPECT_FALSE(preferred(confirmation, 1000, squareAt(100, 101, 80)));
  EXPECT_FALSE(confirmation.isDue()) << "no longer doubtful";
  EXPECT_TRUE(confirmation.isConfirmed());
}

TEST(TrackRecheck, AWrongStartIsLeftForThePlaceThatIsFoundAgainAndAgain) {
  TrackRecheck confirmation{TrackParams()};
  confirmation.start();
  EXPECT_TRUE(preferred(confirmation, 100, squareAt(230, 90, 70)));
  EXPECT_FALSE(confirmation.isConfirmed());
}

TEST(TrackRecheck, AnswersThatDifferFromEachOtherMeanNothing) {
  TrackRecheck confirmation{TrackParams()};
  confirmation.start();
  int asked = 0;
  for (int i = 0; i < 500; ++i) {
    if (!confirmation.isDue()) continue;
    EXPECT_FALSE(confirmation.prefers(squareAt(150 + 40 * (++asked % 3), 100, 80), squareAt(100, 100, 80)));
  }
  EXPECT_GT(asked, 3);
  EXPECT_LT(asked, 60) << "it ends some time";
}

TEST(TrackRecheck, NoAnswerAndBadNumbersAreNoOpinion) {
  const TrackParams params;
  TrackRecheck confirmation(params);
  confirmation.start();
  Quadrilateral bad = squareAt(0, 0, 9);
  bad[2].x() = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 20; ++i) {
    EXPECT_FALSE(confirmation.prefers(std::nullopt, squareAt(100, 100, 80)));
    EXPECT_FALSE(confirmation.prefers(bad, squareAt(100, 100, 80)));
  }
  EXPECT_FALSE(confirmation.isConfirmed());
}

}  // namespace window_ingress::detection::track_recheck_test
