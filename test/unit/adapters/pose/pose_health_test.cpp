#include "adapters/pose/pose_health.hpp"

#include <gtest/gtest.h>

namespace window_ingress::adapters::pose_health_test {

using Offset = estimation::ClockCheck::Offset;

bool says(const Health& health, const char* words) { return health.text.find(words) != std::string::npos; }

const estimation::SenderClock kInTime;

TEST(ClocksHealth, WarnsFromFiftyMillisecondsOnIfThatIsCertain) {
  EXPECT_EQ(clocksHealth(std::nullopt, kInTime).level, Health::kOk);
  EXPECT_EQ(clocksHealth(Offset{0.04, 0.005}, kInTime).level, Health::kOk);
  EXPECT_EQ(clocksHealth(Offset{0.09, 0.05}, kInTime).level, Health::kOk);
  EXPECT_EQ(clocksHealth(Offset{-0.09, 0.01}, kInTime).level, Health::kWarn);
}

TEST(ClocksHealth, SaysThatStampsAheadAreTakenBack) {
  estimation::SenderClock ahead;
  ahead.atReceiver(10.15, 10.0);
  for (const auto& offset : {std::optional<Offset>(), std::optional(Offset{0.01, 0.01})}) {
    EXPECT_EQ(clocksHealth(offset, ahead).level, Health::kOk);
    EXPECT_TRUE(says(clocksHealth(offset, ahead), "0.15 s ahead of its arrival"));
    EXPECT_FALSE(says(clocksHealth(offset, kInTime), "ahead"));
  }
}

TEST(ClocksHealth, SaysWhichIsLateAndWhatToDo) {
  EXPECT_TRUE(says(clocksHealth(Offset{0.12, 0.01}, kInTime), "0.12 +- 0.01 s late"));
  EXPECT_TRUE(says(clocksHealth(Offset{-0.12, 0.01}, kInTime), "0.12 +- 0.01 s early"));
  EXPECT_TRUE(says(clocksHealth(Offset{-0.12, 0.01}, kInTime), "correct"));
}

TEST(FramesHealth, IsAnErrorOnlyWhereTheyAreWrong) {
  using estimation::FramesVerdict;
  EXPECT_EQ(framesHealth({FramesVerdict::kWrong, "camera mounting turned"}).level, Health::kError);
  EXPECT_TRUE(says(framesHealth({FramesVerdict::kWrong, "camera mounting turned"}), "no approach"));
  EXPECT_EQ(framesHealth({FramesVerdict::kUndecided, "no way flown"}).level, Health::kOk);
  EXPECT_EQ(framesHealth({FramesVerdict::kGood, ""}).level, Health::kOk);
}

TEST(OpennessHealth, SaysOfWhatLooksOpenWhatOneCameraCannotTell) {
  openness::OpennessVerdict verdict;
  verdict.openness = openness::Openness::kOpen;
  EXPECT_TRUE(says(opennessHealth(verdict), "cannot be told"));
  verdict.openness = openness::Openness::kClosed;
  EXPECT_FALSE(says(opennessHealth(verdict), "cannot be told"));
}

TEST(ConsistencyHealth, WarnsOfAFilterAtOddsWithItsImages) {
  EXPECT_EQ(consistencyHealth({40, 1.2, true}).level, Health::kOk);
  EXPECT_EQ(consistencyHealth({40, 5.0, false}).level, Health::kWarn);
  estimation::Consistency contradicted{40, 1.2, true};
  contradicted.contradicted = true;
  EXPECT_EQ(consistencyHealth(contradicted).level, Health::kWarn);
}

UnusedImages seenInVain(int count, double aspect) {
  window_ingress::ApparentOpening opening;
  opening.aspect = aspect;
  opening.aspect_sigma = 0.003;
  UnusedImages unused;
  for (int i = 0; i < count; ++i) unused.add("gated out", opening);
  unused.add("gated out", window_ingress::ApparentOpening());
  return unused;
}

TEST(TargetHealth, NamesTheShapeThatIsSeenAndTheOneThatIsSaid) {
  EXPECT_EQ(targetHealth(seenInVain(5, 1.2), {1.0, 1.2}).level, Health::kOk);
  const Health swapped = targetHealth(seenInVain(30, 1.2), {1.0, 1.2});
  EXPECT_EQ(swapped.level, Health::kError);
  EXPECT_TRUE(says(swapped, "31 images")) << swapped.text;
  EXPECT_TRUE(says(swapped, "1.20 times as wide as it is high")) << swapped.text;
  EXPECT_TRUE(says(swapped, "1.00 x 1.20 m, is 0.83 times")) << swapped.text;
}

TEST(TargetHealth, SaysWhyWhereTheShapeIsRight) {
  for (const double aspect : {1.2, 0.0}) {  // 0: no image shows the aspect
    const Health right = targetHealth(seenInVain(30, aspect), {1.2, 1.0});
    EXPECT_EQ(right.level, Health::kError);
    EXPECT_TRUE(says(right, "used in none: gated out")) << right.text;
  }
}

}  // namespace window_ingress::adapters::pose_health_test
