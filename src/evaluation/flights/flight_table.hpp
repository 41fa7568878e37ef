/// The files of a campaign: flights.csv and tracks.csv, written and read back, so that shards can be joined;
/// and the one that says what to fly.
#pragma once

#include <cstdint>
#include <map>
#include <ostream>
#include <string>
#include <vector>

#include "evaluation/flights/flight_observer.hpp"
#include "evaluation/flights/flight_summary.hpp"
#include "simulation/scenario/scenario.hpp"

namespace window_ingress::evaluation {

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
