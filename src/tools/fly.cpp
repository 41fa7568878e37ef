/// Flies a scenario many times in one process and sums up: flights.csv, summary.json.
#include <boost/program_options.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <opencv2/core/utility.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "window_ingress/evaluation/campaign.hpp"
#include "window_ingress/evaluation/closed_loop_flight.hpp"
#include "window_ingress/evaluation/flight_log.hpp"
#include "window_ingress/parameters/yaml.hpp"

namespace {

namespace options = boost::program_options;
using namespace window_ingress;
using tools::makeFolder;
using tools::UsageError;

struct Job {
  std::string scenario_file, output_folder, log_folder;
  std::vector<std::uint32_t> seeds;
  int jobs = 1;
  evaluation::FlightParams params;
};

options::options_description describe() {
  options::options_description description("fly --scenario FILE.yaml --output DIR [OPTION...]");
  auto add = description.add_options();
  add("help", "print this text");
  add("scenario", options::value<std::string>(), "scenario file, e.g. config/scenarios/nominal.yaml");
  add("output", options::value<std::string>(), "folder for flights.csv and summary.json; made if missing");
  add("seeds", options::value<std::string>()->default_value("1"), "A..B, a flight each");
  add("jobs", options::value<int>()->default_value(1), "flights at the same time");
  add("shard", options::value<std::string>(), "I/N: only every N-th seed, from the I-th on (1 to N)");
  add("params", options::value<std::string>(),
      "yaml file with any of the sections detector, pose, filter, tracker, navigator");
  add("log", options::value<std::string>(), "folder for a csv of every step of each flight");
  return description;
}

std::string required(const options::variables_map& given, const char* name) {
  if (given.count(name) == 0) throw UsageError(std::string("--") + name + " is missing; see --help");
  return given[name].as<std::string>();
}

std::vector<std::uint32_t> seedsOf(const options::variables_map& given) {
  const std::string text = given["seeds"].as<std::string>();
  auto seeds = evaluation::parseSeeds(text);
  if (!seeds) throw UsageError("--seeds " + text + ": give A..B with A <= B, e.g. 1..20");
  if (given.count("shard") == 0) return *seeds;
  const std::string shard_text = given["shard"].as<std::string>();
  const auto shard = evaluation::shardOf(*seeds, shard_text);
  if (!shard) throw UsageError("--shard " + shard_text + ": give I/N with I from 1 to N, e.g. 1/4");
  return *shard;
}

Job parse(int argc, char** argv, const options::options_description& description) {
  options::variables_map given;
  options::store(options::parse_command_line(argc, argv, description), given);
  Job job;
  if (given.count("help") != 0) {
    std::cout << description;
    return job;
  }
  job.scenario_file = required(given, "scenario");
  job.output_folder = required(given, "output");
  job.seeds = seedsOf(given);
  job.jobs = given["jobs"].as<int>();
  if (job.jobs < 1 || job.jobs > 256) throw UsageError("--jobs: give a number from 1 to 256");
  if (given.count("params") != 0) parameters::readYamlFile(given["params"].as<std::string>(), "", job.params);
  for (const auto seed : job.seeds) simulation::loadScenario(job.scenario_file, seed);
  if (given.count("log") != 0) makeFolder(job.log_folder = given["log"].as<std::string>());
  makeFolder(job.output_folder);
  return job;
}

evaluation::FlightResult fly(const Job& job, std::uint32_t seed) {
  const auto scenario = simulation::loadScenario(job.scenario_file, seed);
  if (job.log_folder.empty()) return evaluation::flyOnce(scenario, seed, job.params);
  evaluation::FlightLog log;
  const auto result = evaluation::flyOnce(scenario, seed, job.params, {&log});
  std::ofstream file(job.log_folder + "/flight_" + std::to_string(seed) + ".csv");
  evaluation::writeCsv(log, file);
  return result;
}

void printProgress(int done, int total, int passed, double seconds) {
  const double a_minute = 60.0 * done / std::max(1e-3, seconds);
  std::fprintf(stderr, "%d of %d flights, %d passed, %.1f a minute, %.0f s left\n", done, total, passed,
               a_minute, 60.0 * (total - done) / std::max(1e-3, a_minute));
}

int run(const Job& job) {
  const auto began = std::chrono::steady_clock::now();
  std::ofstream csv(job.output_folder + "/flights.csv");
  csv << evaluation::csvHeader() << "\n";
  std::vector<evaluation::FlightResult> flights;
  int passed = 0;
  const auto report = [&](const evaluation::FlightResult& flight, int done, int total) {
    csv << evaluation::csvRow(flight) << "\n" << std::flush;
    flights.push_back(flight);
    passed += flight.outcome == simulation::Outcome::kPassed ? 1 : 0;
    printProgress(done, total, passed,
                  std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count());
  };
  evaluation::flyAll(
      job.seeds, job.jobs, [&](std::uint32_t seed) { return fly(job, seed); }, report);
  std::ofstream summary(job.output_folder + "/summary.json");
  summary << evaluation::toJson(evaluation::summarise(flights));
  summary.close();
  if (!csv || !summary) throw std::runtime_error(job.output_folder + ": cannot write");
  return 0;
}

int fail(const std::string& what, int code) {
  std::cerr << "fly: " << what << "\n";
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  try {
    const Job job = parse(argc, argv, describe());
    return job.scenario_file.empty() ? 0 : run(job);
  } catch (const UsageError& error) {
    return fail(error.what(), 2);
  } catch (const options::error& error) {
    return fail(std::string(error.what()) + "; see --help", 2);
  } catch (const simulation::ScenarioError& error) {
    return fail(error.what(), 2);
  } catch (const parameters::YamlError& error) {
    return fail(error.what(), 2);
  } catch (const std::invalid_argument& error) {
    return fail(error.what(), 2);
  } catch (const std::exception& error) {
    return fail(error.what(), 1);
  }
}
