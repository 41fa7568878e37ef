#include "evaluation/images/survey_image.hpp"

#include "simulation/camera/camera_sensor.hpp"
#include "simulation/camera/reference_image.hpp"
#include "simulation/scene/scene.hpp"

namespace window_ingress::evaluation {
namespace {

constexpr double kSettling = 60.0;  // time constants of the automatic gains between two images

// The gains follow what the image before showed: once the time between is long, they have settled.
cv::Mat expose(const simulation::Scenario& scenario, const simulation::Scene& scene,
               const simulation::CameraMotion& motion, std::uint32_t seed) {
  simulation::CameraSensor sensor(scene, scenario.camera, seed);
  const bool automatic = scenario.camera.auto_exposure || scenario.camera.auto_white_balance;
  if (automatic) sensor.expose(motion, 0, 0.0);
  return sensor.expose(motion, 1, kSettling * scenario.camera.auto_exposure_sec).clone();
}

}  // namespace

std::optional<SurveyTruth> surveyTruth(const simulation::Scenario& scenario, const simulation::Scene& scene,
                                       const geometry::PinholeCamera& camera,
                                       const simulation::CameraMotion& motion) {
  const auto project = [&](const geometry::OpeningSize& size, double behind_m) {
    return projectMoving(camera, motion, scenario.camera.readout_sec, size, behind_m);
  };
  const geometry::OpeningSize opening = scenario.opening();
  const double frame_m = scenario.window.frame_width_m;
  const auto inner = project(opening, 0.0);
  if (!inner) return std::nullopt;
  SurveyTruth truth;
  truth.present = scenario.window.present;
  truth.inner = *inner;
  truth.far = project(opening, scene.opening_depth_m).value_or(*inner);
  if (frame_m > 0.0)
    truth.outer = project({opening.width_m + 2.0 * frame_m, opening.height_m + 2.0 * frame_m}, 0.0);
  return truth;
}

SurveyImage takeImage(const simulation::Scenario& scenario, std::uint32_t seed, const ViewRange& range,
                      bool with_reference) {
  const simulation::Scene scene = simulation::buildScene(scenario);
  SurveyImage sample;
  sample.seed = seed;
  sample.camera = scenario.camera.model();
  const SurveyView view = drawView(scenario, scene, sample.camera, range, seed);
  sample.distance_m = view.distance_m;
  sample.off_axis_rad = view.off_axis_rad;
  sample.truth = *surveyTruth(scenario, scene, sample.camera, view.motion);
  sample.image = expose(scenario, scene, view.motion, seed);
  if (with_reference) sample.reference = simulation::referenceImage(scenario, &sample.reference_corners);
  return sample;
}

}  // namespace window_ingress::evaluation
