/// What fly is asked for: its options, checked.
#pragma once

#include <boost/program_options.hpp>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "evaluation/flights/campaign.hpp"
#include "evaluation/flights/closed_loop_flight.hpp"
#include "evaluation/flights/flight_draws.hpp"

namespace window_ingress::tools {

namespace options = boost::program_options;

#ifdef WINDOW_INGRESS_WITH_ROS
constexpr bool kCanRecordBags = true;
#else
constexpr bool kCanRecordBags = false;
#endif

/// What is to be flown, and where the results go.
struct FlyJob {
  simulation::Scenario scenario(std::uint32_t seed) const {
    const auto draw = draws.find(seed);
    return simulation::loadScenario(scenario_file, seed,
                                    draw == draws.end() ? simulation::Quantiles() : draw->second);
  }

  bool holdsFlights() const { return std::filesystem::exists(output_folder + "/flights.csv"); }

  std::string scenario_file, params_file, draws_file, output_folder, log_folder, failures_folder;
  std::vector<std::string> join_folders;
  std::vector<std::uint32_t> seeds;
  evaluation::FlightDraws draws;
  int jobs = 1;
  bool resumes = false, with_timing = false;
  evaluation::FlightParams params;
};

inline options::options_description describeFly() {
  options::options_description description(
      "Usage: fly --scenario FILE.yaml --output DIR [OPTION...]\n"
      "Exit code 0: all flown, however the flights ended; 1: not all, e.g. after Ctrl-C, which lets the "
      "flights under way end (--resume goes on with the others); 2: wrong usage\n\nOptions");
  auto add = description.add_options();
  add("help", "print this text");
  add("scenario", options::value<std::string>(), "scenario file, e.g. config/scenarios/nominal.yaml");
  add("output", options::value<std::string>(), "folder for the results; made if missing");
  add("seeds", options::value<std::string>()->default_value("1"), "A..B, a flight each");
  add("draws", options::value<std::string>(),
      "csv file in place of --seeds: a row a flight, its seed and where in its range each named key lies, 0 "
      "to 1");
  add("resume", "goes on with the flights in DIR: same scenario, parameters and build, or it is refused");
  add("overwrite", "replaces the flights in DIR");
  add("jobs", options::value<int>()->default_value(1), "flights at the same time");
  add("shard", options::value<std::string>(), "I/N: only every N-th seed, from the I-th on (1 to N)");
  add("join", options::value<std::vector<std::string>>()->multitoken(),
      "flies nothing: joins the folders of several shards into one");
  add("params", options::value<std::string>(), tools::kParamsHelp);
  add("no-pictures",
      "draws none: the window is seen as by a detector that never errs. Many times faster; measures what "
      "comes behind the detector, not the whole");
  add("keep-failures", "for each flight that did not pass, a bag and a picture in DIR/failures");
  add("timing", "where the time went, as a table, at the end");
  add("log", options::value<std::string>(), "folder for a csv of every step of each flight");
  return description;
}

inline std::string required(const options::variables_map& given, const char* name) {
  if (given.count(name) == 0) throw UsageError(std::string("--") + name + " is missing; see --help");
  return given[name].as<std::string>();
}

inline std::vector<std::uint32_t> seedsOf(const options::variables_map& given,
                                          const evaluation::FlightDraws& draws) {
  if (!draws.empty()) {
    std::vector<std::uint32_t> seeds;
    for (const auto& [seed, quantiles] : draws) seeds.push_back(seed);
    return seeds;
  }
  const std::string text = given["seeds"].as<std::string>();
  auto seeds = evaluation::parseSeeds(text);
  if (!seeds) throw UsageError("--seeds " + text + ": give A..B with A <= B, e.g. 1..20");
  if (given.count("shard") == 0) return *seeds;
  const std::string shard_text = given["shard"].as<std::string>();
  const auto shard = evaluation::shardOf(*seeds, shard_text);
  if (!shard) throw UsageError("--shard " + shard_text + ": give I/N with I from 1 to N, e.g. 1/4");
  return *shard;
}

// Flights that somebody has waited for are not lost to a folder given twice.
inline void checkOutput(const options::variables_map& given, const FlyJob& job) {
  const bool overwrites = given.count("overwrite") != 0;
  if (job.resumes && overwrites) throw UsageError("--resume and --overwrite: give one of them");
  if (job.holdsFlights() && !job.resumes && !overwrites)
    throw UsageError(
        job.output_folder +
        " holds the flights of an earlier campaign: --resume goes on with it, --overwrite replaces "
        "it, or give another folder");
}

inline FlyJob parseFly(int argc, char** argv, const options::options_description& description) {
  const auto given = parsed(argc, argv, description);
  FlyJob job;
  if (given.count("help") != 0) {
    std::cout << description;
    return job;
  }
  job.scenario_file = required(given, "scenario");
  job.output_folder = required(given, "output");
  job.resumes = given.count("resume") != 0;
  checkOutput(given, job);
  if (given.count("draws") != 0)
    job.draws = evaluation::readDraws(job.draws_file = given["draws"].as<std::string>());
  job.seeds = seedsOf(given, job.draws);
  job.jobs = given["jobs"].as<int>();
  if (job.jobs < 1 || job.jobs > 256) throw UsageError("--jobs: give a number from 1 to 256");
  job.with_timing = given.count("timing") != 0;
  if (given.count("join") != 0) job.join_folders = given["join"].as<std::vector<std::string>>();
  if (given.count("params") != 0)
    job.params = evaluation::readFlightParams(job.params_file = given["params"].as<std::string>());
  if (given.count("no-pictures") != 0) job.params.without_images = true;
  for (const auto seed : job.seeds) job.scenario(seed);
  makeFolder(job.output_folder);
  if (given.count("log") != 0) makeFolder(job.log_folder = given["log"].as<std::string>());
  if (given.count("keep-failures") == 0) return job;
  if (job.params.without_images)
    throw UsageError("--keep-failures: there are no images to keep with --no-pictures");
  if (!kCanRecordBags)
    throw UsageError(
        "--keep-failures: this fly was built without ROS and cannot write bags; run scripts/build");
  makeFolder(job.failures_folder = job.output_folder + "/failures");
  return job;
}

}  // namespace window_ingress::tools
