/// Flies a scenario many times in one process and summarises: flights.csv, tracks.csv, tracks.png,
/// summary.json.
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <mutex>
#include <opencv2/core/utility.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "evaluation/flights/flight_picture.hpp"
#include "evaluation/flights/flight_results.hpp"
#include "evaluation/output_file.hpp"
#include "fly_options.hpp"
#ifdef WINDOW_INGRESS_WITH_ROS
#include "adapters/bags/flight_bag.hpp"
#endif

namespace {

using namespace window_ingress;
using tools::FlyJob;
using Observer = std::unique_ptr<evaluation::FlightObserver>;

/// The files that grow during the flights, and those written at the end.
class FlyResults {
 public:
  explicit FlyResults(const FlyJob& job)
      : job_(job),
        folder_(job.asked.output),
        rows_(folder_ / "flights.csv", evaluation::csvHeader()),
        tracks_(folder_ / "tracks.csv", evaluation::trackHeader()) {
    for (const char* of_the_whole : {"summary.json", "tracks.png"})
      std::filesystem::remove(folder_ / of_the_whole);
    evaluation::writeText(folder_ / tools::kInputsFile, tools::inputsOf(job.asked));
    rows_.finish();  // if stopped before the first flight, the files can still be resumed
    tracks_.finish();
  }
  void add(const evaluation::FlightResult& flight) {
    rows_ << evaluation::csvRow(flight) << "\n" << std::flush;
    tracks_ << evaluation::trackRows(flight);
    rows_.check();
    tracks_.finish();
    passed_ += flight.outcome == simulation::Outcome::kPassed;
  }
  int passed() const { return passed_; }
  void finish() {
    rows_.finish();
    tracks_.finish();
    // Uses numbers as written in the table: joined shards give the same bytes.
    const auto flights = evaluation::readFlights(folder_.string());
    evaluation::writeText(folder_ / "summary.json", evaluation::toJson(flights, factsOf(flights)));
    const auto scenario = job_.scenario(flights.empty() ? 1u : flights.front().seed);  // a shard may be empty
    const std::string title = std::filesystem::path(job_.asked.scenario).stem().string() + ", " +
                              std::to_string(flights.size()) + " flights";
    evaluation::writeImage(folder_ / "tracks.png", evaluation::drawTracks(flights, scenario, title));
    for (const auto& [cause, count] : evaluation::causesOf(flights))
      std::printf("%d %s\n", count, cause.c_str());
    std::printf("%d of %zu flights passed: flights.csv, tracks.csv, tracks.png and summary.json in %s\n",
                passed_, flights.size(), folder_.c_str());
  }

 private:
  evaluation::CampaignFacts factsOf(const std::vector<evaluation::FlightResult>& flights) const {
    std::vector<std::uint32_t> seeds;
    for (const auto& flight : flights) seeds.push_back(flight.seed);
    const tools::FlyOptions& o = job_.asked;
    return {o.scenario,     evaluation::seedsText(seeds), o.draws,      o.params,
            !o.no_pictures, WINDOW_INGRESS_VERSION,       job_.warnings};
  }

  const FlyJob& job_;
  const std::filesystem::path folder_;
  evaluation::OutputFile rows_, tracks_;
  int passed_ = 0;
};

#ifdef WINDOW_INGRESS_WITH_ROS
Observer bagRecorder(const std::string& file) { return std::make_unique<adapters::FlightBag>(file); }
#else
Observer bagRecorder(const std::string&) { return nullptr; }
#endif

/// Set by Ctrl-C. A second Ctrl-C ends the program at once.
volatile std::sig_atomic_t told_to_stop = 0;

void stopAfterTheseFlights(int signal) {
  constexpr char kSaid[] = "fly: stopping after the running flights (Ctrl-C again: at once)\n";
  told_to_stop = 1;
  std::signal(signal, SIG_DFL);
  if (write(STDERR_FILENO, kSaid, sizeof kSaid - 1) < 0) return;  // stderr is closed
}

// Leaves an ignored signal ignored, as in the background of a script.
void stopAt(int signal) {
  if (std::signal(signal, stopAfterTheseFlights) == SIG_IGN) std::signal(signal, SIG_IGN);
}

struct Stopped {};

evaluation::FlightResult flyLogged(const FlyJob& job, const simulation::Scenario& scenario,
                                   std::uint32_t seed, evaluation::FlightTiming& timing) {
  if (job.asked.log.empty()) return evaluation::flyOnce(scenario, seed, job.params, {}, &timing);
  evaluation::FlightLog log;
  auto result = evaluation::flyOnce(scenario, seed, job.params, {&log}, &timing);
  evaluation::OutputFile file(job.asked.log + "/flight_" + std::to_string(seed) + ".csv");
  evaluation::writeCsv(log, file);
  file.finish();
  return result;
}

// A repeated flight is bit-identical, so only failed flights are flown again and recorded.
void recordAgain(const FlyJob& job, const simulation::Scenario& scenario,
                 const evaluation::FlightResult& flight) {
  const std::string name = job.failures_folder + "/flight_" + std::to_string(flight.seed);
  const Observer bag = bagRecorder(name + ".bag");
  evaluation::FlightStrip strip;
  const auto again = evaluation::flyOnce(scenario, flight.seed, job.params, {bag.get(), &strip});
  if (evaluation::csvRow(again) != evaluation::csvRow(flight))
    throw std::runtime_error("seed " + std::to_string(flight.seed) +
                             ": flown again for its bag, it ended differently; flights must be repeatable");
  evaluation::writeImage(name + ".png", strip.draw(flight, scenario));
}

evaluation::FlightResult fly(const FlyJob& job, std::uint32_t seed, evaluation::FlightTiming& timing) {
  const auto scenario = job.scenario(seed);
  auto flight = flyLogged(job, scenario, seed, timing);
  const bool failed = flight.outcome != simulation::Outcome::kPassed;
  if (failed && !job.failures_folder.empty()) recordAgain(job, scenario, flight);
  return flight;
}

// \param before number of flights before `done` of `left` were flown
void printProgress(int before, int done, int left, int passed, double seconds) {
  const double a_minute = 60.0 * done / std::max(1e-3, seconds);
  std::fprintf(stderr, "%d of %d flights, %d passed, %.1f a minute, %.0f s left\n", before + done,
               before + left, passed, a_minute, 60.0 * (left - done) / std::max(1e-3, a_minute));
}

void printTiming(const evaluation::FlightTiming& timing) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::fprintf(stderr, "%s%ld frames, %.1f s simulated; most memory %.0f MB\n", timing.table().c_str(),
               timing.frames(), timing.simulatedSec(), usage.ru_maxrss / 1024.0);
}

