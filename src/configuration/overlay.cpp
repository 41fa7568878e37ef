#include "window_ingress/configuration/overlay.hpp"

#include "window_ingress/parameters/yaml.hpp"

namespace window_ingress::configuration {

Overlay readOverlay(const std::string& file) {
  Overlay overlay;
  if (!file.empty()) overlay.said = parameters::readYamlFile(file, overlay);
  overlay.ingress_navigator.navigator.vehicle = overlay.vehicle;
  overlay.homography_pose.tracker = navigation::forVehicle(overlay.homography_pose.tracker, overlay.vehicle);
  return overlay;
}

}  // namespace window_ingress::configuration
