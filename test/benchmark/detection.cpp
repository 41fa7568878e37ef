/// Time of the detector, its stages and its peers on the same images, one thread, in one run.
/// Usage: benchmark_detection --frames=FOLDER [options of Google Benchmark]
/// Rows are called subject/sequence. Counter `found`: fraction of the images with a result.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <exception>
#include <memory>
#include <opencv2/core/utility.hpp>

#include "subjects.hpp"

namespace {

using namespace window_ingress::bench;

/// A step, created and warmed up at its first use and kept over all repetitions.
class WarmStep {
 public:
  WarmStep(const Subject& subject, const Sequence& sequence) : subject_(subject), sequence_(sequence) {}

  const Step& get() {
    if (!made_) {
      step_ = subject_.start(sequence_);
      for (std::size_t i = 0; step_ && i < 2 * sequence_.images.size(); ++i) step_();
      made_ = true;
    }
    return step_;
  }

 private:
  Subject subject_;
  const Sequence& sequence_;
  Step step_;
  bool made_ = false;
};

void measure(benchmark::State& state, WarmStep& warm) {
  const Step& step = warm.get();
  if (!step) return state.SkipWithError("does not apply");
  double found = 0.0;
  for (auto _ : state) found += step() ? 1.0 : 0.0;
  state.counters["found"] = benchmark::Counter(found, benchmark::Counter::kAvgIterations);
}

void registerAll(const std::vector<Sequence>& sequences) {
  for (const Sequence& sequence : sequences)
    for (const Subject& subject : allSubjects()) {
      auto warm = std::make_shared<WarmStep>(subject, sequence);
      benchmark::RegisterBenchmark((subject.name + "/" + sequence.name).c_str(),
                                   [warm](benchmark::State& state) { measure(state, *warm); })
          ->Unit(benchmark::kMillisecond);
    }
}

/// Removes --frames=... from the arguments and returns its value.
std::string takeFolder(int& argc, char** argv) {
  const std::string option = "--frames=";
  for (int i = 1; i < argc; ++i)
    if (std::string(argv[i]).rfind(option, 0) == 0) {
      const std::string folder = argv[i] + option.size();
      for (int k = i; k + 1 < argc; ++k) argv[k] = argv[k + 1];
      --argc;
      return folder;
    }
  return "out/bench/frames";
}

}  // namespace

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  const std::string folder = takeFolder(argc, argv);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  try {
    const std::vector<Sequence> sequences = readFrameSet(folder);
    registerAll(sequences);
    benchmark::RunSpecifiedBenchmarks();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "benchmark_detection: %s\n", error.what());
    return 2;
  }
}
