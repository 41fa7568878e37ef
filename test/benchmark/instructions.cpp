/// Instructions an image, a figure that does not depend on the machine's load. Runs under callgrind, which
/// writes one file for each subject and sequence, with "subject/sequence" in its head:
///   valgrind --tool=callgrind --instr-atstart=no benchmark_instructions --frames=FOLDER [SUBJECT...]
/// Counts after a warm-up, because a new track costs more; prints how many images it counts. It writes to
/// stdout right before and right after, so that an emulator that counts from write to write finds the same
/// figure.
#include <valgrind/callgrind.h>

#include <cstdio>
#include <exception>
#include <opencv2/core/utility.hpp>

#include "arguments.hpp"
#include "subjects.hpp"

namespace {

using namespace window_ingress::bench;

constexpr int kWarmUp = 24;
constexpr int kImages = 12;

void count(const Subject& subject, const Sequence& sequence) {
  const Step step = subject.start(sequence);
  if (!step) return;
  for (int i = 0; i < kWarmUp; ++i) step();
  const std::string name = subject.name + "/" + sequence.name;
  std::printf("%s ", name.c_str());
  std::fflush(stdout);
  CALLGRIND_START_INSTRUMENTATION;
  CALLGRIND_ZERO_STATS;
  int found = 0;
  for (int i = 0; i < kImages; ++i) found += step() ? 1 : 0;
  CALLGRIND_DUMP_STATS_AT(name.c_str());
  CALLGRIND_STOP_INSTRUMENTATION;
  std::printf("pictures=%d found=%d\n", kImages, found);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  try {
    const Arguments arguments(argc, argv);
    for (const Sequence& sequence : readFrameSet(arguments.value("frames", "out/bench/frames")))
      for (const Subject& subject : allSubjects())
        if (arguments.names(subject.name)) count(subject, sequence);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "benchmark_instructions: %s\n", error.what());
    return 2;
  }
}
