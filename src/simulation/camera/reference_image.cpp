#include "simulation/camera/reference_image.hpp"

#include <algorithm>

#include "simulation/rendering/renderer.hpp"
#include "simulation/scene/scene.hpp"
#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/geometry/opening.hpp"

namespace window_ingress::simulation {
namespace {

constexpr double kMinDistance_m = 2.5;
constexpr double kGreatestPart = 0.5;  // largest part of the image's width or height for the opening

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
