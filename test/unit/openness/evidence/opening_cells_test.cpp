#include "window_ingress/openness/opening_cells.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace window_ingress::openness::opening_cells_test {

const geometry::OpeningSize kOpening{1.2, 1.0}, kNeeded{0.6, 0.5};

void sprinkle(OpeningCells& cells, double from, double to, double log_odds) {
  for (double y = 0.005; y < 1.0; y += 0.01)
    for (double x = from; x < to; x += 0.01) cells.see({x, y}, log_odds);
}

TEST(OpeningCells, nothingSeenIsNothingOpen) {
  const auto share = OpeningCells().shareOf(kNeeded, kOpening);
  EXPECT_EQ(share.open, 0.0);
  EXPECT_EQ(share.closed, 0.0);
  EXPECT_EQ(share.least_quarter_open, 0.0);
}

TEST(OpeningCells, allSeenIsAllOpen) {
  OpeningCells cells;
  sprinkle(cells, 0.0, 1.0, 5.0);
  EXPECT_EQ(cells.shareOf(kNeeded, kOpening).open, 1.0);
  EXPECT_EQ(cells.shareOf(kNeeded, kOpening).least_quarter_open, 1.0);
  cells.clear();
  EXPECT_EQ(cells.shareOf(kNeeded, kOpening).open, 0.0);
}

TEST(OpeningCells, halfABoardLeavesAQuarterUnseen) {
  OpeningCells cells;
  sprinkle(cells, 0.0, 0.495, 5.0);
  EXPECT_EQ(cells.shareOf(kNeeded, kOpening).least_quarter_open, 0.0);
  EXPECT_NEAR(cells.shareOf(kNeeded, kOpening).open, 0.5, 1e-9);
  sprinkle(cells, 0.505, 1.0, -5.0);
  EXPECT_NEAR(cells.shareOf(kNeeded, kOpening).closed, 0.5, 1e-9);
}

TEST(OpeningCells, weakEvidenceIsNone) {
  OpeningCells cells;
  sprinkle(cells, 0.0, 1.0, 1.0);
  EXPECT_EQ(cells.shareOf(kNeeded, kOpening).open, 0.0);
}

TEST(OpeningCells, strongerEvidenceDecides) {
  OpeningCells cells;
  sprinkle(cells, 0.0, 1.0, 4.0);
  sprinkle(cells, 0.0, 1.0, -6.0);
  EXPECT_EQ(cells.shareOf(kNeeded, kOpening).closed, 1.0);
  sprinkle(cells, 0.0, 1.0, 8.0);
  EXPECT_EQ(cells.shareOf(kNeeded, kOpening).open, 1.0);
}

void seeBeside(OpeningCells& cells, int deep, int shallow, int images) {
  for (int i = 0; i < images; ++i) {
    for (int j = 0; j < deep; ++j) cells.seeBeside(~std::uint64_t{0}, 4.0);
    for (int j = 0; j < shallow; ++j) cells.seeBeside(~std::uint64_t{0}, -4.0);
    cells.endImage();
  }
}

TEST(OpeningCells, whatLiesBesideDeepPointsIsOpenAfterSomeImages) {
  OpeningCells cells;
  seeBeside(cells, 3, 0, 4);
  EXPECT_EQ(cells.shareOf(kNeeded, kOpening).open, 0.0);
  seeBeside(cells, 3, 0, 1);
  EXPECT_EQ(cells.shareOf(kNeeded, kOpening).open, 1.0);
  sprinkle(cells, 0.0, 1.0, -4.0);
  EXPECT_EQ(cells.shareOf(kNeeded, kOpening).closed, 1.0) << "what was seen outweighs what follows";
}

TEST(OpeningCells, fewPointsOrOneInThePlaneTellNothingOfWhatIsBeside) {
  OpeningCells few, one;
  seeBeside(few, 2, 0, 100);
  EXPECT_EQ(few.shareOf(kNeeded, kOpening).open, 0.0);
  seeBeside(one, 9, 0, 20);
  seeBeside(one, 9, 1, 1);
  EXPECT_EQ(one.shareOf(kNeeded, kOpening).open, 0.0);
}

TEST(OpeningCells, sharesStayWithinBoundsWhateverComes) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> anywhere(-1.0, 2.0), odds(-10.0, 10.0), size(0.01, 3.0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  OpeningCells cells;
  for (int i = 0; i < 5000; ++i) {
    cells.see({anywhere(random), anywhere(random)}, odds(random));
    if (i % 100 == 0) cells.see({nan, 0.5}, 3.0), cells.see({0.5, 0.5}, nan);
    const auto share = cells.shareOf({size(random), size(random)}, {size(random), size(random)});
    EXPECT_GE(share.least_quarter_open, 0.0);
    EXPECT_LE(share.open + share.closed, 1.0 + 1e-9);
  }
  EXPECT_GE(cells.shareOf({nan, 1.0}, {0.0, 1.0}).open, 0.0);
}

}  // namespace window_ingress::openness::opening_cells_test
