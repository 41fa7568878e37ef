/// Result of a flight, summary of many, and the files of a campaign: flights.csv and tracks.csv, written and
/// read back so that shards can be joined, and the file of draws that says what to fly.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "evaluation/flights/flight_observer.hpp"
#include "simulation/referee.hpp"
#include "simulation/scenario/scenario.hpp"
#include "window_ingress/estimation/clock_check.hpp"

namespace window_ingress::evaluation {

/// True position of the vehicle in the window's frame.
struct TrackPoint {
  double time_sec = 0.0;  ///< since the start of the mission
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
};

struct FlightResult {
  std::uint32_t seed = 0;
  simulation::Outcome outcome = simulation::Outcome::kRunning;
  double time_sec = 0.0;  ///< from the start of the mission to the crossing of the plane, else to the end
  std::optional<double> offset_y_m;       ///< at the crossing, left of the opening's centre
  std::optional<double> offset_z_m;       ///< at the crossing, above it
  std::optional<double> min_clearance_m;  ///< between the body and the opening's borders
  double wrong_side_m = 0.0;              ///< largest sideways distance beyond the start, away from the axis
  double max_speed_mps = 0.0;
  double nearest_m = 0.0;  ///< lower bound of the smallest gap to anything solid but the ground
  double blind_sec = 0.0;  ///< longest time without sight of the window in front of the plane
  std::optional<double> predicted_miss_m;  ///< predicted by the navigator at its last commit
  std::optional<estimation::ClockCheck::Offset>
      clock_offset;  ///< of images against odometry, as found in flight
  std::string reason;
  std::string forbidden;          ///< first reason for which the checks in flight forbade the approach
  std::vector<TrackPoint> track;  ///< ten points a second
};

/// Inputs of a campaign, sufficient to repeat it with the same build.
struct CampaignFacts {
  std::string scenario;  ///< file as given, like all of these
  std::string seeds;     ///< e.g. "1..20"
  std::string draws;     ///< file; empty: none was given
  std::string params;    ///< file that overrides the defaults; empty: none was given
  bool with_images = true;
  std::string version;                ///< of the package
  std::vector<std::string> warnings;  ///< what of the parameters does not count in these flights
};

/// Number of flights with each outcome and reason, without numbers; of all flights but PASSED.
std::map<std::string, int> causesOf(const std::vector<FlightResult>& flights);

/// Summary of a campaign as json text, keys in a fixed order: the facts; the number of flights, those that
/// passed, and their rate with its 95 % Wilson interval; counts by outcome, and by outcome and reason
/// (`causes`, see `causesOf`); median and 95 % quantile of the time of those that passed; 95 % quantiles of
/// the larger of |y| and |z| where the plane was crossed, and of `wrong_side_m`.
std::string toJson(const std::vector<FlightResult>& flights, const CampaignFacts& facts);

/// Header of flights.csv, without the end of the line.
std::string csvHeader();

/// The flight as a row of flights.csv; values never measured stay empty.
std::string csvRow(const FlightResult& flight);

/// Header of tracks.csv, and the rows of one flight, each with its end of line.
std::string trackHeader();
std::string trackRows(const FlightResult& flight);

/// Reads the flights of a folder written by `fly`, tracks included. \throws InputError
std::vector<FlightResult> readFlights(const std::string& folder);

/// Flights of several folders, sorted by seed. \throws InputError, also for a duplicate seed
std::vector<FlightResult> joinFlights(const std::vector<std::string>& folders);

/// Flights to fly in one scenario: by seed, the quantile of each named key within its range.
using FlightDraws = std::map<std::uint32_t, simulation::Quantiles>;

/// A csv file with a header `seed,KEY,...` (paths of keys with a range, as in `simulation::Quantiles`) and
/// one row per flight. \throws InputError that names file and line
FlightDraws readDraws(const std::string& file);

/// Every step of a flight.
class FlightLog : public FlightObserver {
 public:
  void onStep(const FlightRecord& record, const navigation::NavigatorOutput&) override {
    records.push_back(record);
  }
  std::vector<FlightRecord> records;
};

/// Writes the log as csv with a header.
void writeCsv(const FlightLog& log, std::ostream& out);

}  // namespace window_ingress::evaluation
