/// Checked options of fly.
#pragma once

#include <cstdint>
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "evaluation/csv.hpp"
#include "evaluation/flights/campaign.hpp"
#include "evaluation/flights/closed_loop_flight.hpp"
#include "evaluation/flights/flight_results.hpp"
#include "size_checks.hpp"

namespace window_ingress::tools {

#ifdef WINDOW_INGRESS_WITH_ROS
constexpr bool kCanRecordBags = true;
#else
constexpr bool kCanRecordBags = false;
#endif

struct FlyOptions {
  std::string scenario, output, seeds = "1", draws, shard, params, log;
  std::vector<std::string> join;
  int jobs = 1;
  bool resume = false, overwrite = false, no_pictures = false, keep_failures = false, timing = false,
       check = false;
};

/// The flights to fly, and where the results go.
struct FlyJob {
  simulation::Scenario scenario(std::uint32_t seed) const {
    const auto draw = draws.find(seed);
    return simulation::loadScenario(asked.scenario, seed,
                                    draw == draws.end() ? simulation::Quantiles() : draw->second);
  }

  bool holdsFlights() const { return std::filesystem::exists(asked.output + "/flights.csv"); }

  FlyOptions asked;
  std::string failures_folder = {};  ///< empty: failures are not kept
  std::vector<std::uint32_t> seeds = {};
  evaluation::FlightDraws draws = {};
  evaluation::FlightParams params = {};
  std::vector<std::string> warnings = {};
};

inline OptionList describeFly(FlyOptions& o) {
  OptionList add(
      "Usage: fly --scenario FILE.yaml --output DIR [OPTION...]\n"
      "Exit code 0: all flown, however the flights ended; 1: not all, e.g. after Ctrl-C, which lets the "
      "flights under way end (--resume goes on with the others); 2: wrong usage");
  add.required("scenario", o.scenario, "scenario file, e.g. config/scenarios/nominal.yaml");
  add("output,o", o.output, "folder for the results; made if missing; needed unless --check");
  add("seeds", o.seeds, "A..B, a flight each");
  add("draws", o.draws,
      "csv file instead of --seeds: one flight per row, its seed and the position of each named key in its "
      "range, 0 to 1");
  add("resume", o.resume, "continues the flights in DIR; scenario, parameters and build must be the same");
  add("overwrite", o.overwrite, "replaces the flights in DIR");
  add("jobs", o.jobs, "flights at the same time", {1, 256});
  add("shard", o.shard, "I/N: only every N-th seed, from the I-th on (1 to N)");
  add("join", o.join, "flies nothing: joins the folders of several shards into one");
  add("check", o.check, "flies nothing and writes nothing: only checks scenario and parameters");
  add("params", o.params, kParamsHelp);
  add("no-pictures", o.no_pictures,
      "draws no images: simulates a perfect detector. Many times faster; tests what follows the detector "
      "only");
  add("keep-failures", o.keep_failures,
      "for each flight that did not pass, a bag and a picture in DIR/failures");
  add("timing", o.timing, "where the time went, as a table, at the end");
  add("log", o.log, "folder for a csv of every step of each flight");
  return add;
}

inline std::vector<std::uint32_t> seedsOf(const FlyJob& job) {
  const FlyOptions& o = job.asked;
  auto seeds = evaluation::parseSeeds(o.seeds);
  if (!o.draws.empty()) {
    seeds.emplace();
    for (const auto& [seed, quantiles] : job.draws) seeds->push_back(seed);
  }
  if (!seeds) throw InputError("--seeds " + o.seeds + ": give A..B with A <= B, e.g. 1..20");
  if (o.shard.empty()) return *seeds;
  const auto shard = evaluation::shardOf(*seeds, o.shard);
  if (!shard) throw InputError("--shard " + o.shard + ": give I/N with I from 1 to N, e.g. 1/4");
  return *shard;
}

// Inputs that determine the results, apart from the build.
inline std::string inputsOf(const FlyOptions& o) {
  std::string text;
  for (const auto& [option, file] :
       {std::pair{"scenario", o.scenario}, {"params", o.params}, {"draws", o.draws}})
    text += std::string("# --") + option + "\n" + (file.empty() ? "" : contentOf(file));
  return text + (o.no_pictures ? "# --no-pictures\n" : "");
}

constexpr const char* kInputsFile = "flown_with.txt";

/// \throws InputError if the flights of a folder were flown with other inputs
inline void checkFlownWith(const FlyOptions& o, const std::string& folder) {
  const std::string file = folder + "/" + kInputsFile;
  if (!std::filesystem::exists(file) || contentOf(file) == inputsOf(o)) return;
  throw InputError(folder + " holds flights with another --scenario, --params, --draws or --no-pictures: " +
                   "give those that " + file + " shows, or another folder");
}

/// Says which keys of the file only nodes use; empty: none.
inline std::string onlyForNodes(const configuration::Overlay& overlay) {
  static const std::regex kUsed(
      "vehicle/.*|window_detector/(detector|interior|reference)/.*|homography_pose/(pose|filter|tracker)/.*|"
      "ingress_navigator/(navigator/.*|rate_hz|guard/max_silence_sec)");
  std::vector<std::string> keys;
  for (const std::string& key : overlay.given)
    if (!std::regex_match(key, kUsed)) keys.push_back(key);
  return keys.empty() ? "" : "not used, because no nodes run: " + parameters::joined(keys, ", ");
}

/// What has no effect, or another one, without images; empty: nothing.
inline std::string notSimulated(const configuration::Overlay& overlay, const simulation::Scenario& scenario) {
  static const std::regex kOfImages(
      "window_detector/(detector|interior)/.*|ingress_navigator/navigator/commit/(glass|unverified_opening)");
  std::vector<std::string> keys;
  for (const std::string& key : overlay.given)
    if (std::regex_match(key, kOfImages)) keys.push_back(key);
  std::string text = keys.empty() ? "" : "not used with --no-pictures: " + parameters::joined(keys, ", ");
  if (scenario.window.present && !scenario.window.isOpen())
    text += (text.empty() ? "" : "; ") +
            std::string("the window is closed, which nobody sees with --no-pictures");
  return text;
}

/// An open window that no flight can pass, because the navigator asks whether it has glass; empty: none.
inline std::string asksInVain(const configuration::Overlay& overlay, const simulation::Scenario& scenario) {
  const std::string& set = overlay.ingress_navigator.navigator.commit.glass;
  const bool asks = (scenario.glass == "as_set" ? set : scenario.glass) == "possible";
  if (!asks || !scenario.window.present || !scenario.window.isOpen()) return "";
  return "nobody is there to answer ~confirm_opening: give the scenario 'glass: excluded' and "
         "'unverified_opening: allow'";
}

inline FlyJob jobOf(const FlyOptions& o) {
  FlyJob job{o};
  if (o.output.empty() && !o.check) throw InputError("--output is missing: a folder for the results");
  if (o.resume && o.overwrite) throw InputError("--resume and --overwrite: give one of them");
  if (job.holdsFlights() && !o.resume && !o.overwrite)
    throw InputError(o.output +
                     " holds the flights of an earlier campaign: --resume goes on with it, --overwrite "
                     "replaces it, or give another folder");
  if (!o.draws.empty()) {
    job.draws = evaluation::readDraws(o.draws);
    if (job.draws.empty()) throw InputError("--draws " + o.draws + ": no flights in it");
  }
  job.seeds = seedsOf(job);
  if (!o.params.empty()) job.params = {configuration::readOverlay(o.params)};
  const auto scenario = job.scenario(job.seeds.empty() ? 1U : job.seeds.front());  // a shard may be empty
  for (const std::string& warning :
       {otherSizes(job.params, scenario), otherReference(job.params), onlyForNodes(job.params),
        o.no_pictures ? notSimulated(job.params, scenario) : asksInVain(job.params, scenario)}) {
    if (warning.empty()) continue;
    job.warnings.push_back(warning);
    std::cerr << "fly: warning: " << warning << "\n";
  }
  job.params.without_images = o.no_pictures;
  for (const auto seed : job.seeds) job.scenario(seed);
  if (o.check) return job;
  makeFolder(o.output);
  if (o.overwrite) std::filesystem::remove_all(o.output + "/failures");
  if (!o.log.empty()) makeFolder(o.log);
  if (!o.keep_failures) return job;
  if (o.no_pictures) throw InputError("--keep-failures: there are no images to keep with --no-pictures");
  if (!kCanRecordBags)
    throw InputError(
        "--keep-failures: this fly was built without ROS and cannot write bags; run scripts/build");
  makeFolder(job.failures_folder = o.output + "/failures");
  return job;
}

}  // namespace window_ingress::tools
