/// Memory of search and track over many images at full speed, as JSON: resident size at the start, after a
/// tenth and at the end. Every image is tracked, every tenth is searched, and the sequences alternate. Exit
/// code 1 if memory grows or exceeds its limit.
///
/// Usage: benchmark_memory [--frames=FOLDER] [--pictures=108000] [SEQUENCE...]
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <opencv2/core/utility.hpp>

#include "arguments.hpp"
#include "subjects.hpp"

namespace {

using namespace window_ingress::bench;

constexpr double kMaxMegabytes = 150.0;  ///< of the detector's process, the images in memory included
constexpr double kMaxGrowth = 1.0;       ///< from a tenth to the end [MB]
constexpr std::size_t kSearchEvery = 10;

double residentMegabytes() {
  std::ifstream file("/proc/self/statm");
  double size = 0.0, resident = 0.0;
  file >> size >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

/// Our applicable subjects, one step for each sequence.
std::vector<Step> stepsOf(const std::string& subject, const std::vector<Sequence>& sequences) {
  std::vector<Step> steps;
  for (const Subject& own : ownSubjects())
    for (const Sequence& sequence : sequences)
      if (own.name == subject)
        if (Step step = own.start(sequence)) steps.push_back(step);
  return steps;
}

}  // namespace

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  try {
    const Arguments arguments(argc, argv);
    const std::size_t images = std::stoul(arguments.value("pictures", "108000"));
    const auto sequences = readFrameSet(arguments.value("frames", "out/bench/frames"),
                                        [&](const std::string& name) { return arguments.names(name); });
    const std::vector<Step> track = stepsOf("track", sequences), search = stepsOf("search", sequences);
    if (track.empty() || search.empty()) throw std::runtime_error("no such sequence");
    std::vector<double> resident = {residentMegabytes()};
    for (std::size_t i = 0; i < images; ++i) {
      if (i == images / 10) resident.push_back(residentMegabytes());
      track[i % track.size()]();
      if (i % kSearchEvery == 0) search[i / kSearchEvery % search.size()]();
    }
    resident.push_back(residentMegabytes());
    const double growth = resident.back() - resident[resident.size() - 2];
    std::cout << nlohmann::json{{"pictures", images},
                                {"start_mb", resident.front()},
                                {"tenth_mb", resident[resident.size() - 2]},
                                {"end_mb", resident.back()}}
              << "\n";
    return growth > kMaxGrowth || resident.back() > kMaxMegabytes ? 1 : 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "benchmark_memory: %s\n", error.what());
    return 2;
  }
}
