#include "window_ingress/configuration/overlay.hpp"

#include "window_ingress/parameters/yaml.hpp"

namespace window_ingress::configuration {

estimation::TargetEstimatorParams forVehicle(estimation::TargetEstimatorParams params,
                                             const navigation::VehicleParams& vehicle) {
  params.fit.vehicle_width_m = 2.0 * vehicle.half_width_m;
  params.fit.vehicle_height_m = 2.0 * vehicle.half_height_m;
  return params;
}

Overlay readOverlay(const std::string& file) {
  Overlay overlay;
  if (!file.empty()) overlay.said = parameters::readYamlFile(file, overlay);
  overlay.ingress_navigator.navigator.vehicle = overlay.vehicle;
  overlay.homography_pose.tracker = forVehicle(overlay.homography_pose.tracker, overlay.vehicle);
  return overlay;
}

}  // namespace window_ingress::configuration
