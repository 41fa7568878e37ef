#include "adapters/images/unlike_reference.hpp"

#include <gtest/gtest.h>

namespace window_ingress::adapters::unlike_reference_test {

TEST(UnlikeReference, IsSaidAfterManyImagesInWhichTheReferenceAloneRefuses) {
  UnlikeReference unlike;
  detection::DetectionTrace trace;
  for (int i = 0; i < 2 * UnlikeReference::kMany; ++i) unlike.see(trace, false);
  EXPECT_EQ(unlike.health("candidates 0 < 1").text, "no window: candidates 0 < 1") << "nothing looks like a window";
  trace.outcome = detection::RejectReason::kUnlike;
  for (int i = 1; i < UnlikeReference::kMany; ++i) unlike.see(trace, false);
  EXPECT_EQ(unlike.health("correlation").text, "no window: correlation");
  trace.outcome = detection::RejectReason::kAppearance;
  unlike.see(trace, false);
  EXPECT_NE(unlike.health("correlation").text, "no window: correlation");
  EXPECT_NE(unlike.health("correlation 0.1 < 0.88").text.find("correlation 0.1 < 0.88"), std::string::npos);
  trace.outcome = detection::RejectReason::kNone;
  unlike.see(trace, true);
  EXPECT_EQ(unlike.health("").text, "no window: ");
}

}  // namespace window_ingress::adapters::unlike_reference_test
