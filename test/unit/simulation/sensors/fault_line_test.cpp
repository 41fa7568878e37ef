#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "simulation/random_stream.hpp"
#include "simulation/sensors/faults.hpp"

namespace window_ingress::simulation::fault_line_test {

constexpr double kStepSec = 0.01;

struct Sample {
  double stamp_sec = 0.0;
  int value = 0;
};

struct Traits {
  Sample repeat(const Sample& old, const Sample& fresh) const { return {fresh.stamp_sec, old.value}; }
  void spoil(Sample& sample, const FaultParams& fault) const {
    sample.value = fault.kind == "wrong" ? -sample.value : 0;
  }
};

struct Arrival {
  double at_sec = 0.0;
  Sample sample;
};

FaultParams fault(const std::string& kind, double at_sec, double duration_sec) {
  FaultParams params;
  params.kind = kind;
  params.at_sec = at_sec;
  params.duration_sec = duration_sec;
  return params;
}

// One sample every 10 ms for `until_sec`; its value counts from 1.
std::vector<Arrival> run(const FaultParams& params, double until_sec) {
  FaultLine<Sample, Traits> line;
  std::vector<Arrival> arrivals;
  for (int i = 1; i * kStepSec < until_sec; ++i) {
    const double now_sec = i * kStepSec;
    const bool acts = now_sec + 1e-9 >= params.at_sec && now_sec + 1e-9 < params.at_sec + params.duration_sec;
    line.put(now_sec, {now_sec, i}, acts ? &params : nullptr);
    while (const auto sample = line.take(now_sec, acts ? &params : nullptr))
      arrivals.push_back({now_sec, *sample});
  }
  return arrivals;
}

std::vector<Arrival> within(const std::vector<Arrival>& all, double from_sec, double to_sec) {
  std::vector<Arrival> some;
  for (const auto& one : all)
    if (one.at_sec + 1e-9 >= from_sec && one.at_sec + 1e-9 < to_sec) some.push_back(one);
  return some;
}

TEST(FaultLine, BeforeAndAfterAFaultNothingIsTouchedAndOrderIsKeptWhateverItIs) {
  RandomStream random(1, "fault line test");
  for (int trial = 0; trial < 100; ++trial) {
    for (const char* kind : {"off", "stuck", "garbage", "wrong", "slow", "delayed", "intermittent"}) {
      const FaultParams params = fault(kind, random.uniform(0.1, 3.0), random.uniform(0.02, 3.0));
      const auto all = run(params, 8.0);
      const double end_sec = params.at_sec + params.duration_sec;
      for (const auto& range : {std::make_pair(0.0, params.at_sec), std::make_pair(end_sec, 8.0)}) {
        const auto untouched = within(all, range.first, range.second);
        ASSERT_NEAR(untouched.size(), (range.second - range.first) / kStepSec, 1.01) << kind;
        for (const auto& one : untouched) {
          ASSERT_EQ(one.sample.stamp_sec, one.at_sec) << kind;
          ASSERT_EQ(one.sample.value, std::lround(one.at_sec / kStepSec)) << kind;
        }
      }
      for (std::size_t i = 1; i < all.size(); ++i)
        ASSERT_GT(all[i].sample.stamp_sec, all[i - 1].sample.stamp_sec) << kind;
    }
  }
}

TEST(FaultLine, OffIsNothing) { EXPECT_TRUE(within(run(fault("off", 1, 2), 4), 1, 3).empty()); }

TEST(FaultLine, StuckRepeatsTheLastGoodWithNewStamps) {
  const auto during = within(run(fault("stuck", 1, 2), 4), 1, 3);
  ASSERT_EQ(during.size(), 200u);
  for (const auto& one : during) {
    EXPECT_EQ(one.sample.value, 99);
    EXPECT_EQ(one.sample.stamp_sec, one.at_sec);
  }
}

TEST(FaultLine, StuckFromTheStartRepeatsTheFirst) {
  const auto during = within(run(fault("stuck", 0, 2), 4), 0, 2);
  ASSERT_EQ(during.size(), 199u);
  for (const auto& one : during) EXPECT_EQ(one.sample.value, 1);
}

TEST(FaultLine, GarbageAndWrongSpoilEachSample) {
  for (const auto& one : within(run(fault("garbage", 1, 2), 4), 1, 3)) EXPECT_EQ(one.sample.value, 0);
  for (const auto& one : within(run(fault("wrong", 1, 2), 4), 1, 3)) EXPECT_LT(one.sample.value, 0);
}

TEST(FaultLine, SlowHasItsRate) {
  FaultParams params = fault("slow", 1, 2);
  params.rate_hz = 4.0;
  const auto during = within(run(params, 4), 1, 3);
  ASSERT_EQ(during.size(), 8u);
  for (std::size_t i = 1; i < during.size(); ++i)
    EXPECT_NEAR(during[i].at_sec - during[i - 1].at_sec, 0.25, 1e-9);
}

TEST(FaultLine, DelayedComesLaterWithItsOwnStampAndWhatIsOnTheWayAtTheEndIsLost) {
  FaultParams params = fault("delayed", 1, 2);
  params.delay_sec = 0.5;
  const auto during = within(run(params, 4), 1, 3);
  ASSERT_EQ(during.size(), 150u);
  for (const auto& one : during) EXPECT_NEAR(one.at_sec - one.sample.stamp_sec, 0.5, 1e-9);
}

TEST(FaultLine, IntermittentGoesAndComes) {
  FaultParams params = fault("intermittent", 1, 2);
  params.off_sec = 0.3;
  params.on_sec = 0.2;
  const auto all = run(params, 4);
  for (int period = 0; period < 4; ++period) {
    EXPECT_TRUE(within(all, 1 + 0.5 * period, 1.3 + 0.5 * period).empty()) << period;
    EXPECT_EQ(within(all, 1.3 + 0.5 * period, 1.5 + 0.5 * period).size(), 20u) << period;
  }
}

TEST(FaultLine, WhatNobodyTakesIsForgotten) {
  FaultLine<Sample, Traits> line;
  for (int i = 0; i < 5000; ++i) line.put(i, {0.0, i}, nullptr);
  int count = 0, last = 0;
  while (const auto sample = line.take(5000.0, nullptr)) {
    ++count;
    last = sample->value;
  }
  EXPECT_EQ(count, 1000);
  EXPECT_EQ(last, 4999);
}

}  // namespace window_ingress::simulation::fault_line_test
