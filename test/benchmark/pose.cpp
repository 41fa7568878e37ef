/// Time of a pose from one image: the estimator (checks, homography, both solutions, spreads, aspect) beside
/// OpenCV's methods on the corners of the same borders. One thread, one run.
#include <benchmark/benchmark.h>

#include <opencv2/core/utility.hpp>
#include <random>
#include <vector>

#include "evaluation/poses/noisy_borders.hpp"
#include "evaluation/poses/pose_survey.hpp"
#include "window_ingress/estimation/window_pose_estimator.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace {

using namespace window_ingress;

/// Views from 2 to 8 m, up to 45 degrees to either side, 0.3 px of noise a sample.
std::vector<detection::WindowObservation> drawnViews(const evaluation::PoseSurveySetup& setup) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> distance(2.0, 8.0), yaw(-0.78, 0.78);
  std::vector<detection::WindowObservation> views;
  while (views.size() < 256) {
    const Eigen::Isometry3d T = geometry::makePose(
        geometry::R_optical_flu() * geometry::yawRotation(yaw(random)), {0.0, 0.0, distance(random)});
    views.push_back(*evaluation::noisyBorders(setup.camera, T, setup.opening, 0.3, random));
  }
  return views;
}

class Pose : public benchmark::Fixture {
 public:
  const evaluation::PoseSurveySetup setup;
  const std::vector<detection::WindowObservation> views = drawnViews(setup);

  template <typename Estimate>
  void run(benchmark::State& state, const Estimate& estimate) const {
    std::size_t at = 0;
    double found = 0.0;
    for (auto _ : state) found += estimate(views[at++ % views.size()]) ? 1.0 : 0.0;
    state.counters["found"] = benchmark::Counter(found, benchmark::Counter::kAvgIterations);
  }

  void runOurs(benchmark::State& state, double systematic_px, double aspect_sigma) const {
    estimation::PoseParams params;
    params.opening_width_m = setup.opening.width_m;
    params.opening_height_m = setup.opening.height_m;
    params.systematic_sigma_px = systematic_px;
    params.aspect_sigma = params.scale_sigma = aspect_sigma;
    const estimation::WindowPoseEstimator estimator(params);
    const estimation::GravityPrior gravity{{0.0, -1.0, 0.0}, 0.02};
    run(state, [&](const auto& view) {
      return estimator.estimate(view, setup.camera, {gravity}).estimate.has_value();
    });
  }

  void runPeer(benchmark::State& state, int method) const {
    run(state, [&](const auto& view) {
      return evaluation::poseByPeer(method, view.corners, setup.camera, setup.opening).has_value();
    });
  }
};

BENCHMARK_F(Pose, ours)(benchmark::State& state) { runOurs(state, 0.15, 0.0); }
BENCHMARK_F(Pose, ours_size_unknown)(benchmark::State& state) { runOurs(state, 0.15, 0.3); }
BENCHMARK_F(Pose, ippe)(benchmark::State& state) { runPeer(state, evaluation::kIppe); }
BENCHMARK_F(Pose, iterative)(benchmark::State& state) { runPeer(state, evaluation::kIterative); }
BENCHMARK_F(Pose, homography)(benchmark::State& state) { runPeer(state, evaluation::kHomography); }

}  // namespace

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
}
