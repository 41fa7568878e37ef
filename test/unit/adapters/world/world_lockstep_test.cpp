#include "adapters/world/world_lockstep.hpp"

#include <gtest/gtest.h>

namespace window_ingress::adapters::world_lockstep_test {

std::string refusalOf(const simulation::Scenario& scenario) {
  try {
    refuseInLockstep(scenario);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(WorldLockstep, RefusesWhatNobodyDoesThere) {
  simulation::Scenario scenario;
  EXPECT_EQ(refusalOf(scenario), "");
  scenario.target_chosen = true;
  EXPECT_NE(refusalOf(scenario).find("target_chosen"), std::string::npos) << "nobody points at the target";
  scenario.target_chosen = false;
  scenario.faults.emplace_back().unit = "clock";
  EXPECT_NE(refusalOf(scenario).find("clock"), std::string::npos);
}

}  // namespace window_ingress::adapters::world_lockstep_test
