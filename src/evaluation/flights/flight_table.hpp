/// The files of a campaign: flights.csv and tracks.csv, written and read back, so that shards can be joined.
#pragma once

#include <istream>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "evaluation/flights/flight_summary.hpp"

namespace window_ingress::evaluation {

/// A table that cannot be read: `what()` is one line "file:line: what is wrong".
class TableError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Header of flights.csv, without the end of the line.
std::string csvHeader();

/// The flight as a row of flights.csv; what was never measured stays empty.
std::string csvRow(const FlightResult& flight);

/// Header of tracks.csv, and the rows of one flight, each with its end of line.
std::string trackHeader();
std::string trackRows(const FlightResult& flight);

/// Flights of a folder that `fly` has written, tracks included. \throws TableError
std::vector<FlightResult> readFlights(const std::string& folder);

/// Flights of several folders in the order of their seeds. \throws TableError, also for a seed found twice
std::vector<FlightResult> joinFlights(const std::vector<std::string>& folders);

}  // namespace window_ingress::evaluation
