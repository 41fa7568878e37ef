/// What a flight comes down to, many of them summed up, and the files of a campaign: flights.csv and
/// tracks.csv, written and read back, so that shards can be joined; and the one that says what to fly.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "evaluation/flights/flight_observer.hpp"
#include "evaluation/statistics.hpp"
#include "simulation/referee.hpp"
#include "simulation/scenario/scenario.hpp"
#include "window_ingress/estimation/clock_check.hpp"

namespace window_ingress::evaluation {

/// Where the vehicle truly was, in the window's frame.
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
  double wrong_side_m = 0.0;              ///< furthest sideways beyond where it started, away from the axis
  double max_speed_mps = 0.0;
  double nearest_m = 0.0;  ///< smallest gap to anything solid but the ground, never more than the true one
  double blind_sec = 0.0;  ///< longest time without sight of the window before the plane
  std::optional<double> predicted_miss_m;  ///< by the navigator, at its last commit
  std::optional<estimation::ClockCheck::Offset>
      clock_offset;  ///< of images beside odometry, as found on the way
  std::string reason;
  std::vector<TrackPoint> track;  ///< ten points a second
};

struct FlightSummary {
  int flights = 0;
  int passed = 0;
  Interval pass_rate_95;                ///< Wilson
  std::map<std::string, int> outcomes;  ///< by name
  std::map<std::string, int> causes;    ///< of all but PASSED: outcome and reason, numbers taken out
  double median_time_sec = 0.0;         ///< of the flights that passed
  double p95_time_sec = 0.0;
  double p95_offset_m = 0.0;      ///< of the larger of |y| and |z|, of the flights that crossed
  double p95_wrong_side_m = 0.0;  ///< of all flights
};

FlightSummary summarise(const std::vector<FlightResult>& flights);

/// What was flown: enough to fly it again with the same build.
struct CampaignFacts {
  std::string scenario;  ///< file, as all of these were given
  std::string seeds;     ///< e.g. "1..20"
  std::string draws;     ///< file; empty: none was given
  std::string params;    ///< file laid over the defaults; empty: none was given
  bool with_images = true;
  std::string version;  ///< of the package
};

/// The summary as json text, keys in a fixed order.
std::string toJson(const FlightSummary& summary, const CampaignFacts& facts);

/// Header of flights.csv, without the end of the line.
std::string csvHeader();

/// The flight as a row of flights.csv; what was never measured stays empty.
std::string csvRow(const FlightResult& flight);

/// Header of tracks.csv, and the rows of one flight, each with its end of line.
std::string trackHeader();
std::string trackRows(const FlightResult& flight);

/// Flights of a folder that `fly` has written, tracks included. \throws InputError
std::vector<FlightResult> readFlights(const std::string& folder);

/// Flights of several folders in the order of their seeds. \throws InputError, also for a seed found twice
std::vector<FlightResult> joinFlights(const std::vector<std::string>& folders);

/// Flights to be flown of one scenario: by seed, where within its range each named key lies.
using FlightDraws = std::map<std::uint32_t, simulation::Quantiles>;

/// A csv file with a header `seed,KEY,...` (paths of keys with a range, as in `simulation::Quantiles`) and a
/// row a flight. \throws InputError that names file and line
FlightDraws readDraws(const std::string& file);

/// Every step of a flight.
class FlightLog : public FlightObserver {
 public:
  void onStep(const FlightRecord& record, const navigation::NavigatorOutput&) override {
    records.push_back(record);
  }
  std::vector<FlightRecord> records;
};

/// As csv with a header.
void writeCsv(const FlightLog& log, std::ostream& out);

}  // namespace window_ingress::evaluation
