/// Time of the detector and of its stages, one thread. Counters: was the window found, candidates traced,
/// rivals compared.
#include <benchmark/benchmark.h>

#include <memory>
#include <opencv2/imgproc.hpp>
#include <string>

#include "drawn_window.hpp"
#include "opencv_composition.hpp"
#include "window_ingress/detection/target_borders.hpp"
#include "window_ingress/detection/window_detector.hpp"
#include "window_ingress/simulation/world.hpp"

namespace {

using namespace window_ingress;
using detection::DetectorParams;

/// One picture with what is known of it.
struct View {
  cv::Mat image;
  std::optional<geometry::PinholeCamera> camera;
  std::optional<detection::ReferenceAppearance> reference;
};

View renderedView(const std::string& scenario_file) {
  auto scenario = simulation::loadScenario(
      std::string(WINDOW_INGRESS_SOURCE_DIR) + "/config/scenarios/" + scenario_file, 3);
  scenario.start.heading_rad = 0.0;
  simulation::World world(scenario, 3);
  View view;
  while (view.image.empty()) {
    world.advance();
    if (const auto frame = world.takeFrame()) view.image = frame->image.clone();
  }
  geometry::Quadrilateral corners;
  const cv::Mat picture = world.referencePicture(&corners);
  view.reference.emplace(picture, corners);
  view.camera = world.camera();
  return view;
}

View drawnBricks() {
  test::WindowPicture picture;
  picture.opening = test::turned(test::rectangle(220, 140, 420, 320), 0.05, 0.1);
  picture.frame_px = 14.0;
  View view;
  view.image = test::drawnBricks(picture);
  view.reference.emplace(picture.draw(), picture.opening);
  return view;
}

const View& viewOf(const benchmark::State& state) {
  static const View house = renderedView("nominal.yaml"), lens = renderedView("gusty.yaml"),
                    bricks = drawnBricks();
  return state.range(0) == 0 ? house : state.range(0) == 1 ? lens : bricks;
}

void pictures(benchmark::internal::Benchmark* bench) {
  bench->ArgName("house_lens_bricks")->DenseRange(0, 2)->Unit(benchmark::kMillisecond);
}

void detector(benchmark::State& state) {
  const View& view = viewOf(state);
  detection::WindowDetector detector{DetectorParams()};
  detector.setReference(*view.reference);
  bool found = false;
  for (auto _ : state)
    found = detector.detect(view.image, 0.0, view.camera ? &*view.camera : nullptr).has_value();
  state.counters["found"] = found;
  state.counters["candidates"] = static_cast<double>(detector.trace().candidates.size());
}

void composition(benchmark::State& state) {
  const View& view = viewOf(state);
  for (auto _ : state) benchmark::DoNotOptimize(test::opencvComposition(view.image));
}

/// The stages before `run`, done once, for the stage that is measured.
struct Prepared {
  explicit Prepared(const View& view)
      : preprocess(params.preprocess), edges(params.edges), lines(params.lines), closing(params.closing) {
    level = preprocess.run(view.image);
    map = edges.run(level.image);
    segments = lines.run(map);
    closed = closing.run(map.edges);
  }
  DetectorParams params;
  detection::Preprocess preprocess;
  detection::EdgeDetector edges;
  detection::LineSupport lines;
  detection::Closing closing;
  detection::SearchLevel level;
  detection::EdgeMap map;
  std::vector<detection::Segment> segments;
  cv::Mat closed;
};

void stagePreprocess(benchmark::State& state) {
  const View& view = viewOf(state);
  Prepared stages(view);
  for (auto _ : state) benchmark::DoNotOptimize(stages.preprocess.run(view.image));
}

void stageEdges(benchmark::State& state) {
  Prepared stages(viewOf(state));
  for (auto _ : state) benchmark::DoNotOptimize(stages.edges.run(stages.level.image));
}

void stageLines(benchmark::State& state) {
  Prepared stages(viewOf(state));
  for (auto _ : state) benchmark::DoNotOptimize(stages.lines.run(stages.map));
}

void stageContours(benchmark::State& state) {
  Prepared stages(viewOf(state));
  detection::ContourPolygons contours(stages.params.contours);
  for (auto _ : state) benchmark::DoNotOptimize(contours.run(stages.closing.run(stages.map.edges), 1.0));
}

void stageSegmentQuads(benchmark::State& state) {
  Prepared stages(viewOf(state));
  const detection::SegmentQuads quads(stages.params.segment_quads);
  const double area = stages.params.gates.min_area * stages.level.image.size().area();
  for (auto _ : state) benchmark::DoNotOptimize(quads.run(stages.segments, area));
}

/// All of the first half: the stages above, gates and duplicates.
void halfSearch(benchmark::State& state) {
  const View& view = viewOf(state);
  detection::CandidateSearch search{DetectorParams()};
  for (auto _ : state) {
    detection::DetectionTrace trace;
    benchmark::DoNotOptimize(search.run(view.image, trace));
  }
}

/// The colours of all rivals, as they were seen.
void stageAppearance(benchmark::State& state) {
  const View& view = viewOf(state);
  const DetectorParams params;
  detection::CandidateSearch search(params);
  detection::DetectionTrace trace;
  const auto rivals = search.run(view.image, trace);
  for (auto _ : state)
    for (const auto& rival : rivals)
      benchmark::DoNotOptimize(view.reference->distance(view.image, rival.quad, params.appearance));
  state.counters["rivals"] = static_cast<double>(rivals.size());
}

void stageBorders(benchmark::State& state) {
  const View& view = viewOf(state);
  const DetectorParams params;
  detection::CandidateSearch search(params);
  detection::DetectionTrace trace;
  const auto rivals = search.run(view.image, trace);
  const detection::TargetBorders borders(params.refinement);
  double inliers = 0.0;
  for (auto _ : state)
    benchmark::DoNotOptimize(borders.seen(view.image, rivals.front(), search.factor(),
                                          view.camera ? &*view.camera : nullptr, &inliers));
}

BENCHMARK(detector)->Apply(pictures);
BENCHMARK(composition)->Apply(pictures);
BENCHMARK(halfSearch)->Apply(pictures);
BENCHMARK(stagePreprocess)->Apply(pictures);
BENCHMARK(stageEdges)->Apply(pictures);
BENCHMARK(stageLines)->Apply(pictures);
BENCHMARK(stageContours)->Apply(pictures);
BENCHMARK(stageSegmentQuads)->Apply(pictures);
BENCHMARK(stageAppearance)->Apply(pictures);
BENCHMARK(stageBorders)->Apply(pictures);

}  // namespace

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
