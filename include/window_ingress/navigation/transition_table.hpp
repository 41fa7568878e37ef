/// The mission's state machine as data: states, events, transitions. No guards, no times: the
/// sender of an event checks its conditions, the table only says where it leads.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

namespace window_ingress::navigation {

enum class State { kIdle, kSearch, kAlign, kApproach, kCommit, kPassed, kBackOff, kHold, kAborted };
inline constexpr std::size_t kStateCount = 9;

enum class Event {
  kStart,           ///< the operator asks for the flight and all start conditions hold
  kWindowFound,     ///< the target was seen often enough
  kAligned,         ///< normal trusted and the vehicle within the funnel
  kMisaligned,      ///< out of the funnel, or the normal no longer trusted
  kCommitReached,   ///< the window is about to leave the view and the commit criterion holds
  kCriterionUnmet,  ///< close to the window, and the predicted miss exceeds the clearance
  kCrossed,         ///< behind the window, standing still
  kOtherWindow,     ///< the flight has shown that this is another window, or that it is closed
  kWindowLost,      ///< not seen for long, but its normal is known
  kBackedOff,       ///< far enough away, the window still not in view
  kReacquired,      ///< seen again
  kResumed,         ///< inputs are back during a commit whose criterion still holds
  kInputStale,      ///< an input that this state needs is old, missing, not finite or has jumped
  kInputFresh,      ///< inputs are back, no window known
  kGiveUp,          ///< time-out, retries used up, nothing left to search, opening too small
  kDisengaged,      ///< pilot or autopilot took the vehicle over
  kAbort,           ///< the operator asks for the end
  kReset            ///< the operator acknowledges the end
};
inline constexpr std::size_t kEventCount = 18;

inline const char* toString(State state) {
  constexpr std::array<const char*, kStateCount> kNames{"IDLE",   "SEARCH",   "ALIGN", "APPROACH", "COMMIT",
                                                        "PASSED", "BACK_OFF", "HOLD",  "ABORTED"};
  const auto at = static_cast<std::size_t>(state);
  return at < kNames.size() ? kNames[at] : "UNKNOWN";
}

struct Transition {
  State from;
  Event event;
  State to;
};

inline constexpr std::array kTransitions = {
    Transition{State::kIdle, Event::kStart, State::kSearch},
    Transition{State::kIdle, Event::kAbort, State::kAborted},

    Transition{State::kSearch, Event::kWindowFound, State::kAlign},
    Transition{State::kSearch, Event::kInputStale, State::kHold},
    Transition{State::kSearch, Event::kGiveUp, State::kAborted},
    Transition{State::kSearch, Event::kDisengaged, State::kIdle},
    Transition{State::kSearch, Event::kAbort, State::kAborted},

    Transition{State::kAlign, Event::kAligned, State::kApproach},
    Transition{State::kAlign, Event::kOtherWindow, State::kSearch},
    Transition{State::kAlign, Event::kInputStale, State::kHold},
    Transition{State::kAlign, Event::kGiveUp, State::kAborted},
    Transition{State::kAlign, Event::kDisengaged, State::kIdle},
    Transition{State::kAlign, Event::kAbort, State::kAborted},

    Transition{State::kApproach, Event::kCommitReached, State::kCommit},
    Transition{State::kApproach, Event::kMisaligned, State::kAlign},
    Transition{State::kApproach, Event::kOtherWindow, State::kSearch},
    Transition{State::kApproach, Event::kCriterionUnmet, State::kBackOff},
    Transition{State::kApproach, Event::kInputStale, State::kHold},
    Transition{State::kApproach, Event::kGiveUp, State::kAborted},
    Transition{State::kApproach, Event::kDisengaged, State::kIdle},
    Transition{State::kApproach, Event::kAbort, State::kAborted},

    Transition{State::kCommit, Event::kCrossed, State::kPassed},
    Transition{State::kCommit, Event::kCriterionUnmet, State::kBackOff},
    Transition{State::kCommit, Event::kInputStale, State::kHold},
    Transition{State::kCommit, Event::kGiveUp, State::kAborted},
    Transition{State::kCommit, Event::kDisengaged, State::kIdle},
    Transition{State::kCommit, Event::kAbort, State::kAborted},

    Transition{State::kBackOff, Event::kReacquired, State::kAlign},
    Transition{State::kBackOff, Event::kBackedOff, State::kSearch},
    Transition{State::kBackOff, Event::kInputStale, State::kHold},
    Transition{State::kBackOff, Event::kGiveUp, State::kAborted},
    Transition{State::kBackOff, Event::kDisengaged, State::kIdle},
    Transition{State::kBackOff, Event::kAbort, State::kAborted},

    Transition{State::kHold, Event::kReacquired, State::kAlign},
    Transition{State::kHold, Event::kResumed, State::kCommit},
    Transition{State::kHold, Event::kWindowLost, State::kBackOff},
    Transition{State::kHold, Event::kInputFresh, State::kSearch},
    Transition{State::kHold, Event::kGiveUp, State::kAborted},
    Transition{State::kHold, Event::kDisengaged, State::kIdle},
    Transition{State::kHold, Event::kAbort, State::kAborted},

    Transition{State::kPassed, Event::kReset, State::kIdle},
    Transition{State::kAborted, Event::kReset, State::kIdle},
};

/// Where the event leads from this state; nothing if it means nothing there.
constexpr std::optional<State> next(State state, Event event) {
  for (const auto& row : kTransitions)
    if (row.from == state && row.event == event) return row.to;
  return std::nullopt;
}

/// The mission is over; only a reset leads on.
constexpr bool isEnd(State state) { return state == State::kPassed || state == State::kAborted; }

/// The vehicle may be commanded to move to another place.
constexpr bool isMoving(State state) {
  return state == State::kSearch || state == State::kAlign || state == State::kApproach ||
         state == State::kCommit || state == State::kBackOff;
}

/// The vehicle may be given a velocity, even if only to hold its position.
constexpr bool mayHaveVelocity(State state) {
  return isMoving(state) || state == State::kHold || state == State::kPassed;
}

}  // namespace window_ingress::navigation
