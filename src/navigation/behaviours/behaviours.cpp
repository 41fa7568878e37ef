#include "navigation/behaviours/align.hpp"
#include "navigation/behaviours/approach.hpp"
#include "navigation/behaviours/back_off.hpp"
#include "navigation/behaviours/commit.hpp"
#include "navigation/behaviours/hold.hpp"
#include "navigation/behaviours/search.hpp"

namespace window_ingress::navigation {

std::unique_ptr<Behaviour> behaviourOf(State state, State from, double now_sec, bool may_climb,
                                       const NavigatorParams& params) {
  if (state == State::kSearch) return std::make_unique<Search>(params, may_climb);
  if (state == State::kAlign) return std::make_unique<Align>(params, now_sec);
  if (state == State::kApproach) return std::make_unique<Approach>(params);
  if (state == State::kCommit) return std::make_unique<Commit>(params);
  if (state == State::kBackOff) return std::make_unique<BackOff>(params);
  if (state == State::kHold) return std::make_unique<Hold>(params, from);
  return nullptr;
}

}  // namespace window_ingress::navigation
