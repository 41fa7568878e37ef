#include "evaluation/openness/openness_survey.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "simulation/scenario/scenario.hpp"

namespace window_ingress::evaluation::openness_survey_test {

using openness::Openness;

OpennessResult approach(const std::string& closed_by, std::uint32_t seed) {
  simulation::Scenario scenario;
  scenario.window.closed_by = closed_by;
  scenario.house.furniture = "full";
  scenario.house.room_texture = "brick";
  scenario.camera.noise_grey = 2.0;
  return flyDrawn(scenario, seed, {}, {}, {});
}

TEST(OpennessSurvey, ADrawnRoomIsOpenInTime) {
  for (const std::uint32_t seed : {1u, 2u}) {
    const OpennessResult room = approach("none", seed);
    EXPECT_EQ(room.kind, "room");
    EXPECT_TRUE(room.is_open);
    EXPECT_EQ(room.at_decision.openness, Openness::kOpen) << room.at_decision.reason;
    EXPECT_FALSE(room.ever_closed);
    EXPECT_GT(room.open_from_m, OpennessRange().decide_m);
  }
}

TEST(OpennessSurvey, WhatClosesADrawnWindowIsNeverCalledOpen) {
  for (const std::string closed_by : {"curtain", "shutter", "tinted_glass"}) {
    const OpennessResult closed = approach(closed_by, 4);
    EXPECT_EQ(closed.kind, closed_by);
    EXPECT_FALSE(closed.is_open);
    EXPECT_FALSE(closed.ever_open) << closed_by;
    EXPECT_EQ(closed.at_decision.openness, Openness::kClosed)
        << closed_by << ": " << closed.at_decision.reason;
  }
}

TEST(OpennessSurvey, TheTableCountsEveryMomentAtWhichAClosedOneWasCalledOpen) {
  OpennessTable table;
  OpennessResult result;
  result.kind = "board", result.ever_open = true, result.open_from_m = 2.5;
  table.add(result);
  result.ever_open = false, result.at_decision.openness = Openness::kClosed;
  table.add(result);
  result.kind = "room", result.is_open = result.ever_open = true,
  result.at_decision.openness = Openness::kOpen;
  table.add(result);
  EXPECT_EQ(table.falseOpen(), 1);
  const std::string text = table.markdown();
  EXPECT_NE(text.find("| board | not open | 2 | 0 ("), std::string::npos) << text;
  EXPECT_NE(text.find("| room | open | 1 | 1 ("), std::string::npos) << text;
}

TEST(OpennessSurvey, ARowHasAsManyFieldsAsTheHeader) {
  OpennessResult result;
  result.at_decision.reason = "nothing";
  const std::string header = opennessColumns(), row = opennessRow(result);
  EXPECT_EQ(std::count(row.begin(), row.end(), ','), std::count(header.begin(), header.end(), ','));
}

}  // namespace window_ingress::evaluation::openness_survey_test
