#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::simulation {

/// A scenario file that cannot be used: `what()` is one line "file:line: key: what is wrong; what to do".
class ScenarioError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace window_ingress::simulation
