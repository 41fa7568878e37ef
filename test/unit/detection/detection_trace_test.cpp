#include "window_ingress/detection/detection_trace.hpp"

#include <gtest/gtest.h>

#include <set>

namespace window_ingress::detection::detection_trace_test {

TEST(DetectionTrace, EveryReasonHasItsOwnName) {
  std::set<std::string> names;
  for (int i = 0; i < kRejectReasons; ++i) names.insert(toString(static_cast<RejectReason>(i)));
  EXPECT_EQ(static_cast<int>(names.size()), kRejectReasons);
  EXPECT_EQ(names.count("unknown"), 0u);
}

TEST(DetectionTrace, GatesWithoutAMeasureAreDescribedInWords) {
  CandidateTrace candidate;
  for (RejectReason reason : {RejectReason::kPane, RejectReason::kOuterBorder}) {
    candidate.reject = reason;
    EXPECT_EQ(describe(candidate).find_first_of("0123456789<>"), std::string::npos);
    EXPECT_GT(describe(candidate).size(), 10u);
  }
}

TEST(DetectionTrace, DescribesTheGateWithNumbers) {
  CandidateTrace candidate;
  candidate.reject = RejectReason::kAspect;
  candidate.value = 3.1;
  candidate.limit = 2.5;
  EXPECT_EQ(describe(candidate), "aspect 3.1 > 2.5");
  candidate.value = 0.1;
  candidate.limit = 0.3;
  EXPECT_EQ(describe(candidate), "aspect 0.1 < 0.3");
  candidate.reject = RejectReason::kNone;
  candidate.score = 0.5;
  EXPECT_EQ(describe(candidate), "target, score 0.50");
}

}  // namespace window_ingress::detection::detection_trace_test
