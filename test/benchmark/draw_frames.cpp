/// Writes the images of the measurements that need no recordings: scenarios rendered from a moving vehicle,
/// and a drawn wall of bricks. Usage: benchmark_draw_frames FOLDER
#include <cstdio>
#include <exception>

#include "brick_wall.hpp"
#include "simulation/camera/reference_image.hpp"
#include "simulation/world.hpp"

namespace {

using namespace window_ingress;

constexpr int kImages = 8;
constexpr double kRunUpSec = 1.0;
constexpr unsigned kSeed = 3;

/// A flight towards the window and a little sideways, from the scenario's start, facing the target.
bench::Sequence rendered(const std::string& name, const std::string& scenario_file) {
  auto scenario = simulation::loadScenario(
      std::string(WINDOW_INGRESS_SOURCE_DIR) + "/config/scenarios/" + scenario_file, kSeed);
  scenario.start.heading_rad = 0.0;
  simulation::World world(scenario, kSeed);
  bench::Sequence sequence;
  sequence.name = name, sequence.kind = "rendering";
  sequence.period_sec = 1.0 / scenario.camera.rate_hz;
  sequence.camera = world.camera();
  simulation::VelocityCommand command;
  command.velocity_odom_mps =
      world.odometryDrift().linear() * world.T_odom_window().linear() * Eigen::Vector3d(0.4, 0.3, 0.0);
  while (static_cast<int>(sequence.images.size()) < kImages) {
    world.command(command);
    world.advance();
    const auto frame = world.takeFrame();
    if (frame && frame->stamp_sec > kRunUpSec) sequence.images.push_back(frame->image.clone());
  }
  geometry::Quadrilateral corners;
  const cv::Mat image = simulation::referenceImage(world.scenario(), &corners);
  sequence.reference.emplace(image, corners);
  return sequence;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s FOLDER\n", argv[0]);
    return 2;
  }
  try {
    const bench::Sequence plaster = rendered("plaster", "nominal.yaml");
    bench::Sequence away = rendered("away", "brick.yaml");
    away.reference = plaster.reference;  // other windows are in view, the target is not
    bench::addToFrameSet(argv[1], plaster);
    bench::addToFrameSet(argv[1], away);
    bench::addToFrameSet(argv[1], rendered("brick", "brick.yaml"));
    bench::addToFrameSet(argv[1], rendered("siding", "siding.yaml"));
    bench::addToFrameSet(argv[1], rendered("lens", "gusty.yaml"));
    bench::addToFrameSet(argv[1], bench::brickWallSequence(kImages));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "draw_frames: %s\n", error.what());
    return 1;
  }
}
