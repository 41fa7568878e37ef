#include <algorithm>
#include <chrono>

#include "evaluation/openness/openness_approach.hpp"
#include "simulation/camera/camera_sensor.hpp"
#include "window_ingress/openness/interior_klt_tracker.hpp"

namespace window_ingress::evaluation {

OpennessResult flyDrawn(const simulation::Scenario& scenario, std::uint32_t seed, const OpennessRange& range,
                        const openness::InteriorKltParams& follower, const openness::OpennessParams& params,
                        const OpennessStep& each) {
  using Clock = std::chrono::steady_clock;
  const simulation::Scene scene = simulation::buildScene(scenario);
  const geometry::PinholeCamera camera = scenario.camera.model();
  simulation::CameraSensor sensor(scene, scenario.camera, seed);
  OpennessApproach approach(range, scenario.opening(), params, seed);
  openness::InteriorKltTracker interior(follower);
  OpennessResult result;
  result.seed = seed;
  result.is_open = scenario.window.isOpen();
  result.kind = !scenario.window.present ? "poster" : result.is_open ? "room" : scenario.window.closed_by;
  result.room_m = result.is_open ? scenario.house.room_depth_m : 0.0;
  int images = 0;
  for (int i = 0; i < approach.steps(); ++i) {
    const cv::Mat image =
        sensor.expose(approach.motion(i), static_cast<std::uint64_t>(i), approach.timeSec(i));
    auto window = approach.look(camera, i);
    if (!window) continue;
    const auto begun = Clock::now();
    interior.follow(image, *window);
    approach.judge(*window, camera, i);
    const double ms = std::chrono::duration<double, std::milli>(Clock::now() - begun).count();
    result.milliseconds += ms;
    result.slowest_ms = std::max(result.slowest_ms, ms);
    ++images;
    approach.note(i, result, each);
  }
  result.milliseconds /= std::max(1, images);
  return result;
}

}  // namespace window_ingress::evaluation
