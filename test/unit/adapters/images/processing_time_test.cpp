#include "adapters/images/processing_time.hpp"

#include <gtest/gtest.h>

namespace window_ingress::adapters::processing_time_test {

using detection::Stage;

double now_sec = 0.0;
double fakeClock() { return now_sec; }

class ImageTimesTest : public testing::Test {
 protected:
  void SetUp() override { now_sec = 1000.0; }

  // One image. Image number and clock advance by one image for each dropped one.
  void image(ProcessingTime& times, double edges_ms, int dropped = 0, double period_sec = 0.05) {
    header_.seq += 1 + dropped;
    header_.stamp += ros::Duration((1 + dropped) * 0.05);
    now_sec = due_sec_ += (1 + dropped) * period_sec;
    times.begin(header_, 2.0);
    now_sec += 1e-3 * edges_ms;
    times.timer().done(Stage::kEdges);
    now_sec += 1e-3;
    times.timer().done(Stage::kBorders);
    times.end();
  }
  static double value(const Health& health, const std::string& key) {
    for (const auto& [name, number] : health.values)
      if (name == key) return number;
    ADD_FAILURE() << key << " is not told";
    return -1.0;
  }
  std_msgs::Header header_;
  double due_sec_ = 1000.0;  // arrival time of the camera's last image
};

TEST_F(ImageTimesTest, StagesAreToldInMilliseconds) {
  ProcessingTime times(0.0, fakeClock);
  EXPECT_EQ(times.health().level, Health::kOk);
  for (int i = 0; i < 5; ++i) image(times, 7.0);
  const Health health = times.health();
  EXPECT_NEAR(value(health, "edges_ms"), 7.0, 1e-6);
  EXPECT_NEAR(value(health, "borders_ms"), 1.0, 1e-6);
  EXPECT_NEAR(value(health, "decode_ms"), 2.0, 1e-6);
  EXPECT_NEAR(value(health, "whole_ms"), 10.0, 1e-6);
  EXPECT_NEAR(value(health, "budget_ms"), 50.0, 1e-3) << "the time between two images";
  EXPECT_EQ(health.level, Health::kOk);
}

TEST_F(ImageTimesTest, MoreThanTheTimeBetweenImagesIsAWarning) {
  ProcessingTime times(0.0, fakeClock);
  for (int i = 0; i < 5; ++i) image(times, 120.0, 2);
  const Health health = times.health();
  EXPECT_EQ(health.level, Health::kWarn);
  EXPECT_NEAR(value(health, "budget_ms"), 50.0, 1e-3) << "dropped images count";
  EXPECT_NE(health.text.find("'edges' (120.0 ms)"), std::string::npos) << health.text;
  for (int i = 0; i < 40; ++i) image(times, 3.0);
  EXPECT_EQ(times.health().level, Health::kOk);
}

TEST_F(ImageTimesTest, ABudgetThatIsGivenCounts) {
  ProcessingTime times(5.0, fakeClock);
  image(times, 7.0);
  EXPECT_EQ(times.health().level, Health::kWarn);
}

TEST_F(ImageTimesTest, PausesAreNoPeriods) {
  ProcessingTime times(0.0, fakeClock);
  for (int i = 0; i < 3; ++i) image(times, 1.0);
  image(times, 1.0, 0, 60.0);
  image(times, 1.0);
  EXPECT_NEAR(value(times.health(), "budget_ms"), 50.0, 1e-3);
}

TEST_F(ImageTimesTest, ABagThatIsPlayedSlowlyHasMoreTimeForAnImageThanItsStampsSay) {
  ProcessingTime times(0.0, fakeClock);
  for (int i = 0; i < 5; ++i) image(times, 120.0, 0, 0.05 / 0.3);
  EXPECT_NEAR(value(times.health(), "budget_ms"), 50.0 / 0.3, 1e-3);
  EXPECT_EQ(times.health().level, Health::kOk);
}

TEST_F(ImageTimesTest, ACameraOfAnImageInThreeSecondsHasABudget) {
  ProcessingTime times(0.0, fakeClock);
  for (int i = 0; i < 5; ++i) image(times, 1.0, 0, 3.0);
  EXPECT_NEAR(value(times.health(), "budget_ms"), 3000.0, 1e-3);
}

}  // namespace window_ingress::adapters::processing_time_test
