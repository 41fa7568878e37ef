#include "window_ingress/navigation/transition_table.hpp"

namespace window_ingress::navigation {

const char* toString(State state) {
  static constexpr std::array<const char*, kStateCount> kNames{
      "IDLE", "SEARCH", "ALIGN", "APPROACH", "COMMIT", "PASSED", "BACK_OFF", "HOLD", "ABORTED"};
  const auto at = static_cast<std::size_t>(state);
  return at < kNames.size() ? kNames[at] : "UNKNOWN";
}

const char* toString(Event event) {
  static constexpr std::array<const char*, kEventCount> kNames{
      "start",       "window found", "aligned",     "misaligned", "commit reached", "commit criterion unmet",
      "crossed",     "other window", "window lost", "backed off", "reacquired",     "resumed",
      "input stale", "input fresh",  "give up",     "disengaged", "abort",          "reset"};
  const auto at = static_cast<std::size_t>(event);
  return at < kNames.size() ? kNames[at] : "unknown";
}

}  // namespace window_ingress::navigation
