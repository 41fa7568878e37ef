/// Instructions an image, a figure that does not depend on the machine's load. Runs under callgrind, which
/// writes one file for each subject and sequence, with "subject/sequence" in its head:
///   valgrind --tool=callgrind --instr-atstart=no benchmark_instructions --frames=FOLDER [SUBJECT...]
/// Uses the first images of each sequence, after some to warm up; prints how many are counted. It writes to
/// stdout right before and right after, so that an emulator that counts from write to write finds the same
/// figure.
#include <valgrind/callgrind.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <opencv2/core/utility.hpp>

#include "arguments.hpp"
#include "subjects.hpp"

namespace {

using namespace window_ingress::bench;

constexpr std::size_t kImages = 2;

void count(const Subject& subject, const Sequence& sequence) {
  const Step step = subject.start(sequence);
  if (!step) return;
  const std::size_t images = std::min(kImages, sequence.images.size());
  for (std::size_t i = 0; i < 2 + images; ++i) step();
  const std::string name = subject.name + "/" + sequence.name;
  std::printf("%s ", name.c_str());
  std::fflush(stdout);
  CALLGRIND_START_INSTRUMENTATION;
  CALLGRIND_ZERO_STATS;
  int found = 0;
  for (std::size_t i = 0; i < images; ++i) found += step() ? 1 : 0;
  CALLGRIND_DUMP_STATS_AT(name.c_str());
  CALLGRIND_STOP_INSTRUMENTATION;
  std::printf("pictures=%zu found=%d\n", images, found);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  try {
    const Arguments arguments(argc, argv);
    for (Sequence& sequence : readFrameSet(arguments.value("frames", "out/bench/frames"))) {
      sequence.images.resize(std::min(kImages, sequence.images.size()));
      for (const Subject& subject : allSubjects())
        if (arguments.names(subject.name)) count(subject, sequence);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "benchmark_instructions: %s\n", error.what());
    return 2;
  }
}
