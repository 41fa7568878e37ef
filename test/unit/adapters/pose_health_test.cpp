#include "adapters/pose_health.hpp"

#include <gtest/gtest.h>

namespace window_ingress::adapters {
namespace {

using Offset = pose::ClockCheck::Offset;

bool says(const Health& health, const char* words) { return health.text.find(words) != std::string::npos; }

TEST(ClocksHealth, WarnsFromFiftyMillisecondsOnIfThatIsCertain) {
  EXPECT_EQ(clocksHealth(std::nullopt).level, Health::kOk);
  EXPECT_EQ(clocksHealth(Offset{0.04, 0.005}).level, Health::kOk);
  EXPECT_EQ(clocksHealth(Offset{0.09, 0.05}).level, Health::kOk);
  EXPECT_EQ(clocksHealth(Offset{-0.09, 0.01}).level, Health::kWarn);
}

TEST(ClocksHealth, SaysWhichIsLateAndWhatToDo) {
  EXPECT_TRUE(says(clocksHealth(Offset{0.12, 0.01}), "0.12 +- 0.01 s late"));
  EXPECT_TRUE(says(clocksHealth(Offset{-0.12, 0.01}), "0.12 +- 0.01 s early"));
  EXPECT_TRUE(says(clocksHealth(Offset{-0.12, 0.01}), "correct"));
}

TEST(FramesHealth, IsAnErrorOnlyWhereTheyAreWrong) {
  using pose::FramesVerdict;
  EXPECT_EQ(framesHealth({FramesVerdict::kWrong, "camera mounting turned"}).level, Health::kError);
  EXPECT_TRUE(says(framesHealth({FramesVerdict::kWrong, "camera mounting turned"}), "no approach"));
  EXPECT_EQ(framesHealth({FramesVerdict::kOpen, "no way flown"}).level, Health::kOk);
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
  EXPECT_EQ(consistencyHealth({40, 1.2, true}, {}).level, Health::kOk);
  EXPECT_EQ(consistencyHealth({40, 5.0, false}, {}).level, Health::kWarn);
}

}  // namespace
}  // namespace window_ingress::adapters
