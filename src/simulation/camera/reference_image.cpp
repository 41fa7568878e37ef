#include "simulation/camera/reference_image.hpp"

#include <algorithm>
#include <cmath>

#include "simulation/rendering/renderer.hpp"
#include "simulation/scene/scene.hpp"
#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/geometry/opening.hpp"

namespace window_ingress::simulation {
namespace {

constexpr double kMinDistance_m = 2.5;
constexpr double kGreatestPart = 0.5;  // largest part of the image's width or height for the opening

bool reachesInto(const PosterParams& poster, const Scenario& scenario) {
  const double beside_m = 0.5 * (poster.width_m + scenario.window.width_m) + scenario.window.frame_width_m;
  const double above_m = 0.5 * (poster.height_m + scenario.window.height_m) + scenario.window.frame_width_m;
  return std::abs(poster.y_m) < beside_m && std::abs(poster.z_m) < above_m;
}

// The world as the operator photographed the target: present, open, not covered, in clear air.
Scenario asPhotographed(Scenario scenario) {
  scenario.window.present = true;
  scenario.window.closed_by = "none";
  scenario.window.dirt = 0.0;
  scenario.house.daylight.fog_m = 0.0;
  auto& posters = scenario.posters;
  posters.erase(std::remove_if(posters.begin(), posters.end(),
                               [&](const PosterParams& poster) { return reachesInto(poster, scenario); }),
                posters.end());
  return scenario;
}

}  // namespace

cv::Mat referenceImage(const Scenario& scenario, geometry::Quadrilateral* corners) {
  const geometry::PinholeCamera ideal = scenario.camera.model().withoutDistortion();
  const geometry::OpeningSize size = scenario.opening();
  const double distance_m = std::max({kMinDistance_m, ideal.fx * size.width_m / (kGreatestPart * ideal.width),
                                      ideal.fy * size.height_m / (kGreatestPart * ideal.height)});
  const Eigen::Isometry3d T_camera_window = geometry::makePose(geometry::R_optical_flu(), {0, 0, distance_m});
  cv::Mat image;
  Renderer(buildScene(asPhotographed(scenario)), ideal).render(T_camera_window, image);
  if (scenario.camera.gain != 1.0) image.convertTo(image, CV_8U, scenario.camera.gain);
  if (corners) *corners = *geometry::projectOpening(ideal, T_camera_window, size);
  return image;
}

}  // namespace window_ingress::simulation
