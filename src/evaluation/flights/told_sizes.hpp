/// Sizes that the operator of a simulated flight would measure and give.
#pragma once

#include "simulation/scenario/scenario.hpp"
#include "window_ingress/configuration/overlay.hpp"

namespace window_ingress::evaluation {

/// Sets the sizes of vehicle and opening to the scenario's, except those that the user's file gives. An
/// opening whose size is to be estimated in flight keeps its values.
inline void tellSizes(const simulation::Scenario& scenario, const configuration::Overlay& file,
                      navigation::VehicleParams& vehicle, estimation::PoseParams& pose) {
  const auto tell = [&](const char* key, double& value, double fact) {
    if (!file.gives(key)) value = fact;
  };
  const Eigen::Vector3d half = scenario.vehicle.halfExtents();
  tell("vehicle/half_length_m", vehicle.half_length_m, half.x());
  tell("vehicle/half_width_m", vehicle.half_width_m, half.y());
  tell("vehicle/half_height_m", vehicle.half_height_m, half.z());
  if (pose.scale_sigma > 0.0 || pose.aspect_sigma > 0.0) return;
  tell("homography_pose/pose/opening_width_m", pose.opening_width_m, scenario.opening().width_m);
  tell("homography_pose/pose/opening_height_m", pose.opening_height_m, scenario.opening().height_m);
}

}  // namespace window_ingress::evaluation
