#include "window_ingress/navigation/transition_table.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

namespace window_ingress::navigation::transition_table_test {

/// Name in the document.
const char* nameOf(Event event) {
  constexpr std::array<const char*, kEventCount> kNames{
      "start",       "window found", "aligned",     "misaligned", "commit reached", "commit criterion unmet",
      "crossed",     "other window", "window lost", "backed off", "reacquired",     "resumed",
      "input stale", "input fresh",  "give up",     "disengaged", "abort",          "reset"};
  return kNames.at(static_cast<std::size_t>(event));
}

constexpr bool isDeterministic() {
  for (std::size_t i = 0; i < kTransitions.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (kTransitions[i].from == kTransitions[j].from && kTransitions[i].event == kTransitions[j].event)
        return false;
    }
  }
  return true;
}

constexpr bool reachesEveryState() {
  bool reached[kStateCount] = {true};  // IDLE
  for (std::size_t pass = 0; pass < kStateCount; ++pass) {
    for (const auto& row : kTransitions) {
      if (reached[static_cast<std::size_t>(row.from)]) reached[static_cast<std::size_t>(row.to)] = true;
    }
  }
  for (const bool state : reached) {
    if (!state) return false;
  }
  return true;
}

constexpr bool leadsTo(State from, Event event, State to) {
  const auto state = next(from, event);
  return state.has_value() && *state == to;
}

constexpr bool everyLiveStateAborts() {
  for (std::size_t i = 0; i < kStateCount; ++i) {
    const auto state = static_cast<State>(i);
    if (!isEnd(state) && !leadsTo(state, Event::kAbort, State::kAborted)) return false;
  }
  return true;
}

constexpr bool everyMovingStateHoldsOnStaleInput() {
  for (std::size_t i = 0; i < kStateCount; ++i) {
    const auto state = static_cast<State>(i);
    if (isMoving(state) && !leadsTo(state, Event::kInputStale, State::kHold)) return false;
  }
  return true;
}

static_assert(isDeterministic(), "two rows for one state and event");
static_assert(reachesEveryState(), "a state that no row leads to");
static_assert(everyLiveStateAborts(), "a state that cannot be aborted");
static_assert(everyMovingStateHoldsOnStaleInput(), "a moving state that ignores stale input");

State stateAt(std::size_t i) { return static_cast<State>(i); }
Event eventAt(std::size_t i) { return static_cast<Event>(i); }

/// The mission's transitions, written independently of the table. Every other pair has no effect.
const std::set<std::string> kMission{
    "IDLE, start: SEARCH",
    "IDLE, abort: ABORTED",
    "SEARCH, window found: ALIGN",
    "SEARCH, input stale: HOLD",
    "SEARCH, give up: ABORTED",
    "SEARCH, disengaged: IDLE",
    "SEARCH, abort: ABORTED",
    "ALIGN, aligned: APPROACH",
    "ALIGN, other window: SEARCH",
    "ALIGN, input stale: HOLD",
    "ALIGN, give up: ABORTED",
    "ALIGN, disengaged: IDLE",
    "ALIGN, abort: ABORTED",
    "APPROACH, commit reached: COMMIT",
    "APPROACH, misaligned: ALIGN",
    "APPROACH, other window: SEARCH",
    "APPROACH, commit criterion unmet: BACK_OFF",
    "APPROACH, input stale: HOLD",
    "APPROACH, give up: ABORTED",
    "APPROACH, disengaged: IDLE",
    "APPROACH, abort: ABORTED",
    "COMMIT, crossed: PASSED",
    "COMMIT, commit criterion unmet: BACK_OFF",
    "COMMIT, input stale: HOLD",
    "COMMIT, give up: ABORTED",
    "COMMIT, disengaged: IDLE",
    "COMMIT, abort: ABORTED",
    "BACK_OFF, reacquired: ALIGN",
    "BACK_OFF, backed off: SEARCH",
    "BACK_OFF, input stale: HOLD",
    "BACK_OFF, give up: ABORTED",
    "BACK_OFF, disengaged: IDLE",
    "BACK_OFF, abort: ABORTED",
    "HOLD, reacquired: ALIGN",
    "HOLD, resumed: COMMIT",
    "HOLD, window lost: BACK_OFF",
    "HOLD, input fresh: SEARCH",
    "HOLD, give up: ABORTED",
    "HOLD, disengaged: IDLE",
    "HOLD, abort: ABORTED",
    "PASSED, reset: IDLE",
    "ABORTED, reset: IDLE",
};

