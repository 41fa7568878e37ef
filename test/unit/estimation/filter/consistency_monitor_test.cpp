#include "window_ingress/estimation/consistency_monitor.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace window_ingress::estimation::consistency_monitor_test {

double chiSquared(int degrees_of_freedom, std::mt19937& random) {
  std::normal_distribution<double> normal(0.0, 1.0);
  double sum = 0.0;
  for (int i = 0; i < degrees_of_freedom; ++i) sum += std::pow(normal(random), 2);
  return sum;
}

TEST(ConsistencyMonitor, MeansOneADegreeOfFreedom) {
  std::mt19937 random(1);
  ConsistencyMonitor monitor;
  for (int i = 0; i < 500; ++i) {
    const int degrees = i % 2 == 0 ? 8 : 4;
    monitor.add(chiSquared(degrees, random), degrees);
  }
  EXPECT_EQ(monitor.consistency().images, ConsistencyMonitor::kImages);
  EXPECT_NEAR(monitor.consistency().mean_nis, 1.0, 0.25);
  EXPECT_TRUE(monitor.consistency().consistent);
}

TEST(ConsistencyMonitor, NamesNoiseTwiceAsLargeAsStatedAndForgetsIt) {
  std::mt19937 random(2);
  ConsistencyMonitor monitor;
  for (int i = 0; i < 50; ++i) monitor.add(4.0 * chiSquared(8, random), 8);
  EXPECT_FALSE(monitor.consistency().consistent);
  for (int i = 0; i < 50; ++i) monitor.add(chiSquared(8, random), 8);
  EXPECT_TRUE(monitor.consistency().consistent);
}

TEST(ConsistencyMonitor, JudgesNothingByAFewImages) {
  ConsistencyMonitor monitor;
  EXPECT_TRUE(monitor.consistency().consistent);
  EXPECT_EQ(monitor.consistency().mean_nis, 0.0);
  for (int i = 0; i < 20; ++i) monitor.add(100.0, 8);
  EXPECT_TRUE(monitor.consistency().consistent);
  for (int i = 0; i < 5; ++i) monitor.add(100.0, 8);
  EXPECT_FALSE(monitor.consistency().consistent);
  monitor.clear();
  EXPECT_EQ(monitor.consistency().images, 0);
}

TEST(ConsistencyMonitor, ManyRefusedImagesContradictWhateverTheOthersSay) {
  ConsistencyMonitor monitor;
  const auto see = [&](int accepted, int refused) {
    for (int i = 0; i < accepted; ++i) monitor.add(8.0, 8);
    for (int i = 0; i < refused; ++i) monitor.refuse();
  };
  see(0, 20);
  EXPECT_FALSE(monitor.consistency().contradicted) << "too few to say";
  see(0, 5);
  EXPECT_TRUE(monitor.consistency().contradicted);
  EXPECT_TRUE(monitor.consistency().consistent);
  see(40, 10);
  EXPECT_FALSE(monitor.consistency().contradicted);
  see(25, 25);
  EXPECT_TRUE(monitor.consistency().contradicted);
  EXPECT_EQ(monitor.consistency().images, 25);
  EXPECT_EQ(monitor.consistency().refused, 25);
  EXPECT_NEAR(monitor.consistency().mean_nis, 1.0, 1e-12);
}

TEST(ConsistencyMonitor, IgnoresWhatIsNoSquare) {
  ConsistencyMonitor monitor;
  monitor.add(std::numeric_limits<double>::quiet_NaN(), 8);
  monitor.add(std::numeric_limits<double>::infinity(), 8);
  monitor.add(-1.0, 8);
  monitor.add(1.0, 0);
  EXPECT_EQ(monitor.consistency().images, 0);
}

}  // namespace window_ingress::estimation::consistency_monitor_test
