#pragma once

#include <ostream>
#include <vector>

#include "evaluation/flights/flight_observer.hpp"

namespace window_ingress::evaluation {

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
