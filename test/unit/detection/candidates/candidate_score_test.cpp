#include "detection/candidates/candidate_score.hpp"

#include <gtest/gtest.h>

#include "drawn_window.hpp"

namespace window_ingress::detection::candidate_score_test {

TEST(CandidateScore, LiesBetweenNoneAndOneAndFallsWithSupport) {
  Candidate c;
  for (SideSupport& side : c.sides) side = {1.0, 20.0, 0.0};
  EXPECT_NEAR(windowScore(c), 1.0, 1e-9);
  double before = 1.0;
  for (double fraction : {0.9, 0.7, 0.5, 0.2, 0.0}) {
    c.sides[3].fraction = fraction;
    EXPECT_LT(windowScore(c), before);
    EXPECT_GE(windowScore(c), 0.0);
    before = windowScore(c);
  }
}

TEST(CandidateScore, SizeRanksButIsNoConfidence) {
  EXPECT_LT(sizeRank(test::rectangle(0, 0, 10, 10), cv::Size(320, 240)),
            sizeRank(test::rectangle(100, 80, 200, 160), cv::Size(320, 240)));
  EXPECT_EQ(sizeRank(test::rectangle(0, 0, 319, 239), cv::Size(320, 240)), 1.0);
}

}  // namespace window_ingress::detection::candidate_score_test
