#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "detection/tracking/track_confirmation.hpp"

namespace window_ingress::detection {
namespace {

using Eigen::Vector2d;
using geometry::Quadrilateral;

Quadrilateral squareAt(double x, double y, double size) {
  return {Vector2d(x, y), Vector2d(x + size, y), Vector2d(x + size, y + size), Vector2d(x, y + size)};
}

// Asks as often as the opinion wants to; true once the answer is preferred.
bool preferred(TrackConfirmation& opinion, int frames, const Quadrilateral& searched) {
  bool taken = false;
  for (int i = 0; i < frames && !taken; ++i)
    if (opinion.isDue()) taken = opinion.prefers(searched, squareAt(100, 100, 80));
  return taken;
}

TEST(TrackConfirmation, ATrackThatTheSearchConfirmsIsLeftAlone) {
  const TrackParams params;
  TrackConfirmation opinion(params);
  opinion.start();
  EXPECT_FALSE(
      preferred(opinion, params.confirmations * TrackConfirmation::kEveryFrames, squareAt(101, 100, 80)));
  EXPECT_TRUE(opinion.isConfirmed());
  for (int i = 0; i < 1000; ++i) ASSERT_FALSE(opinion.isDue()) << "no more searches";
  opinion.doubt();
  EXPECT_FALSE(preferred(opinion, 1000, squareAt(200, 100, 80))) << "another window never takes its place";
  EXPECT_TRUE(preferred(opinion, 1000, squareAt(105, 103, 74))) << "other borders of it may";
  opinion.doubt();
  EXPECT_FALSE(preferred(opinion, 1000, squareAt(100, 101, 80)));
  EXPECT_FALSE(opinion.isDue()) << "no longer doubtful";
  EXPECT_TRUE(opinion.isConfirmed());
}

TEST(TrackConfirmation, AWrongStartIsLeftForThePlaceThatIsFoundAgainAndAgain) {
  TrackConfirmation opinion{TrackParams()};
  opinion.start();
  EXPECT_TRUE(preferred(opinion, 100, squareAt(230, 90, 70)));
  EXPECT_FALSE(opinion.isConfirmed());
}

TEST(TrackConfirmation, AnswersThatDifferFromEachOtherMeanNothing) {
  TrackConfirmation opinion{TrackParams()};
  opinion.start();
  int asked = 0;
  for (int i = 0; i < 500; ++i) {
    if (!opinion.isDue()) continue;
    EXPECT_FALSE(opinion.prefers(squareAt(150 + 40 * (++asked % 3), 100, 80), squareAt(100, 100, 80)));
  }
  EXPECT_GT(asked, 3);
  EXPECT_LT(asked, 60) << "it ends some time";
}

TEST(TrackConfirmation, NoAnswerAndBadNumbersAreNoOpinion) {
  const TrackParams params;
  TrackConfirmation opinion(params);
  opinion.start();
  Quadrilateral bad = squareAt(0, 0, 9);
  bad[2].x() = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 20; ++i) {
    EXPECT_FALSE(opinion.prefers(std::nullopt, squareAt(100, 100, 80)));
    EXPECT_FALSE(opinion.prefers(bad, squareAt(100, 100, 80)));
  }
  EXPECT_FALSE(opinion.isConfirmed());
}

}  // namespace
}  // namespace window_ingress::detection
