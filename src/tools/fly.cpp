/// Flies a scenario many times in one process and sums up: flights.csv, tracks.csv, tracks.png, summary.json.
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <boost/program_options.hpp>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <mutex>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "evaluation/flights/campaign.hpp"
#include "evaluation/flights/closed_loop_flight.hpp"
#include "evaluation/flights/flight_draws.hpp"
#include "evaluation/flights/flight_log.hpp"
#include "evaluation/flights/flight_picture.hpp"
#include "evaluation/flights/flight_table.hpp"
#ifdef WINDOW_INGRESS_WITH_ROS
#include "adapters/bags/flight_bag.hpp"
#endif

namespace {

namespace options = boost::program_options;
namespace fs = std::filesystem;
using namespace window_ingress;
using tools::makeFolder;
using tools::UsageError;
using Observer = std::unique_ptr<evaluation::FlightObserver>;

struct Job {
  simulation::Scenario scenario(std::uint32_t seed) const {
    const auto draw = draws.find(seed);
    return simulation::loadScenario(scenario_file, seed,
                                    draw == draws.end() ? simulation::Quantiles() : draw->second);
  }

  bool holdsFlights() const { return fs::exists(output_folder + "/flights.csv"); }

  std::string scenario_file, params_file, draws_file, output_folder, log_folder, failures_folder;
  std::vector<std::string> join_folders;
  std::vector<std::uint32_t> seeds;
  evaluation::FlightDraws draws;
  int jobs = 1;
  bool resumes = false, with_timing = false;
  evaluation::FlightParams params;
};

#ifdef WINDOW_INGRESS_WITH_ROS
Observer bagRecorder(const std::string& file) { return std::make_unique<adapters::FlightBag>(file); }
constexpr bool kCanRecordBags = true;
#else
Observer bagRecorder(const std::string&) { return nullptr; }
constexpr bool kCanRecordBags = false;
#endif

/// Ctrl-C. The second one ends the program at once.
volatile std::sig_atomic_t told_to_stop = 0;

void stopAfterTheseFlights(int signal) {
  constexpr char kSaid[] = "fly: stopping; the flights under way end first (once more: at once)\n";
  told_to_stop = 1;
  std::signal(signal, SIG_DFL);
  if (write(STDERR_FILENO, kSaid, sizeof kSaid - 1) < 0) return;  // nobody is there to read it
}

// Not where it is ignored: in the background of a script.
void stopAt(int signal) {
  if (std::signal(signal, stopAfterTheseFlights) == SIG_IGN) std::signal(signal, SIG_IGN);
}

struct Stopped {};

options::options_description describe() {
  options::options_description description(
      "Usage: fly --scenario FILE.yaml --output DIR [OPTION...]\n"
      "Exit code 0: all flown, however the flights ended; 1: not all, e.g. after Ctrl-C, which lets the "
      "flights "
      "under way end (--resume goes on with the others); 2: wrong usage");
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
      "comes "
      "behind the detector, not the whole");
  add("keep-failures", "for each flight that did not pass, a bag and a picture in DIR/failures");
  add("timing", "where the time went, as a table, at the end");
  add("log", options::value<std::string>(), "folder for a csv of every step of each flight");
  return description;
}

std::string required(const options::variables_map& given, const char* name) {
  if (given.count(name) == 0) throw UsageError(std::string("--") + name + " is missing; see --help");
  return given[name].as<std::string>();
}

