#include "evaluation/flights/campaign.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>

namespace window_ingress::evaluation::campaign_test {

using Seeds = std::vector<std::uint32_t>;

TEST(SeedsText, IsWhatParsesBack) {
  EXPECT_EQ(seedsText({}), "");
  EXPECT_EQ(seedsText({7}), "7");
  EXPECT_EQ(seedsText(*parseSeeds("1..20")), "1..20");
  EXPECT_EQ(seedsText({1, 2, 3, 9, 12, 13}), "1..3, 9, 12..13");
}

TEST(Seeds, AreARangeOrOneNumber) {
  EXPECT_EQ(parseSeeds("3..6"), (Seeds{3, 4, 5, 6}));
  EXPECT_EQ(parseSeeds("7"), (Seeds{7}));
  for (const char* bad :
       {"", "..", "3..", "..3", "6..3", "3..x", "-1..2", "1.5", "1...3", " 1", "0..99999999999"}) {
    EXPECT_FALSE(parseSeeds(bad)) << bad;
  }
}

TEST(Shards, TogetherAreAllSeedsOnce) {
  const Seeds seeds = *parseSeeds("1..10");
  EXPECT_EQ(shardOf(seeds, "2/3"), (Seeds{2, 5, 8}));
  std::size_t count = 0;
  for (const char* shard : {"1/3", "2/3", "3/3"}) count += shardOf(seeds, shard)->size();
  EXPECT_EQ(count, seeds.size());
  for (const char* bad : {"", "1", "0/3", "4/3", "1/0", "a/b", "1/"})
    EXPECT_FALSE(shardOf(seeds, bad)) << bad;
}

TEST(Campaign, ReportsInOrderWhateverTheJobs) {
  for (const int jobs : {1, 2, 7}) {
    Seeds reported;
    flyAll(
        *parseSeeds("1..50"), jobs,
        [](std::uint32_t seed) {
          for (std::uint32_t i = 0; i < (seed * 7919) % 13; ++i) std::this_thread::yield();
          FlightResult flight;
          flight.seed = seed;
          return flight;
        },
        [&](const FlightResult& flight, int done, int total) {
          reported.push_back(flight.seed);
          EXPECT_EQ(done, static_cast<int>(reported.size()));
          EXPECT_EQ(total, 50);
        });
    EXPECT_EQ(reported, *parseSeeds("1..50"));
  }
}

TEST(Campaign, PassesTheFirstFailureOnAndStops) {
  std::atomic<int> flown{0};
  const auto fly = [&](std::uint32_t seed) -> FlightResult {
    ++flown;
    if (seed == 3) throw std::runtime_error("no renderer");
    return {};
  };
  for (const int jobs : {1, 2}) {
    EXPECT_THROW(flyAll(*parseSeeds("1..1000"), jobs, fly, [](const FlightResult&, int, int) {}),
                 std::runtime_error);
  }
  EXPECT_LT(flown, 2000);
  flyAll({}, 4, fly, [](const FlightResult&, int, int) { FAIL(); });
}

}  // namespace window_ingress::evaluation::campaign_test