// As `readFlights`; the error says how to start anew.
std::vector<evaluation::FlightResult> readToResume(const std::string& folder) {
  try {
    return evaluation::readFlights(folder);
  } catch (const InputError& fault) {
    throw InputError("--resume: " + std::string(fault.what()) + "; to fly all of them anew: rm " + folder +
                     "/flights.csv");
  }
}

// Repeats the last recorded flight: if its result is the same, the others are valid, too.
std::vector<evaluation::FlightResult> flownBefore(const FlyJob& job) {
  const std::string& folder = job.asked.output;
  if (!job.asked.resume || !job.holdsFlights()) return {};
  auto flights = readToResume(folder);
  for (const auto& flight : flights)
    if (std::find(job.seeds.begin(), job.seeds.end(), flight.seed) == job.seeds.end())
      throw InputError("--resume: " + folder + " holds seed " + std::to_string(flight.seed) +
                       ", which is not among those asked for");
  if (flights.empty()) return flights;
  tools::checkFlownWith(job.asked, folder);
  const std::uint32_t seed = flights.back().seed;
  std::fprintf(stderr, "%zu of %zu flights are there%s; seed %u is flown again to compare\n", flights.size(),
               job.seeds.size(), flights.size() == job.seeds.size() ? ", none is left to fly" : "", seed);
  const auto again = evaluation::flyOnce(job.scenario(seed), seed, job.params, {});
  if (evaluation::csvRow(again) != evaluation::csvRow(flights.back()))
    throw InputError("--resume: seed " + std::to_string(seed) + " flown again ends differently than in " +
                     folder + "/flights.csv: another scenario, other parameters or another build");
  flights.back() = again;
  return flights;
}

// \return number of flights flown
int flyJob(const FlyJob& job, const std::vector<std::uint32_t>& seeds, FlyResults& results) {
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
  const int before = static_cast<int>(job.seeds.size() - seeds.size());  // of a campaign that is resumed
  const auto began = std::chrono::steady_clock::now();
  const auto report = [&](const evaluation::FlightResult& flight, int done, int left) {
    results.add(flight);
    flown = done;
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - began;
    printProgress(before, done, left, results.passed(), spent.count());
  };
  if (!seeds.empty()) std::fprintf(stderr, "%d of %zu flights so far\n", before, before + seeds.size());
  try {
    evaluation::flyAll(seeds, job.asked.jobs, flyTimed, report);
  } catch (const Stopped&) {
  }
  if (job.asked.timing) printTiming(all);
  return flown;
}

int join(const FlyJob& job) {
  for (const auto& folder : job.asked.join) tools::checkFlownWith(job.asked, folder);
  const auto flights = evaluation::joinFlights(job.asked.join);
  FlyResults results(job);
  for (const auto& flight : flights) results.add(flight);
  results.finish();
  return 0;
}

int run(const tools::FlyOptions& asked) {
  const FlyJob job = tools::jobOf(asked);
  if (asked.check) return 0;
  if (!asked.join.empty()) return join(job);
  const auto before = flownBefore(job);
  stopAt(SIGINT);
  stopAt(SIGTERM);
  FlyResults results(job);
  auto seeds = job.seeds;
  for (const auto& flight : before) {
    results.add(flight);
    seeds.erase(std::remove(seeds.begin(), seeds.end(), flight.seed), seeds.end());
  }
  const std::size_t flown = before.size() + flyJob(job, seeds, results);
  results.finish();
  if (flown < job.seeds.size())
    throw std::runtime_error(std::to_string(flown) + " of " + std::to_string(job.seeds.size()) +
                             " flown and summed up, continue with --resume");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  return tools::runTool("fly", argc, argv, tools::describeFly, run);
}
