/// Allocations an image in steady state, by place.
/// Usage: benchmark_allocations [--frames=FOLDER] [--sites=N] [SUBJECT...]
/// Prints JSON: for each subject/sequence the counts an image of "ours", "opencv" (inside a function of
/// OpenCV that we call) and "other", and the N sites that ask most often.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/core/utility.hpp>

#include "allocation_recorder.hpp"
#include "arguments.hpp"
#include "subjects.hpp"

namespace {

using namespace window_ingress::bench;
using nlohmann::json;

constexpr std::size_t kMinImages = 30;  ///< counted ones; rare events must occur among them

json sitesOf(const std::map<AllocationSite, std::size_t>& counts, double images, std::size_t limit) {
  std::vector<std::pair<std::size_t, AllocationSite>> order;
  for (const auto& [site, count] : counts) order.emplace_back(count, site);
  std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  json sites = json::array();
  for (std::size_t i = 0; i < std::min(limit, order.size()); ++i)
    sites.push_back({{"whose", toString(order[i].second.whose)},
                     {"where", order[i].second.where},
                     {"per_picture", order[i].first / images}});
  return sites;
}

/// Whole passes through the sequence: some to warm up, as many to count.
json count(const Subject& subject, const Sequence& sequence, std::size_t limit) {
  const Step step = subject.start(sequence);
  if (!step) return {};
  const std::size_t turn = std::max<std::size_t>(1, 2 * (sequence.images.size() - 1));
  const std::size_t images = turn * ((kMinImages + turn - 1) / turn);
  for (std::size_t i = 0; i < images; ++i) step();
  startRecording();
  for (std::size_t i = 0; i < images; ++i) step();
  const Recording recording = stopRecording();
  std::map<AllocationSite, std::size_t> counts;
  std::map<Whose, std::size_t> sums;
  for (const AllocationSite& site : recording.sites) ++counts[site], ++sums[site.whose];
  json result;
  for (const Whose whose : {Whose::kOurs, Whose::kOpencv, Whose::kOther})
    result[toString(whose)] = static_cast<double>(sums[whose]) / images;
  result["bytes"] = static_cast<double>(recording.bytes) / images;
  result["sites"] = sitesOf(counts, static_cast<double>(images), limit);
  if (recording.overflow) result["not_attributed"] = static_cast<double>(recording.overflow) / images;
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  try {
    const Arguments arguments(argc, argv);
    const std::size_t sites = std::stoul(arguments.value("sites", "10"));
    json result;
    for (const Sequence& sequence : readFrameSet(arguments.value("frames", "out/bench/frames")))
      for (const Subject& subject : allSubjects()) {
        if (!arguments.names(subject.name)) continue;
        const json counted = count(subject, sequence, sites);
        if (!counted.is_null()) result[subject.name + "/" + sequence.name] = counted;
      }
    std::cout << result.dump(1) << "\n";
  } catch (const std::exception& error) {
    std::fprintf(stderr, "benchmark_allocations: %s\n", error.what());
    return 2;
  }
}
