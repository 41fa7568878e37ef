#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "evaluation/images/survey_view.hpp"
#include "simulation/scenario/scenario.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::evaluation {

/// The borders of the window in one image, canonical order, in pixels of the image as it came.
struct SurveyTruth {
  bool present = true;            ///< false: there is no window, and the borders are those where it would be
  geometry::Quadrilateral inner;  ///< front inner border of the opening: what is to be found
  std::optional<geometry::Quadrilateral> outer;  ///< outer border of its frame, if it has one
  geometry::Quadrilateral far;                   ///< border of the opening in the room, at the wall's back
};

/// Nothing unless all of the front inner border lies before the camera.
std::optional<SurveyTruth> surveyTruth(const simulation::Scenario& scenario, const simulation::Scene& scene,
                                       const geometry::PinholeCamera& camera,
                                       const simulation::CameraMotion& motion);

/// One image with all that is known about it.
struct SurveyImage {
  std::string scenario;  ///< name of its file, without folder and ending
  std::uint32_t seed = 0;
  double distance_m = 0.0, off_axis_rad = 0.0;
  SurveyTruth truth;
  geometry::PinholeCamera camera;
  cv::Mat image;
  cv::Mat reference;  ///< the target as photographed; empty without
  geometry::Quadrilateral reference_corners;
};

/// Draws an image of the scenario as its camera delivers it, exposure and white balance settled.
/// \param scenario loaded with the same seed
/// \throws as `drawView` and `simulation::CameraSensor`
SurveyImage takeImage(const simulation::Scenario& scenario, std::uint32_t seed, const ViewRange& range,
                      bool with_reference);

}  // namespace window_ingress::evaluation
