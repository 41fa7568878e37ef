#include "detection/candidates/candidate_gates.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "drawn_window.hpp"

namespace window_ingress::detection::candidate_gates_test {

const cv::Size kImage(320, 240);

Candidate good() {
  Candidate candidate;
  candidate.quad = candidate.seen = test::rectangle(100, 80, 200, 160);
  for (SideSupport& side : candidate.sides) side = {1.0, 20.0, 0.0};
  return candidate;
}

void expectShape(const Candidate& candidate, RejectReason reason) {
  const auto rejection = shapeFault(candidate, kImage, {});
  ASSERT_TRUE(rejection) << toString(reason);
  EXPECT_EQ(rejection->reason, reason) << toString(rejection->reason);
}

TEST(CandidateGates, AGoodCandidatePasses) {
  EXPECT_FALSE(shapeFault(good(), kImage, {}));
  EXPECT_FALSE(supportFault(good(), {}));
}

TEST(CandidateGates, EachShapeGateNamesItself) {
  Candidate c = good();
  std::swap(c.quad[0], c.quad[1]);
  expectShape(c, RejectReason::kCorners);
  c = good(), c.quad[2].x() = std::numeric_limits<double>::quiet_NaN();
  expectShape(c, RejectReason::kCorners);
  c = good(), c.quad = c.seen = test::rectangle(100, 80, 110, 90);
  expectShape(c, RejectReason::kAreaSmall);
  c = good(), c.quad = c.seen = test::rectangle(1, 1, 318, 238);
  expectShape(c, RejectReason::kAreaLarge);
  c = good(), c.quad = c.seen = test::rectangle(20, 100, 300, 130);
  expectShape(c, RejectReason::kAspect);
  c = good(), c.quad = c.seen = test::rectangle(150, 10, 170, 230);
  expectShape(c, RejectReason::kAspect);
  c = good(), c.solidity = 0.3;
  expectShape(c, RejectReason::kSolidity);
  c = good(), c.quad[0].x() += 60, c.quad[3].x() -= 60;
  expectShape(c, RejectReason::kAngle);
  c = good(), c.quad = c.seen = test::rectangle(0, 80, 100, 160);
  expectShape(c, RejectReason::kBorder);
  c = good(), c.quad = c.seen = test::rectangle(100, 150, 200, 239.5);
  expectShape(c, RejectReason::kBorder);
}

TEST(CandidateGates, SupportGatesNameThemselvesAndTheirMargin) {
  Candidate c = good();
  c.sides[2].fraction = 0.2;
  EXPECT_EQ(supportFault(c, {})->reason, RejectReason::kLineSupport);
  EXPECT_DOUBLE_EQ(supportFault(c, {})->value, 0.2);
  for (SideSupport& side : c.sides) side.fraction = 0.55;
  EXPECT_EQ(supportFault(c, {})->reason, RejectReason::kLineSupport);
  EXPECT_DOUBLE_EQ(supportFault(c, {})->limit, 0.7);
  c = good();
  c.sides[1].contrast = 0.5;
  EXPECT_EQ(supportFault(c, {})->reason, RejectReason::kContrast);
}

TEST(CandidateGates, TheSameForMirroredAndScaledCandidates) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> x(-20, 340), y(-20, 260);
  for (int i = 0; i < 2000; ++i) {
    Candidate c = good();
    for (auto& p : c.quad) p = {x(random), y(random)};
    const auto ordered = geometry::canonical(c.quad);
    if (!ordered) continue;
    c.quad = *ordered;
    Candidate mirrored = c, doubled = c;
    for (int k = 0; k < 4; ++k) mirrored.quad[k].x() = kImage.width - 1 - c.quad[k].x();
    mirrored.quad = *geometry::canonical(mirrored.quad);
    for (int k = 0; k < 4; ++k) doubled.quad[k] = 2.0 * c.quad[k] + Eigen::Vector2d(0.5, 0.5);
    const auto here = shapeFault(c, kImage, {}), there = shapeFault(mirrored, kImage, {});
    const auto twice = shapeFault(doubled, cv::Size(640, 480), {});
    const auto reason = [](const auto& r) { return r ? r->reason : RejectReason::kNone; };
    if (reason(here) != RejectReason::kAspect && reason(there) != RejectReason::kAspect) {
      EXPECT_EQ(reason(here), reason(there));
    }
    if (reason(here) != RejectReason::kBorder && reason(twice) != RejectReason::kBorder) {
      EXPECT_EQ(reason(here), reason(twice));
    }
  }
}

}  // namespace window_ingress::detection::candidate_gates_test
