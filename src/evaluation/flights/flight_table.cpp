#include "evaluation/flights/flight_table.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "evaluation/flights/flight_draws.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::evaluation {
namespace {

using simulation::Outcome;

std::string number(const std::optional<double>& value, const char* pattern = "%.4f") {
  if (!value) return "";
  return formatted(pattern, *value);
}

/// As one csv field: quoted if it has to be.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c == '\n' ? ' ' : c);
  return quoted + "\"";
}

/// Fields of one csv line; a quoted field may hold commas and doubled quotes.
std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    const bool doubled = quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"';
    if (doubled) ++i;
    if (c == '"' && !doubled)
      quoted = !quoted;
    else if (c == ',' && !quoted)
      fields.emplace_back();
    else
      fields.back() += c;
  }
  return fields;
}

/// Lines of a csv file below its header, each with the words for an error in it.
class Lines {
 public:
  Lines(const std::string& file, const std::string& header) : Lines(file) {
    if (header_ != header) fail("is not '" + header + "': written by another version?");
  }
  explicit Lines(const std::string& file) : name_(file), file_(file) {
    if (!std::getline(file_, header_)) throw TableError(file + ": cannot be read, or empty");
    columns_ = split(header_).size();
  }
  std::vector<std::string> header() const { return split(header_); }
  bool next(std::vector<std::string>& fields) {
    std::string line;
    if (!std::getline(file_, line)) return false;
    ++number_;
    fields = split(line);
    if (fields.size() != columns_) fail("has not " + std::to_string(columns_) + " fields");
    return true;
  }
  double number(const std::string& field) const {
    char* end = nullptr;
    const double value = std::strtod(field.c_str(), &end);
    if (field.empty() || *end != '\0') fail("'" + field + "' is no number");
    return value;
  }
  std::optional<double> optionalNumber(const std::string& field) const {
    if (field.empty()) return std::nullopt;
    return number(field);
  }
  std::uint32_t seed(const std::string& field) const { return static_cast<std::uint32_t>(number(field)); }
  [[noreturn]] void fail(const std::string& what) const {
    throw TableError(name_ + ":" + std::to_string(number_) + ": " + what);
  }

 private:
  std::string name_, header_;
  std::ifstream file_;
  std::size_t columns_ = 0;
  int number_ = 1;
};

Outcome outcomeOf(const std::string& name, const Lines& lines) {
  for (const Outcome outcome : {Outcome::kRunning, Outcome::kPassed, Outcome::kCollision,
                                Outcome::kFalseIngress, Outcome::kAborted, Outcome::kTimeout})
    if (name == toString(outcome)) return outcome;
  lines.fail("'" + name + "' is no outcome");
}

FlightResult flightOf(const std::vector<std::string>& fields, const Lines& lines) {
  FlightResult flight;
  flight.seed = lines.seed(fields[0]);
  flight.outcome = outcomeOf(fields[1], lines);
  flight.time_sec = lines.number(fields[2]);
  flight.offset_y_m = lines.optionalNumber(fields[3]);
  flight.offset_z_m = lines.optionalNumber(fields[4]);
  flight.min_clearance_m = lines.optionalNumber(fields[5]);
  flight.wrong_side_m = lines.number(fields[6]);
  flight.max_speed_mps = lines.number(fields[7]);
  flight.blind_sec = lines.number(fields[8]);
  flight.predicted_miss_m = lines.optionalNumber(fields[9]);
  flight.reason = fields[10];
  flight.nearest_m = lines.number(fields[11]);
  return flight;
}

}  // namespace

std::string csvHeader() {
  return "seed,outcome,time_s,offset_y_m,offset_z_m,min_clearance_m,wrong_side_m,max_speed_mps,blind_s,"
         "predicted_miss_m,reason,nearest_m";
}

std::string csvRow(const FlightResult& flight) {
  return std::to_string(flight.seed) + "," + toString(flight.outcome) + "," +
         number(flight.time_sec, "%.3f") + "," + number(flight.offset_y_m) + "," + number(flight.offset_z_m) +
         "," + number(flight.min_clearance_m) + "," + number(flight.wrong_side_m) + "," +
         number(flight.max_speed_mps) + "," + number(flight.blind_sec, "%.3f") + "," +
         number(flight.predicted_miss_m) + "," + field(flight.reason) + "," + number(flight.nearest_m);
}

std::string trackHeader() { return "seed,time_s,x_m,y_m,z_m"; }

std::string trackRows(const FlightResult& flight) {
  std::string rows;
  for (const TrackPoint& point : flight.track) {
    char text[120];
    std::snprintf(text, sizeof text, "%u,%.3f,%.4f,%.4f,%.4f\n", flight.seed, point.time_sec,
                  point.position_m.x(), point.position_m.y(), point.position_m.z());
    rows += text;
  }
  return rows;
}

std::vector<FlightResult> readFlights(const std::string& folder) {
  std::vector<FlightResult> flights;
  std::map<std::uint32_t, std::vector<TrackPoint>> tracks;
  std::vector<std::string> fields;
  Lines points(folder + "/tracks.csv", trackHeader());
  while (points.next(fields))
    tracks[points.seed(fields[0])].push_back(
        {points.number(fields[1]),
         {points.number(fields[2]), points.number(fields[3]), points.number(fields[4])}});
  Lines rows(folder + "/flights.csv", csvHeader());
  while (rows.next(fields)) {
    flights.push_back(flightOf(fields, rows));
    flights.back().track = tracks[flights.back().seed];
  }
  return flights;
}

FlightDraws readDraws(const std::string& file) {
  Lines lines(file);
  const auto keys = lines.header();
  if (keys.front() != "seed") lines.fail("must begin with 'seed'");
  FlightDraws draws;
  std::vector<std::string> fields;
  while (lines.next(fields)) {
    const auto [draw, is_new] = draws.try_emplace(lines.seed(fields[0]));
    if (!is_new) lines.fail("seed " + fields[0] + " stands there twice");
    for (std::size_t i = 1; i < keys.size(); ++i) draw->second[keys[i]] = lines.number(fields[i]);
  }
  return draws;
}

std::vector<FlightResult> joinFlights(const std::vector<std::string>& folders) {
  std::map<std::uint32_t, FlightResult> by_seed;
  for (const auto& folder : folders)
    for (auto& flight : readFlights(folder)) {
      const std::uint32_t seed = flight.seed;
      if (!by_seed.emplace(seed, std::move(flight)).second)
        throw TableError(folder + "/flights.csv: seed " + std::to_string(seed) + " was flown twice");
    }
  std::vector<FlightResult> flights;
  for (auto& entry : by_seed) flights.push_back(std::move(entry.second));
  return flights;
}

}  // namespace window_ingress::evaluation
