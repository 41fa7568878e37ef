/// What fly writes: flights.csv, tracks.csv, tracks.png, summary.json.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "evaluation/flights/flight_picture.hpp"
#include "evaluation/flights/flight_table.hpp"
#include "evaluation/output_file.hpp"
#include "fly_job.hpp"

namespace window_ingress::tools {

inline evaluation::WallOutline outlineOf(const simulation::Scenario& scenario) {
  return {scenario.window.width_m, scenario.window.height_m,
          scenario.window.frame_depth_m + scenario.house.wall_thickness_m};
}

/// The files that grow while flights come in, and those drawn at the end.
class FlyResults {
 public:
  explicit FlyResults(const FlyJob& job)
      : job_(job),
        folder_(job.asked.output),
        rows_(folder_ / "flights.csv"),
        tracks_(folder_ / "tracks.csv") {
    for (const char* of_the_whole : {"summary.json", "tracks.png"})
      std::filesystem::remove(folder_ / of_the_whole);
    rows_ << evaluation::csvHeader() << "\n";
    tracks_ << evaluation::trackHeader() << "\n";
    rows_.finish();  // whoever ends it before the first flight leaves files that can be gone on with
    tracks_.finish();
  }
  void add(const evaluation::FlightResult& flight) {
    rows_ << evaluation::csvRow(flight) << "\n" << std::flush;
    tracks_ << evaluation::trackRows(flight);
    rows_.check();
    tracks_.finish();
    passed_ += flight.outcome == simulation::Outcome::kPassed ? 1 : 0;
  }
  int passed() const { return passed_; }
  void finish() {
    rows_.finish();
    tracks_.finish();
    // Of the numbers as they stand in the table: joined shards give the same bytes.
    const auto flights = evaluation::readFlights(folder_.string());
    evaluation::OutputFile summary(folder_ / "summary.json");
    summary << evaluation::toJson(evaluation::summarise(flights), factsOf(flights));
    summary.finish();
    const auto scenario = job_.scenario(seedOf(flights));
    const std::string title = std::filesystem::path(job_.asked.scenario).stem().string() + ", " +
                              std::to_string(flights.size()) + " flights";
    evaluation::writeImage(folder_ / "tracks.png",
                           evaluation::drawTracks(flights, outlineOf(scenario), title));
  }

 private:
  evaluation::CampaignFacts factsOf(const std::vector<evaluation::FlightResult>& flights) const {
    std::vector<std::uint32_t> seeds;
    for (const auto& flight : flights) seeds.push_back(flight.seed);
    const FlyOptions& o = job_.asked;
    return {o.scenario,     evaluation::seedsText(seeds), o.draws, o.params,
            !o.no_pictures, WINDOW_INGRESS_VERSION};
  }
  // Of a flight whose scenario stands for all in the image; there may be none in a shard.
  std::uint32_t seedOf(const std::vector<evaluation::FlightResult>& flights) const {
    return flights.empty() ? 1u : flights.front().seed;
  }

  const FlyJob& job_;
  const std::filesystem::path folder_;
  evaluation::OutputFile rows_, tracks_;
  int passed_ = 0;
};

}  // namespace window_ingress::tools
