#include "window_ingress/simulation/referee.hpp"

namespace window_ingress::simulation {

const char* toString(Outcome outcome) {
  switch (outcome) {
    case Outcome::kRunning: return "RUNNING";
    case Outcome::kPassed: return "PASSED";
    case Outcome::kCollision: return "COLLISION";
    case Outcome::kFalseIngress: return "FALSE_INGRESS";
    case Outcome::kAborted: return "ABORTED";
    case Outcome::kTimeout: return "TIMEOUT";
  }
  return "UNKNOWN";
}

}  // namespace window_ingress::simulation
