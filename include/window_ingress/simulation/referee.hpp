#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>

namespace window_ingress::simulation {

/// How a flight ended. FALSE_INGRESS: the vehicle claims to have passed and has not.
enum class Outcome { kRunning, kPassed, kCollision, kFalseIngress, kAborted, kTimeout };

const char* toString(Outcome outcome);

}  // namespace window_ingress::simulation
