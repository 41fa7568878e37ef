/// What fly writes: flights.csv, tracks.csv, tracks.png, summary.json.
#pragma once

#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "evaluation/flights/flight_picture.hpp"
#include "evaluation/flights/flight_table.hpp"
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
      : job_(job), rows_(job.output_folder + "/flights.csv"), tracks_(job.output_folder + "/tracks.csv") {
    for (const char* of_the_whole : {"/summary.json", "/tracks.png"})
      std::filesystem::remove(job.output_folder + of_the_whole);
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
    const std::string title = std::filesystem::path(job_.scenario_file).stem().string() + ", " +
                              std::to_string(flights.size()) + " flights";
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

  const FlyJob& job_;
  std::ofstream rows_, tracks_;
  int passed_ = 0;
};

}  // namespace window_ingress::tools
