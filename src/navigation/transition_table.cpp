#include "window_ingress/navigation/transition_table.hpp"

#include <sstream>

namespace window_ingress::navigation {

const char* toString(State state) {
  switch (state) {
    case State::kIdle:
      return "IDLE";
    case State::kSearch:
      return "SEARCH";
    case State::kAlign:
      return "ALIGN";
    case State::kApproach:
      return "APPROACH";
    case State::kCommit:
      return "COMMIT";
    case State::kPassed:
      return "PASSED";
    case State::kBackOff:
      return "BACK_OFF";
    case State::kHold:
      return "HOLD";
    case State::kAborted:
      return "ABORTED";
  }
  return "UNKNOWN";
}

const char* toString(Event event) {
  switch (event) {
    case Event::kStart:
      return "start";
    case Event::kWindowFound:
      return "window found";
    case Event::kAligned:
      return "aligned";
    case Event::kMisaligned:
      return "misaligned";
    case Event::kCommitReached:
      return "commit reached";
    case Event::kContractUnmet:
      return "commit criterion unmet";
    case Event::kCrossed:
      return "crossed";
    case Event::kOtherWindow:
      return "other window";
    case Event::kWindowLost:
      return "window lost";
    case Event::kBackedOff:
      return "backed off";
    case Event::kReacquired:
      return "reacquired";
    case Event::kResumed:
      return "resumed";
    case Event::kInputStale:
      return "input stale";
    case Event::kInputFresh:
      return "input fresh";
    case Event::kGiveUp:
      return "give up";
    case Event::kDisengaged:
      return "disengaged";
    case Event::kAbort:
      return "abort";
    case Event::kReset:
      return "reset";
  }
  return "unknown";
}

namespace {

/// Events that lead to the same state from nearly everywhere: in the table, not in the image.
bool isEverywhere(Event event) {
  return event == Event::kAbort || event == Event::kGiveUp || event == Event::kDisengaged;
}

void drawDiagram(std::ostringstream& text) {
  text << "```mermaid\nstateDiagram-v2\n    [*] --> IDLE\n";
  for (const auto& row : kTransitions) {
    if (isEverywhere(row.event)) continue;
    text << "    " << toString(row.from) << " --> " << toString(row.to) << ": " << toString(row.event)
         << "\n";
  }
  text << "```\n";
}

void writeRows(std::ostringstream& text) {
  text << "| from | event | to |\n|---|---|---|\n";
  for (const auto& row : kTransitions) {
    text << "| " << toString(row.from) << " | " << toString(row.event) << " | " << toString(row.to) << " |\n";
  }
}

}  // namespace

std::string stateMachineDocument() {
  std::ostringstream text;
  text << "# State machine of the navigator\n\n"
          "Generated from `include/window_ingress/navigation/transition_table.hpp`; a unit test compares "
          "this file "
          "with the table\n(`WINDOW_INGRESS_UPDATE_DOC=1 unit_navigation "
          "--gtest_filter='*DocumentIsUpToDate'` "
          "writes it anew).\n\n"
          "Left out of the picture, but in the table: *abort* and *give up* lead to ABORTED, *disengaged* to "
          "IDLE.\n\n";
  drawDiagram(text);
  text << "\n";
  writeRows(text);
  return text.str();
}

}  // namespace window_ingress::navigation
