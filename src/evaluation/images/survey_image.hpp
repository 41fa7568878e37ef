#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "simulation/camera/camera_truth.hpp"
#include "simulation/scenario/scenario.hpp"
#include "simulation/scene/scene.hpp"
#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::evaluation {

/// Viewpoints of a survey. All values are uniformly distributed between their limits.
struct ViewRange {
  double nearest_m = 2.0, farthest_m = 8.0;  ///< horizontal distance from the opening's centre [m]
  double off_axis_rad = 0.7853981633974483;  ///< largest angle to either side of the opening's normal [rad]
  double margin_px = 4.0;                    ///< least distance of the opening from the image's border [px]
  bool still = false;                        ///< the camera does not move
};

/// A view of the window: the camera's pose, and its motion during the exposure.
struct SurveyView {
  double distance_m = 0.0, off_axis_rad = 0.0;
  simulation::CameraTruth motion;
};

/// Draws a random view as in a flight: at most 0.4 m above or below the opening's centre, tilted and rolled
/// by up to 0.15 rad, moving at 0.25 m/s and turning at 0.08 rad/s per axis (standard deviations, at most
/// twice that). The whole opening, or the place where it would be, lies anywhere in the image. Views in which
/// something hides a part of the border are drawn again. The same seed gives the same view.
/// \throws std::runtime_error if no such view is found
SurveyView drawView(const simulation::Scenario& scenario, const simulation::Scene& scene,
                    const geometry::PinholeCamera& camera, const ViewRange& range, std::uint32_t seed);

/// True if nothing of the scene lies between the eye and the front inner border of the opening.
bool borderIsFree(const simulation::Mesh& mesh, const Eigen::Vector3d& eye,
                  const geometry::OpeningSize& opening);

/// Image of a rectangle `behind_m` behind the plane of the window, around the same axis, with a rolling
/// shutter: each corner at the time its row is exposed.
std::optional<geometry::Quadrilateral> projectMoving(const geometry::PinholeCamera& camera,
                                                     const simulation::CameraTruth& motion,
                                                     double readout_sec, const geometry::OpeningSize& size,
                                                     double behind_m);

/// The borders of the window in one image, canonical order, distorted pixels.
struct SurveyTruth {
  bool present = true;            ///< false: there is no window, the borders are those where it would be
  geometry::Quadrilateral inner;  ///< front inner border of the opening, which is to be found
  std::optional<geometry::Quadrilateral> outer;  ///< outer border of its frame, if it has one
  geometry::Quadrilateral far;                   ///< border of the opening in the room, at the wall's back
};

/// Nothing unless all of the front inner border lies in front of the camera.
std::optional<SurveyTruth> surveyTruth(const simulation::Scenario& scenario, const simulation::Scene& scene,
                                       const geometry::PinholeCamera& camera,
                                       const simulation::CameraTruth& motion);

/// What one image of a survey shows.
struct SurveySubject {
  std::string scenario;  ///< file name without folder and extension
  std::uint32_t seed = 0;
  double distance_m = 0.0, off_axis_rad = 0.0;
  SurveyTruth truth;
};

/// One image with its truth.
struct SurveyImage : SurveySubject {
  geometry::PinholeCamera camera;
  cv::Mat image;
  cv::Mat reference;  ///< the reference image; empty if there is none
  geometry::Quadrilateral reference_corners;
};

/// Draws an image of the scenario as its camera delivers it, exposure and white balance settled.
/// \param scenario loaded with the same seed
/// \throws as `drawView` and `simulation::CameraSensor`
SurveyImage takeImage(const simulation::Scenario& scenario, std::uint32_t seed, const ViewRange& range,
                      bool with_reference);

}  // namespace window_ingress::evaluation
