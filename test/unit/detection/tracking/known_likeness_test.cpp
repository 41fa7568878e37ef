#include <gtest/gtest.h>

#include <cmath>

#include "detection/tracking/track_confirmation.hpp"

namespace window_ingress::detection {
namespace {

KnownLikeness known(double distance) {
  KnownLikeness likeness;
  for (int i = 0; i < 5; ++i) likeness.note(distance, 1.0 + 0.5 * i);
  return likeness;
}

TEST(KnownLikeness, AllowsAnythingBeforeItKnows) {
  KnownLikeness likeness;
  EXPECT_TRUE(likeness.allows(0.9, 1.0));
  likeness.note(0.05, 1.0);
  likeness.note(0.05, 1.5);
  EXPECT_TRUE(likeness.allows(0.9, 2.0)) << "two comparisons are not enough";
}

TEST(KnownLikeness, AllowsTheLikeAndTheBetterNotTheWorse) {
  const auto likeness = known(0.3);
  EXPECT_NEAR(likeness.best(), 0.3, 1e-9);
  EXPECT_TRUE(likeness.allows(0.05, 4.0));
  EXPECT_TRUE(likeness.allows(0.3 + 0.9 * KnownLikeness::kMargin, 4.0));
  EXPECT_FALSE(likeness.allows(0.3 + 1.1 * KnownLikeness::kMargin, 4.0));
}

TEST(KnownLikeness, ABetterOneRaisesTheBarAWorseOneDoesNotLowerIt) {
  auto likeness = known(0.3);
  for (int i = 0; i < 10; ++i) likeness.note(0.05, 4.0 + 0.5 * i);
  EXPECT_LT(likeness.best(), 0.1);
  for (int i = 0; i < 20; ++i) likeness.note(0.6, 9.0 + 0.5 * i);
  EXPECT_FALSE(likeness.allows(0.6, 9.5));
}

TEST(KnownLikeness, ForgetsAfterAWhileOutOfSightAndOnRequest) {
  auto likeness = known(0.05);
  EXPECT_FALSE(likeness.allows(0.6, 3.0 + 0.9 * KnownLikeness::kValidSec));
  EXPECT_TRUE(likeness.allows(0.6, 3.0 + 1.1 * KnownLikeness::kValidSec));
  EXPECT_TRUE(likeness.allows(0.6, 3.0 - 1.1 * KnownLikeness::kValidSec)) << "a clock that went back";
  likeness.forget();
  EXPECT_TRUE(likeness.allows(0.6, 3.0));
}

TEST(KnownLikeness, IgnoresWhatIsNoNumber) {
  auto likeness = known(0.05);
  likeness.note(std::nan(""), 4.0);
  likeness.note(0.01, std::nan(""));
  EXPECT_NEAR(likeness.best(), 0.05, 1e-9);
  EXPECT_FALSE(likeness.allows(std::nan(""), 4.0));
}

}  // namespace
}  // namespace window_ingress::detection
