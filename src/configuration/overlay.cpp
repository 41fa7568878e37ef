#include "window_ingress/configuration/overlay.hpp"

#include "window_ingress/parameters/yaml.hpp"

namespace window_ingress::configuration {

geometry::OpeningSize neededBy(const navigation::VehicleParams& vehicle) {
  return {2.0 * vehicle.half_width_m + 2.0 * vehicle.margin_m,
          2.0 * vehicle.half_height_m + 2.0 * vehicle.margin_m};
}

PoseNodeParams forVehicle(PoseNodeParams params, const navigation::VehicleParams& vehicle) {
  params.filter.systematic_sigma_px = params.pose.systematic_sigma_px;
  params.filter.drift_m_per_sqrt_sec = params.tracker.facade.odom_drift_m_per_sqrt_sec =
      vehicle.odom_drift_m_per_sqrt_sec;
  params.tracker.needed = neededBy(vehicle);
  return params;
}

Overlay readOverlay(const std::string& file, Overlay overlay) {
  overlay.given.clear();
  if (!file.empty()) overlay.given = parameters::readYamlFile(file, overlay);
  overlay.ingress_navigator.navigator.vehicle = overlay.vehicle;
  overlay.homography_pose = forVehicle(overlay.homography_pose, overlay.vehicle);
  return overlay;
}

}  // namespace window_ingress::configuration