std::vector<std::uint32_t> seedsOf(const options::variables_map& given,
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
void checkOutput(const options::variables_map& given, const Job& job) {
  const bool overwrites = given.count("overwrite") != 0;
  if (job.resumes && overwrites) throw UsageError("--resume and --overwrite: give one of them");
  if (job.holdsFlights() && !job.resumes && !overwrites)
    throw UsageError(
        job.output_folder +
        " holds the flights of an earlier campaign: --resume goes on with it, --overwrite replaces "
        "it, or give another folder");
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

evaluation::WallOutline outlineOf(const simulation::Scenario& scenario) {
  return {scenario.window.width_m, scenario.window.height_m,
          scenario.window.frame_depth_m + scenario.house.wall_thickness_m};
}

evaluation::FlightResult flyLogged(const Job& job, const simulation::Scenario& scenario, std::uint32_t seed,
                                   evaluation::FlightTiming& timing) {
  if (job.log_folder.empty()) return evaluation::flyOnce(scenario, seed, job.params, {}, &timing);
  evaluation::FlightLog log;
  auto result = evaluation::flyOnce(scenario, seed, job.params, {&log}, &timing);
  const std::string name = job.log_folder + "/flight_" + std::to_string(seed) + ".csv";
  std::ofstream file(name);
  evaluation::writeCsv(log, file);
  if (!file.flush()) throw std::runtime_error(name + ": cannot be written; is the disk full?");
  return result;
}

// A flight is the same to the bit when flown again: only those that failed are recorded.
void recordAgain(const Job& job, const simulation::Scenario& scenario,
                 const evaluation::FlightResult& flight) {
  const std::string name = job.failures_folder + "/flight_" + std::to_string(flight.seed);
  const Observer bag = bagRecorder(name + ".bag");
  evaluation::FlightStrip strip;
  const auto again = evaluation::flyOnce(scenario, flight.seed, job.params, {bag.get(), &strip});
  if (evaluation::csvRow(again) != evaluation::csvRow(flight))
    throw std::runtime_error("seed " + std::to_string(flight.seed) +
                             ": flown again for its bag, it ended otherwise; flights must repeat");
  const cv::Mat image = strip.draw(flight, outlineOf(scenario));
  if (image.empty() || !cv::imwrite(name + ".png", image))
    throw std::runtime_error(name + ".png: cannot write");
}

evaluation::FlightResult fly(const Job& job, std::uint32_t seed, evaluation::FlightTiming& timing) {
  const auto scenario = job.scenario(seed);
  auto flight = flyLogged(job, scenario, seed, timing);
  const bool failed = flight.outcome != simulation::Outcome::kPassed;
  if (failed && !job.failures_folder.empty()) recordAgain(job, scenario, flight);
  return flight;
}

/// The files that grow while flights come in, and those drawn at the end.
class Results {
 public:
  explicit Results(const Job& job)
      : job_(job), rows_(job.output_folder + "/flights.csv"), tracks_(job.output_folder + "/tracks.csv") {
    for (const char* of_the_whole : {"/summary.json", "/tracks.png"})
      fs::remove(job.output_folder + of_the_whole);
    rows_ << evaluation::csvHeader() << "\n";
    tracks_ << evaluation::trackHeader() << "\n";
  }
  void add(const evaluation::FlightResult& flight) {
    rows_ << evaluation::csvRow(flight) << "\n" << std::flush;
    tracks_ << evaluation::trackRows(flight) << std::flush;
    check(rows_ && tracks_);
    passed_ += flight.outcome == simulation::Outcome::kPassed ? 1 : 0;
  }
  int passed() const { return passed_; }
  void finish() {
    rows_.close();
    tracks_.close();
    check(rows_ && tracks_);
    // Of the numbers as they stand in the table: joined shards give the same bytes.
    const auto flights = evaluation::readFlights(job_.output_folder);
    std::ofstream summary(job_.output_folder + "/summary.json");
    summary << evaluation::toJson(evaluation::summarise(flights), factsOf(flights));
    summary.close();
    const auto scenario = job_.scenario(seedOf(flights));
    const std::string title =
        fs::path(job_.scenario_file).stem().string() + ", " + std::to_string(flights.size()) + " flights";
    const bool drawn = cv::imwrite(job_.output_folder + "/tracks.png",
                                   evaluation::drawTracks(flights, outlineOf(scenario), title));
    check(summary && drawn);
  }

 private:
  void check(bool written) const {
    if (!written) throw std::runtime_error(job_.output_folder + ": cannot write; is the disk full?");
  }
  evaluation::CampaignFacts factsOf(const std::vector<evaluation::FlightResult>& flights) const {
    std::vector<std::uint32_t> seeds;
    for (const auto& flight : flights) seeds.push_back(flight.seed);
    return {job_.scenario_file, evaluation::seedsText(seeds), job_.draws_file,
            job_.params_file,   !job_.params.without_images,  WINDOW_INGRESS_VERSION};
  }
  // Of a flight whose scenario stands for all in the image; there may be none in a shard.
  std::uint32_t seedOf(const std::vector<evaluation::FlightResult>& flights) const {
    return flights.empty() ? 1u : flights.front().seed;
  }

  const Job& job_;
  std::ofstream rows_, tracks_;
  int passed_ = 0;
};

void printProgress(int done, int total, int passed, double seconds) {
  const double a_minute = 60.0 * done / std::max(1e-3, seconds);
  std::fprintf(stderr, "%d of %d flights, %d passed, %.1f a minute, %.0f s left\n", done, total, passed,
               a_minute, 60.0 * (total - done) / std::max(1e-3, a_minute));
}

void printTiming(const evaluation::FlightTiming& timing) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::fprintf(stderr, "%s%ld frames, %.1f s simulated; most memory %.0f MB\n", timing.table().c_str(),
               timing.frames(), timing.simulatedSec(), usage.ru_maxrss / 1024.0);
}

// The last of the flights there is flown again: that it ends as it did shows that the others would.
std::vector<evaluation::FlightResult> flownBefore(const Job& job) {
  if (!job.resumes || !job.holdsFlights()) return {};
  auto flights = evaluation::readFlights(job.output_folder);
  for (const auto& flight : flights)
    if (std::find(job.seeds.begin(), job.seeds.end(), flight.seed) == job.seeds.end())
      throw UsageError("--resume: " + job.output_folder + " holds seed " + std::to_string(flight.seed) +
                       ", which is not among those asked for");
  if (flights.empty()) return flights;
  const std::uint32_t seed = flights.back().seed;
  std::fprintf(stderr, "%zu of %zu flights are there; seed %u is flown again to compare\n", flights.size(),
               job.seeds.size(), seed);
  const auto again = evaluation::flyOnce(job.scenario(seed), seed, job.params, {});
  if (evaluation::csvRow(again) != evaluation::csvRow(flights.back()))
    throw UsageError("--resume: seed " + std::to_string(seed) + " flown again ends otherwise than in " +
                     job.output_folder + "/flights.csv: another scenario, other parameters or another build");
  flights.back() = again;
  return flights;
}

std::vector<std::uint32_t> without(std::vector<std::uint32_t> seeds,
                                   const std::vector<evaluation::FlightResult>& flown) {
  for (const auto& flight : flown)
    seeds.erase(std::remove(seeds.begin(), seeds.end(), flight.seed), seeds.end());
  return seeds;
}

// \return how many were flown
int flyJob(const Job& job, const std::vector<std::uint32_t>& seeds, Results& results) {
  std::mutex mutex;
  evaluation::FlightTiming all;
  const auto flyTimed = [&](std::uint32_t seed) {
    if (told_to_stop != 0) throw Stopped();
    evaluation::FlightTiming timing;
    auto flight = fly(job, seed, timing);
    const std::lock_guard<std::mutex> lock(mutex);
    all.add(timing);
    return flight;
  };
  int flown = 0;
  const int passed_before = results.passed();  // those of a campaign that is resumed
  const auto began = std::chrono::steady_clock::now();
  const auto report = [&](const evaluation::FlightResult& flight, int done, int total) {
    results.add(flight);
    flown = done;
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - began;
    printProgress(done, total, results.passed() - passed_before, spent.count());
  };
  try {
    evaluation::flyAll(seeds, job.jobs, flyTimed, report);
  } catch (const Stopped&) {
  }
  if (job.with_timing) printTiming(all);
  return flown;
}

int join(const Job& job) {
  const auto flights = evaluation::joinFlights(job.join_folders);
  Results results(job);
  for (const auto& flight : flights) results.add(flight);
  results.finish();
  return 0;
}

int run(const Job& job) {
  if (!job.join_folders.empty()) return join(job);
  const auto before = flownBefore(job);
  stopAt(SIGINT);
  stopAt(SIGTERM);
  Results results(job);
  for (const auto& flight : before) results.add(flight);
  const std::size_t flown = before.size() + flyJob(job, without(job.seeds, before), results);
  results.finish();
  if (flown < job.seeds.size())
    throw std::runtime_error(std::to_string(flown) + " of " + std::to_string(job.seeds.size()) +
                             " flown and summed up, continue with --resume");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  return tools::runTool("fly", [&] {
    const Job job = parse(argc, argv, describe());
    return job.scenario_file.empty() ? 0 : run(job);
  });
}