TEST(TransitionTable, EveryPairLeadsWhereTheMissionSaysOrNowhere) {
  std::set<std::string> found;
  for (std::size_t s = 0; s < kStateCount; ++s) {
    for (std::size_t e = 0; e < kEventCount; ++e) {
      const auto to = next(stateAt(s), eventAt(e));
      if (to)
        found.insert(std::string(toString(stateAt(s))) + ", " + nameOf(eventAt(e)) + ": " + toString(*to));
    }
  }
  EXPECT_EQ(found, kMission);
  EXPECT_EQ(kTransitions.size(), kMission.size());
}

TEST(TransitionTable, NamesAreThoseOfTheInterfaceAndUnique) {
  const std::set<std::string> expected{"IDLE",   "SEARCH",   "ALIGN", "APPROACH", "COMMIT",
                                       "PASSED", "BACK_OFF", "HOLD",  "ABORTED"};
  std::set<std::string> states, events;
  for (std::size_t s = 0; s < kStateCount; ++s) states.insert(toString(stateAt(s)));
  for (std::size_t e = 0; e < kEventCount; ++e) events.insert(nameOf(eventAt(e)));
  EXPECT_EQ(states, expected);
  EXPECT_EQ(events.size(), kEventCount);
  EXPECT_STREQ(toString(static_cast<State>(kStateCount)), "UNKNOWN");
}

TEST(TransitionTable, CommitIsEnteredOnlyByTheContract) {
  for (const auto& row : kTransitions) {
    if (row.to != State::kCommit) continue;
    EXPECT_TRUE(row.event == Event::kCommitReached || row.event == Event::kResumed);
  }
}

TEST(TransitionTable, PassedIsEnteredOnlyByCrossing) {
  for (const auto& row : kTransitions) {
    if (row.to == State::kPassed) {
      EXPECT_EQ(row.from, State::kCommit);
      EXPECT_EQ(row.event, Event::kCrossed);
    }
  }
}

TEST(TransitionTable, EndsAreLeftOnlyByReset) {
  for (const auto& row : kTransitions) {
    if (isEnd(row.from)) {
      EXPECT_EQ(row.event, Event::kReset);
      EXPECT_EQ(row.to, State::kIdle);
    }
  }
}

TEST(TransitionTable, EveryLiveStateYieldsToThePilot) {
  for (std::size_t s = 0; s < kStateCount; ++s) {
    if (!isMoving(stateAt(s)) && stateAt(s) != State::kHold) continue;
    EXPECT_EQ(next(stateAt(s), Event::kDisengaged), State::kIdle);
    EXPECT_EQ(next(stateAt(s), Event::kGiveUp), State::kAborted);
  }
}

/// Events that lead to the same state from almost everywhere: in the table, not in the diagram.
bool isEverywhere(Event event) {
  return event == Event::kAbort || event == Event::kGiveUp || event == Event::kDisengaged;
}

void drawDiagram(std::ostringstream& text) {
  text << "```mermaid\nstateDiagram-v2\n    [*] --> IDLE\n";
  for (const auto& row : kTransitions) {
    if (isEverywhere(row.event)) continue;
    text << "    " << toString(row.from) << " --> " << toString(row.to) << ": " << nameOf(row.event) << "\n";
  }
  text << "```\n";
}

void writeRows(std::ostringstream& text) {
  text << "| from | event | to |\n|---|---|---|\n";
  for (const auto& row : kTransitions) {
    text << "| " << toString(row.from) << " | " << nameOf(row.event) << " | " << toString(row.to) << " |\n";
  }
}

const std::string kHeading = "## State machine\n";

/// The diagram (Mermaid) and the table of events, as in the last section of doc/navigation.md.
std::string stateMachineSection() {
  std::ostringstream text;
  text << kHeading
       << "\nGenerated from `include/window_ingress/navigation/transition_table.hpp`; a unit test compares "
          "this section with the table\n(`WINDOW_INGRESS_UPDATE_DOC=1 unit_navigation "
          "--gtest_filter='*DocumentIsUpToDate'` writes it anew).\n\n"
          "Left out of the diagram, but in the table: *abort* and *give up* lead to ABORTED, *disengaged* to "
          "IDLE.\n\n";
  drawDiagram(text);
  text << "\n";
  writeRows(text);
  return text.str();
}

TEST(TransitionTable, DocumentIsUpToDate) {
  const std::string file = WINDOW_INGRESS_SOURCE_DIR "/doc/navigation.md";
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  const std::string page = text.str();
  const std::size_t begin = page.find(kHeading);
  ASSERT_NE(begin, std::string::npos);
  if (std::getenv("WINDOW_INGRESS_UPDATE_DOC"))
    std::ofstream(file) << page.substr(0, begin) << stateMachineSection();
  else
    EXPECT_EQ(page.substr(begin), stateMachineSection()) << "doc/navigation.md differs from the table";
}

}  // namespace window_ingress::navigation::transition_table_test
