#include "adapters/runtime/diagnostics.hpp"

#include <gtest/gtest.h>

namespace window_ingress::adapters::diagnostics_test {

TEST(FailureCount, CountsInARowForEachCallback) {
  FailureCount failures;
  EXPECT_EQ(failures.health().level, Health::kOk);
  failures.failed("image", "no");
  failures.failed("image", "no");
  failures.succeeded("odom");
  EXPECT_EQ(failures.inARow("image"), 2) << "the success of another callback does not count";
  EXPECT_EQ(failures.health().level, Health::kWarn);
  failures.succeeded("image");
  EXPECT_EQ(failures.inARow("image"), 0);
  EXPECT_EQ(failures.inARow("never"), 0);
}

TEST(FailureCount, ManyInARowAreAnErrorAndNoLongerSaid) {
  FailureCount failures;
  for (int i = 0; i < FailureCount::kMany; ++i) EXPECT_TRUE(failures.failed("image", "bad image"));
  EXPECT_FALSE(failures.failed("image", "bad image"));
  const Health health = failures.health();
  EXPECT_EQ(health.level, Health::kError);
  EXPECT_EQ(health.text, "6 callbacks failed; the last one was image: bad image");
}

TEST(FailureCount, RecoveryLeavesAWarning) {
  FailureCount failures;
  for (int i = 0; i < FailureCount::kMany; ++i) failures.failed("image", "bad image");
  failures.succeeded("image");
  EXPECT_EQ(failures.health().level, Health::kWarn);
}

TEST(Output, NobodyHearsIsAWarningOnceStartUpIsOver) {
  EXPECT_EQ(outputHealth(0, "/window", 0.1).level, Health::kOk);
  EXPECT_EQ(outputHealth(0, "/window", 5.0).level, Health::kWarn);
  EXPECT_EQ(outputHealth(0, "/window", 5.0).text, "nobody subscribes to /window");
  EXPECT_EQ(outputHealth(1, "/window", 5.0).level, Health::kOk);
}

}  // namespace window_ingress::adapters::diagnostics_test
