#include <gtest/gtest.h>

#include <cmath>

#include "detection/tracking/appearance_monitor.hpp"

namespace window_ingress::detection::appearance_gate_test {

AppearanceGate known(double distance) {
  AppearanceGate likeness;
  for (int i = 0; i < 5; ++i) likeness.note(distance, 1.0 + 0.5 * i);
  return likeness;
}

TEST(AppearanceGate, AllowsAnythingBeforeItKnows) {
  AppearanceGate likeness;
  EXPECT_TRUE(likeness.allows(0.9, 1.0));
  likeness.note(0.05, 1.0);
  likeness.note(0.05, 1.5);
  EXPECT_TRUE(likeness.allows(0.9, 2.0)) << "two comparisons are not enough";
}

TEST(AppearanceGate, AllowsTheLikeAndTheBetterNotTheWorse) {
  const auto likeness = known(0.3);
  EXPECT_NEAR(likeness.best(), 0.3, 1e-9);
  EXPECT_TRUE(likeness.allows(0.05, 4.0));
  EXPECT_TRUE(likeness.allows(0.3 + 0.9 * AppearanceGate::kMargin, 4.0));
  EXPECT_FALSE(likeness.allows(0.3 + 1.1 * AppearanceGate::kMargin, 4.0));
}

TEST(AppearanceGate, ABetterOneRaisesTheBarAWorseOneDoesNotLowerIt) {
  auto likeness = known(0.3);
  for (int i = 0; i < 10; ++i) likeness.note(0.05, 4.0 + 0.5 * i);
  EXPECT_LT(likeness.best(), 0.1);
  for (int i = 0; i < 20; ++i) likeness.note(0.6, 9.0 + 0.5 * i);
  EXPECT_FALSE(likeness.allows(0.6, 9.5));
}

TEST(AppearanceGate, ForgetsAfterAWhileOutOfSight) {
  const auto likeness = known(0.05);
  EXPECT_FALSE(likeness.allows(0.6, 3.0 + 0.9 * AppearanceGate::kValidSec));
  EXPECT_TRUE(likeness.allows(0.6, 3.0 + 1.1 * AppearanceGate::kValidSec));
  EXPECT_TRUE(likeness.allows(0.6, 3.0 - 1.1 * AppearanceGate::kValidSec)) << "a clock that went back";
}

TEST(AppearanceGate, IgnoresWhatIsNoNumber) {
  auto likeness = known(0.05);
  likeness.note(std::nan(""), 4.0);
  likeness.note(0.01, std::nan(""));
  EXPECT_NEAR(likeness.best(), 0.05, 1e-9);
  EXPECT_FALSE(likeness.allows(std::nan(""), 4.0));
}

}  // namespace window_ingress::detection::appearance_gate_test
