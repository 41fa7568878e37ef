#include "adapters/world/world_lockstep.hpp"

#include <gtest/gtest.h>

#include "refusal.hpp"

namespace window_ingress::adapters::world_lockstep_test {

std::string refusalOf(const simulation::Scenario& scenario) {
  return test::refusalOf([&] { refuseInLockstep(scenario); });
}

TEST(WorldLockstep, RefusesWhatNobodyDoesThere) {
  simulation::Scenario scenario;
  EXPECT_EQ(refusalOf(scenario), "");
  scenario.target_chosen = true;
  EXPECT_TRUE(test::says(refusalOf(scenario), "target_chosen")) << "nobody points at the target";
  scenario.target_chosen = false;
  scenario.faults.emplace_back().unit = "clock";
  EXPECT_TRUE(test::says(refusalOf(scenario), "clock"));
}

}  // namespace window_ingress::adapters::world_lockstep_test
